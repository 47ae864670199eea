#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/carve/bone_layers.h"
#include "osteon/carve/cutter.h"
#include "osteon/carve/uncut_field.h"

namespace osteon {

/// What one step did. Bits of `status` may stand together.
struct CarveStep {
  enum : std::uint32_t {
    kRemoved = 1,     ///< bone was removed
    kBlocksFull = 2,  ///< no block left for the change: nothing was done
    kNotFinite = 4,   ///< a pose or a cutter is not finite: nothing was done
    kTooLong = 8,     ///< the motion takes more places of the cutter than a step may: nothing done
  };
  std::uint32_t status = 0;
  std::uint32_t blocks = 0;  ///< changed
  /// By nodes, for forces: within some percent. What was removed in all: see removed.h.
  ByTissue removed_m3{};
};

/// All that has been cut, as a value: blocks by rising index.
struct CarveState {
  struct Block {
    std::uint32_t block = 0;
    std::array<std::int16_t, BlockGrid::kNodes> cut{};
    friend bool operator==(const Block&, const Block&) = default;
  };
  std::uint64_t bone = 0;  ///< hash of the bone's field
  std::uint64_t step = 0;
  std::vector<Block> blocks;
  friend bool operator==(const CarveState&, const CarveState&) = default;
};

/// A bone that is being carved: the immutable field of the bone and, in blocks from a pool that is
/// made at load, the signed distance to all that was cut. Cartilage on the bone belongs to it. What
/// is left is where max(bone, -cut) is negative: both are smooth where they meet, so a hole's rim
/// is as sharp as the two say. Distances to cuts fold by the minimum: the order of cuts does not
/// matter, bit by bit.
class CarvedField {
 public:
  static constexpr std::int16_t kUncut = UncutField::kFar;
  static constexpr std::size_t kMostBlocks = 24576;  ///< 2 kB each

  /// Cuts are kept as far as `air_m` outside of the bone as well, for who asks there how far a
  /// hole's wall is. Fails on layers that do not fit together.
  static Result<CarvedField> make(std::shared_ptr<const UncutField> bone,
                                  const BoneLayers& layers = {},
                                  std::size_t most_blocks = kMostBlocks, double air_m = 0);

  /// Removes what `cutter` passes from one pose to the next, both in Bone: straight in place, the
  /// shorter way round in turn. A ball's way is exact; other shapes take places that lie at most
  /// half a cell apart. Allocates nothing. A step that does not fit does nothing.
  CarveStep cut(const Cutter& cutter, const Pose& X_BT0, const Pose& X_BT1);
  CarveStep cut(const Cutter& cutter, const Pose& X_BT) { return cut(cutter, X_BT, X_BT); }

  const UncutField& bone() const { return *bone_; }
  const std::shared_ptr<const UncutField>& shared_bone() const { return bone_; }
  const BlockGrid& grid() const { return bone_->grid(); }
  const BoneLayers& layers() const { return layers_; }

  std::uint64_t step() const { return step_; }
  /// Changes when the whole state was replaced: then all blocks may have changed.
  std::uint64_t epoch() const { return epoch_; }
  std::size_t block_count() const { return used_; }  ///< blocks that hold a cut
  std::size_t most_blocks() const { return marks_.size(); }

  /// Blocks that hold a cut, in the order in which they were first touched.
  std::uint32_t block_at(std::size_t n) const { return marks_[n].block; }
  /// Step that last changed it, for who copies its cuts.
  std::uint64_t changed_at(std::size_t n) const { return marks_[n].changed; }
  /// Cuts of a block's nodes, um; null where it holds none.
  const std::int16_t* cuts(std::uint32_t block) const;
  /// Heights of the uncut bone's nodes of a block that holds a cut; null elsewhere.
  const std::int16_t* heights(std::uint32_t block) const;
  /// The same over the bone alone, without cartilage.
  const std::int16_t* bare_heights(std::uint32_t block) const;
  /// Height of any node over the uncut bone, cartilage and all, and over the bone alone, m: exact
  /// near a surface.
  double height_m(std::uint32_t block, std::size_t node) const;
  double bare_height_m(std::uint32_t block, std::size_t node) const;
  /// Whether the surface in that block may look different since after step `since`.
  bool surface_changed(std::uint32_t block, std::uint64_t since) const;

  /// Copies one block's cuts from another holder of the same bone's field. False: no block is left,
  /// or the block lies outside of the bone; nothing was done.
  bool apply(std::uint32_t block, std::span<const std::int16_t, BlockGrid::kNodes> cut,
             std::uint64_t step);

  CarveState save() const;
  /// Puts the bone back as it was then: undo. Fails on a state of another bone or one that does not
  /// fit; then nothing was done.
  Result<void> restore(const CarveState& state);
  /// Of the cuts alone: the same for the same holes, whichever steps made them. Looks at the blocks
  /// that changed since it was last asked.
  std::uint64_t hash();

 private:
  struct Mark {
    std::uint32_t block = 0;
    bool hashed = false;
    std::uint64_t changed = 0;  ///< step
    std::uint64_t surface = 0;  ///< step that last changed a node near a surface
    /// The same for nodes by which the surface of the block beyond a side may change: x-, x+, ...
    std::array<std::uint64_t, 6> side{};
    std::uint64_t hash = 0;
  };
  struct alignas(64) Nodes {
    std::array<std::int16_t, BlockGrid::kNodes> cut, height;
  };
  struct Pass;

  CarvedField() = default;
  void clear();
  bool may_hold_cuts(std::uint32_t block) const;
  std::uint32_t take(std::uint32_t block);

  static constexpr std::uint32_t kNone = 0xffffffffu, kWanted = 0xfffffffeu;
  std::shared_ptr<const UncutField> bone_;
  BoneLayers layers_;
  std::array<std::int32_t, kMostBoneLayers> layer_um_{};
  std::vector<std::uint32_t> slot_;  ///< of each block of the grid
  std::vector<Mark> marks_;
  std::vector<Nodes> nodes_;
  std::vector<std::array<std::int16_t, BlockGrid::kNodes>> bare_;  ///< as nodes_; or none
  std::size_t used_ = 0;
  double air_m_ = 0;
  std::uint64_t step_ = 0, epoch_ = 0;
};

}  // namespace osteon
