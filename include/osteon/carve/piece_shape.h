#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"
#include "osteon/carve/loose_pieces.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// What of a piece that was cut off is stored; all else follows from it.
struct PieceGrid {
  std::uint32_t bone = 0;  ///< of the case, that it was part of
  double cell_m = 0;
  Vec3 lo_B = Vec3::Zero();           ///< of the first node, in Bone before it fell
  std::array<int, 3> nodes{};         ///< along x, y, z
  std::vector<std::int16_t> heights;  ///< of each node over its surface, um, x fastest
};

/// A piece of bone by itself, in the frame of the bone that it was part of. Immutable.
class PieceShape {
 public:
  static constexpr std::size_t kMostNodes = std::size_t{1} << 21;
  static constexpr std::size_t kMostPoints = 48;

  /// The piece as the field has it, before it is taken away from there. Of a large one every
  /// second, third, ... node is kept, so that there are kMostNodes at most. Null: nothing of it is
  /// left then.
  static std::shared_ptr<const PieceShape> of(const CarvedField& field, const LoosePieces& found,
                                              const LoosePiece& piece, std::uint32_t bone);
  /// Null where the grid does not fit together or nothing is inside.
  static std::shared_ptr<const PieceShape> from(PieceGrid grid);

  const PieceGrid& grid() const { return grid_; }
  double volume_m3() const { return volume_m3_; }       ///< by nodes
  const Vec3& middle_B() const { return middle_B_; }    ///< centre of volume
  const Mat3& spread_m2() const { return spread_m2_; }  ///< mean of (p - middle)(p - middle)^T
  double reach_m() const {
    return reach_m_;
  }  ///< radius of the ball about the middle that holds it
  /// Points of its surface, far from each other.
  const std::vector<Vec3>& points_B() const { return points_B_; }
  std::uint64_t hash() const { return hash_; }
  /// Closed and facing outwards. Fails where less than a cell is inside.
  Result<TriMesh> surface() const;

 private:
  PieceShape() = default;
  double height_m(const std::array<int, 3>& node) const;
  double height_at(const Vec3& p_B, double most_m) const;
  bool measure();
  void find_points();

  PieceGrid grid_;
  double volume_m3_ = 0, reach_m_ = 0;
  Vec3 middle_B_ = Vec3::Zero();
  Mat3 spread_m2_ = Mat3::Zero();
  std::vector<Vec3> points_B_;
  std::uint64_t hash_ = 0;
};

}  // namespace osteon
