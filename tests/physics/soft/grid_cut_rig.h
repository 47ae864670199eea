#pragma once

// Cuts of the grid alone: the shapes of the shipped blades, punch, shaver and ablator at any poses,
// as a step of physics makes them, pieces that come off, and the stiffness of what is left.
#include <algorithm>

#include "osteon/carve/loose_pieces.h"
#include "osteon/carve/piece_shape.h"
#include "osteon/carve/removed.h"
#include "physics/soft/cut_blocks.h"
#include "soft/solid_cells.h"
#include "soft/solid_cutting.h"

namespace osteon::testing {

class GridCutRig {
 public:
  explicit GridCutRig(const CutBlocks& blocks = cut_blocks()) : blocks_(blocks) {}
  std::size_t solids() const { return blocks_.solids(); }
  std::size_t instruments() const { return blocks_.setup->cutters.size(); }

  void make_whole(std::size_t solid) {
    solid_ = solid;
    const SoftSolid& of = blocks_.setup->solids[solid];
    field_.emplace(std::move(*CarvedField::make(of.uncut, {}, kMostCutBlocks, kSolidCutAir_m)));
    loose_.emplace(*field_);
    loose_->hang(*field_, of.hangs);
    cells_.emplace(*field_, *of.body);
    celled_ = 0;
    watch_.emplace(of, blocks_.whole_m3[solid]);
  }

  /// An instrument's shape from one pose to another near it; what comes off is taken away.
  void cut(std::size_t instrument, const CutNumbers& next) {
    constexpr double kStep_m = 0.002, kStep = 0.1;
    const SolidCutter& with = *blocks_.setup->cutters[instrument];
    Pose from;
    from.q = turn_of(next);
    from.p = blocks_.middles_B[solid_] + 1.1 * blocks_.halves[solid_].cwiseProduct(vector_of(next));
    if (with.way == SolidCutter::Way::kBite)
      from.p -= from.rotate(with.cutter.parts[0].box.center());
    Pose to = from;
    to.p += kStep_m * vector_of(next);
    const Vec3 turn = kStep * vector_of(next);
    to.q = (Quat(1, turn.x(), turn.y(), turn.z()) * from.q).normalized();
    field_->cut(with.cutter, from, with.way == SolidCutter::Way::kSlice ? to : from);
    for (const LoosePiece& piece : loose_->find(*field_)) {
      (void)PieceShape::of(*field_, *loose_, piece, 0);
      (void)loose_->take_away(*field_, piece, kSolidCutAir_m);
      ++pieces_;
    }
    cells_->update(*field_, celled_);
    celled_ = field_->step();
  }

  std::string why_unsound() { return watch_->why_unsound(field_->save()); }
  bool took_something() const { return watch_->took_something(); }
  std::string why_not_whole() {
    const std::string why = watch_->why_not_whole(total(removed_volume(*field_)));
    most_off_m3_ = std::max(most_off_m3_, std::abs(watch_->off_m3()));
    return why;
  }
  std::string why_not_elastic() const {
    return testing::why_not_elastic(blocks_, solid_, cells_->cells());
  }
  double most_off_m3() const { return most_off_m3_; }
  int pieces() const { return pieces_; }

 private:
  const CutBlocks& blocks_;
  std::size_t solid_ = 0;
  std::optional<CarvedField> field_;
  std::optional<LoosePieces> loose_;
  std::optional<SolidCells> cells_;
  std::optional<CutBlockWatch> watch_;
  std::uint64_t celled_ = 0;
  double most_off_m3_ = 0;
  int pieces_ = 0;
};

}  // namespace osteon::testing
