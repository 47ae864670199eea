#pragma once

#include <array>
#include <cstdint>

#include "field/placed_part.h"
#include "osteon/carve/block_grid.h"
#include "osteon/carve/bone_layers.h"

namespace osteon {

/// Rows of a block along x: first and last j and k, and which of those.
struct BlockRows {
  int j0 = 0, j1 = 7, k0 = 0, k1 = 7;
  std::uint64_t asked = ~std::uint64_t{0};  ///< bit 8 k + j
  bool has_all() const { return asked == ~std::uint64_t{0}; }
  bool has(int j, int k) const { return (asked >> (8 * k + j) & 1) != 0; }
};

/// Of `rows` those with a node that may lie within `reach_m` of a ball's way. What is left out has
/// none: a cut is the same without it. `lo_B` is the block's first node.
BlockRows near_ball(const PlacedPart& ball, const Vec3& lo_B, double cell_m, double reach_m,
                    const BlockRows& rows);

/// Distances of a block's nodes to a part, um, where `rows` says; negative inside. A curved face
/// lies by so much farther out as lines between nodes cut off of it in the mean, which keeps
/// volumes right. `lo_B` is the block's first node.
void part_distances(const PlacedPart& placed, const Vec3& lo_B, double cell_m,
                    const BlockRows& rows, float* out_um);

/// What a field's lengths are in um.
struct CutScale {
  std::int32_t cell = 0;
  std::int32_t reach = 0;  ///< cuts farther off than this are not written
  std::array<std::int32_t, kMostBoneLayers> layer{};
  std::size_t layers = 0;
};

/// Heights of a block's nodes, um: over the bone with its cartilage, and over the bone alone. The
/// same where nothing covers it.
struct UncutHeights {
  const std::int16_t *all = nullptr, *bare = nullptr;
};

/// What became of a block.
struct Lowered {
  bool any = false;        ///< a node was lowered
  bool near = false;       ///< one of them by which the surface may change
  std::uint8_t sides = 0;  ///< of those: bit 2a: within the first two along axis a, 2a + 1: last
  /// Of cuts and bone by layer and all deeper ones, in cell^2 um^2: see occupied().
  std::array<std::int64_t, kMostBoneLayers> removed{};
  std::int64_t cartilage = 0;
};

/// cut = min(cut, distance) where the distance is within reach.
Lowered lower_cuts(const float* distance_um, const CutScale& scale, const BlockRows& rows,
                   const UncutHeights& height, std::int16_t* cut);

/// Whether a node in those rows would be written.
bool reaches(const float* distance_um, const CutScale& scale, const BlockRows& rows);

}  // namespace osteon
