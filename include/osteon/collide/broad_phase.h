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
  std::size_t query(std::span<const Pose> X_WB, const SweptSphere& ball, double margin,
                    std::span<PieceRef> out) const;

 private:
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
  void add_piece(const ConvexBody& piece);
  void close_bone();

  std::vector<Bounds> pieces_;
  std::vector<Ball> bones_;                    // around all pieces of a bone
  std::vector<std::uint32_t> first_piece_{0};  // of each bone, and the end
};

}  // namespace osteon
