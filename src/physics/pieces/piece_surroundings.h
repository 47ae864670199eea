#pragma once

#include <array>
#include <span>

#include "osteon/base/types.h"
#include "osteon/physics/fallen_pieces.h"

namespace osteon {

/// How far a point lies in something, and which way is out.
struct PiecePush {
  double depth_m = 0;  ///< not above 0: it lies in nothing
  Vec3 out_W = Vec3::UnitZ();
  double of_half = 0;  ///< the depth by half of how thick the part is; 0: that is not known
};

/// The surfaces of soft parts, as loose pieces meet them.
class PieceSoftGround {
 public:
  virtual ~PieceSoftGround() = default;
  /// The deepest of all; allocates nothing.
  virtual PiecePush at(const Vec3& p_W) const = 0;
  /// Whether what jaws and suction carry is stopped by them, too.
  virtual bool stops_carried() const { return false; }
  /// And whether by those, too, that are too thin for anything to stand deep in them.
  virtual bool thin_ones_stop() const { return false; }
  /// And whether suction leaves what such a one would take off it at once.
  virtual bool suction_heeds_thin() const { return false; }
  /// False: no point of that ball is in one.
  virtual bool may_meet(const Vec3& center_W, double radius_m) const = 0;
};

/// What loose pieces meet in a step: bones as they are now, and the instruments of the hands.
struct PieceSurroundings {
  const PiecesSetup& setup;
  std::span<const ToolState* const> tools;
  const BoneSnapshot& bones;
  std::span<const CarvedField* const> carved;
  const PieceSoftGround* softs = nullptr;  ///< null: they meet no soft part

  const CarvedField* carved_at(std::size_t bone) const {
    return bone < carved.size() ? carved[bone] : nullptr;
  }
  /// Of one bone, if it is deeper than `out`.
  void add_push(std::size_t bone, const Vec3& p_B, PiecePush& out) const;
  /// The deepest of all bones.
  PiecePush in_bone(const Vec3& p_W) const;
  /// The deepest of all instruments that are where the bones are.
  PiecePush in_tool(const Vec3& p_W) const;
  /// The deepest of all soft parts that are met.
  PiecePush in_soft(const Vec3& p_W) const { return softs ? softs->at(p_W) : PiecePush{}; }
  /// Whether soft parts are about a point: it lies in the limb.
  bool in_tissue(const Vec3& p_W) const;
  /// Whether any instrument comes into that ball.
  bool tool_near(const Vec3& center_W, double radius_m) const;
};

/// The bones and instruments that a ball comes near, found once for the many points of a piece.
/// Answers are those of `PieceSurroundings`, bit by bit, for points outside of the ball too.
class PieceNeighbours {
 public:
  PieceNeighbours(const PieceSurroundings& around, const Vec3& center_W, double radius_m);
  PiecePush in_bone(const Vec3& p_W) const;
  PiecePush in_tool(const Vec3& p_W) const;
  PiecePush in_soft(const Vec3& p_W) const;

 private:
  struct NearBone {
    std::size_t bone = 0;
    Pose X_BW;
  };
  bool is_inside(const Vec3& p_W) const { return (p_W - center_W_).squaredNorm() <= square_; }

  const PieceSurroundings& around_;
  Vec3 center_W_;
  double square_ = 0;
  std::size_t count_ = 0;
  bool tools_ = false, softs_ = false;
  std::array<NearBone, kMaxBones> near_;
};

bool in_box(const Aabb& box, const Vec3& p);
/// How far a point in Bone lies in a bone that was not carved; `out_W` is in Bone.
PiecePush push_of(const PieceObstacle& bone, const Vec3& p_B);
/// How far a point in Tool lies in a part of an instrument; `out_W` is in Tool.
PiecePush push_of(const Primitive& part, const Vec3& p_T);
/// The same of what is left of a carved bone, in Bone.
PiecePush push_of(const CarvedField& field, const Vec3& p_B);

}  // namespace osteon
