#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/carve/block_grid.h"
#include "osteon/mesh/covered_surface.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

struct UncutFieldOptions {
  double cell_m = 0.00025;
  /// Exact heights reach at least so far out of the bone; less than 3 cells count as 3.
  double outside_m = 0.001;
  double room_m = 0;  ///< the grid reaches at least so far out of the bone
  std::size_t most_bytes = std::size_t{512} << 20;
  /// Runs tasks 0 .. count - 1 in any order, on any threads; none: one after the other.
  std::function<void(std::size_t count, const std::function<void(std::size_t)>& task)> run;
};

/// A bone before it is carved: signed distance to its closed mesh on the nodes of a grid, negative
/// inside, in whole micrometres. Blocks near the surface hold all their nodes; of a block deep
/// inside the depth of its middle is known, which is enough for what tissue lies there. Immutable.
/// The same mesh gives the same bits from every compiler and any number of threads. Of a bone under
/// cartilage it is the field of both, and bare() that of the bone alone on the same nodes: what
/// lies inside the first and outside the second is cartilage.
class UncutField {
 public:
  /// Where a block lies. Every node of a deep or outer block is at least 3 cells off the surface.
  enum class Place : std::uint8_t { kOutside, kDeep, kStored };
  static constexpr std::int16_t kFar = 32767;  ///< um: a value that is not known to be smaller

  /// Fails when the mesh is empty, open, inside out, not finite, no larger than a few cells, or the
  /// field would take more memory than allowed.
  static Result<std::shared_ptr<const UncutField>> make(const TriMesh& mesh,
                                                        const UncutFieldOptions& options = {});
  /// Of a bone with layers of cartilage on it; `most_bytes` counts for both fields together.
  static Result<std::shared_ptr<const UncutField>> make(const CoveredSurface& body,
                                                        const UncutFieldOptions& options = {});
  /// Of another mesh on the nodes of this field, which must reach around it: of a layer, for what
  /// is left of it after the same cuts.
  Result<std::shared_ptr<const UncutField>> make_beside(
      const TriMesh& mesh, const UncutFieldOptions& options = {}) const;

  /// The bone without its cartilage, on the same grid; null: nothing covers it.
  const std::shared_ptr<const UncutField>& bare() const { return bare_; }
  const BlockGrid& grid() const { return grid_; }
  const Aabb& box() const { return box_; }  ///< of the mesh, cartilage and all
  Place place(std::uint32_t block) const;
  /// Heights of a block's nodes, um; those of a deep block lie on a smooth line between middles.
  void heights(std::uint32_t block, std::span<std::int16_t, BlockGrid::kNodes> out) const;
  /// Those of a stored block; null of others.
  const std::int16_t* stored(std::uint32_t block) const;
  /// Height of a block's middle, m; of an outer block no more than that.
  double middle_m(std::uint32_t block) const { return static_cast<double>(middle_[block]); }
  std::size_t bytes() const;  ///< with those of bare()
  std::size_t stored_blocks() const { return heights_.size() / BlockGrid::kNodes; }
  std::uint64_t hash() const { return hash_; }

 private:
  struct Maker;
  struct Source;
  static Result<std::shared_ptr<UncutField>> make(const Source& source,
                                                  const UncutFieldOptions& options,
                                                  const UncutField* same_grid);
  UncutField() = default;
  void deep_heights(std::uint32_t block, std::span<std::int16_t, BlockGrid::kNodes> out) const;

  static constexpr std::uint32_t kOut = 0xffffffffu, kIn = 0xfffffffeu;
  BlockGrid grid_;
  Aabb box_;
  std::vector<float> middle_;        ///< of each block
  std::vector<std::uint32_t> slot_;  ///< of each block: kOut, kIn or its place in heights_
  std::vector<std::int16_t> heights_;
  std::uint64_t hash_ = 0;
  std::shared_ptr<const UncutField> bare_;
};

}  // namespace osteon
