#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/collide/convex_body.h"

namespace osteon {

/// One hull piece of one bone.
struct PieceRef {
  std::uint32_t bone = 0;
  std::uint32_t piece = 0;  ///< index within the bone
  bool operator==(const PieceRef&) const = default;
};

/// A ball that moves in a straight line, in World.
struct SweptSphere {
  Vec3 p_from_W = Vec3::Zero();
  Vec3 p_to_W = Vec3::Zero();
  double radius = 0;  ///< m
};

class NearPieces;

/// Bounds of every hull piece in the frame of its bone; the bones move, the bounds do not. Built
/// once at load, then read by any thread: queries allocate nothing.
class BroadPhase {
 public:
  /// Adds the next bone with its pieces; bones and pieces count from 0 in the order of the calls.
  void add_bone(std::span<const ConvexBody> pieces);
  void add_bone(std::span<const ConvexBody* const> pieces);
  /// A bone that is one piece of any form, within `box` of its frame.
  void add_bone(const Aabb& box);

  std::size_t bone_count() const { return first_piece_.size() - 1; }
  std::size_t piece_count() const { return first_piece_.back(); }

  /// Pieces that may come within `margin` (m) of the swept ball, in creation order. `X_WB`: pose of
  /// every bone in World. Conservative: never misses a piece (its ball and its box in the bone's
  /// frame are tested). Writes at most out.size() pieces and returns how many there are: more than
  /// out.size() means that the rest was left out. A pose or a ball that is not finite yields every
  /// piece of that bone, so that a broken value cannot hide a contact.
  /// `near`, which may come from a query near by, makes it quicker and changes nothing else.
  std::size_t query(std::span<const Pose> X_WB, const SweptSphere& ball, double margin,
                    std::span<PieceRef> out, NearPieces* near = nullptr) const;

  /// The same for one bone: pieces go to `out` from out[found] on. Returns `found` and what was
  /// found in this bone.
  std::size_t query_bone(std::uint32_t bone, const Pose& X_WB, const SweptSphere& ball,
                         double margin, std::span<PieceRef> out, std::size_t found,
                         NearPieces* near) const;

  /// How much wider `margin` may be, m, for `query_bone` to find nothing still, as far as `near`
  /// knows from earlier queries; 0 where it knows nothing.
  static double spare(const NearPieces& near, std::uint32_t bone, const Pose& X_WB,
                      const SweptSphere& ball, double margin);

 private:
  friend class NearPieces;
  struct Bounds {
    Vec3 center_B;
    double radius = 0;
    Vec3 box_center_B;
    Vec3 box_half;
  };
  struct Ball {
    Vec3 center_B = Vec3::Zero();
    double radius = 0;
  };
  /// The swept ball in a bone's frame, its radius and the margin as one.
  struct BallOfBone {
    Vec3 from_B = Vec3::Zero();
    Vec3 along_B = Vec3::Zero();
    double per_length2 = 0;  // 1 over the square of along_B's length; 0: a point
    double reach = 0;
    bool finite = false;
  };
  void add_piece(const ConvexBody& piece);
  void close_bone();
  bool out_of_reach(std::uint32_t bone, const Pose& X_WB, const SweptSphere& ball,
                    double margin) const;
  static BallOfBone in_bone(const Pose& X_WB, const Mat3& R_BW, const SweptSphere& ball,
                            double margin);
  static bool meets(const Bounds& piece, const BallOfBone& ball);
  struct Clearance {
    double room = 0;          ///< m; the ball may be so far from the place; not above 0: nowhere
    double step_squared = 0;  ///< m^2, of how far it is
  };
  static Clearance clearance(const NearPieces& near, std::uint32_t bone, const Pose& X_WB,
                             const SweptSphere& ball, double margin);
  static bool still_clear(const NearPieces& near, std::uint32_t bone, const Pose& X_WB,
                          const SweptSphere& ball, double margin);
  double gap_to_pieces(std::uint32_t bone, const Vec3& p_B) const;
  std::span<const std::uint32_t> near_of(std::uint32_t bone, const Pose& X_WB,
                                         const BallOfBone& ball, NearPieces& near) const;
  void look_about(std::uint32_t bone, const Pose& X_WB, const BallOfBone& ball,
                  NearPieces& near) const;

  std::vector<Bounds> pieces_;
  std::vector<Ball> bones_;                    // around all pieces of a bone
  std::vector<std::uint32_t> first_piece_{0};  // of each bone, and the end
};

/// Of each bone the pieces about a place a little wider than a query asked for (Verlet's list,
/// Physical Review 159, 1967): a query that stays within goes through those alone. It changes what
/// a query costs, never what it finds. For one BroadPhase that gets no more bones, and for one
/// caller at a time; allocates in its constructor only.
class NearPieces {
 public:
  explicit NearPieces(const BroadPhase& broad_phase);

 private:
  friend class BroadPhase;
  struct Place {
    Pose X_WB;                ///< of the bone when the place was looked at
    Vec3 p_W = Vec3::Zero();  ///< the place, then
    Vec3 p_B = Vec3::Zero();  ///< and in the bone's frame
    double reach = -1;        ///< m; below 0: nothing is known
    std::uint32_t count = 0;
  };
  /// The turn into a bone's frame: a bone that stands still keeps it.
  struct Turn {
    Pose X_WB;
    Mat3 R_BW = Mat3::Identity();
  };
  const Mat3& turn_into(std::uint32_t bone, const Pose& X_WB);

  std::vector<Place> places_;          // one a bone
  std::vector<Turn> turns_;            // likewise
  std::vector<std::uint32_t> pieces_;  // of each bone from its first piece on
};

}  // namespace osteon
