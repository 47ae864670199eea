#pragma once

// Passes of instruments through soft solids at the physics' rate, with all that a session does.
#include <span>

#include "osteon/physics/soft_cut_state.h"
#include "osteon/physics/soft_world.h"
#include "physics/soft/cut_blocks.h"

namespace osteon::testing {

class PassCutRig {
 public:
  PassCutRig() : world_(blocks_.setup, blocks_.tray, 2000, 40, 0.002) {
    tool_.tick = 1;
    bones_.count = static_cast<std::uint32_t>(blocks_.the_case->bones.size());
    for (std::size_t b = 0; b < bones_.count; ++b)
      bones_.bones[b].X_WB = blocks_.the_case->bones[b].X_WB;
    start_ = world_.save();
  }
  std::size_t solids() const { return blocks_.solids(); }
  std::size_t instruments() const { return blocks_.tray.size(); }

  void make_whole(std::size_t solid) {
    solid_ = solid;
    world_.restore(start_, 0);
    watch_.emplace(blocks_.setup->solids[solid], blocks_.whole_m3[solid]);
  }

  /// An instrument comes from outside, goes through the solid under power, shuts its jaws and goes
  /// on.
  void cut(std::size_t instrument, const CutNumbers& next) {
    const Quat q = turn_of(next);
    const Vec3 middle_W = blocks_.middles_W[solid_], half = blocks_.halves[solid_];
    const Vec3 first_W = middle_W + 1.05 * half.cwiseProduct(vector_of(next));
    const Vec3 last_W = middle_W + 1.05 * half.cwiseProduct(vector_of(next));
    Vec3 out = vector_of(next);
    out = out.norm() > 1e-3 ? Vec3(out.normalized()) : Vec3(Vec3::UnitZ());
    const Vec3 from_W = middle_W + (half.norm() + 0.004) * out;
    tool_.instrument = static_cast<std::uint32_t>(instrument);
    tool_.power = tool_.jaw = 1;
    tool_.X_WP = {from_W, q};
    step();
    lead(from_W, first_W);
    tool_.jaw = 0;
    lead(first_W, last_W);
  }

  std::string why_unsound() {
    const SolidReadout& felt = world_.solid_readout(solid_);
    if (!std::isfinite(felt.force_n[0]) || !std::isfinite(felt.deep_m[0]))
      return "the force is no number";
    if (world_.state().solid_lost[solid_]) return "it was lost";
    return watch_->why_unsound(world_.save().cut->solids[solid_].cuts);
  }
  bool took_something() const { return watch_->took_something(); }
  std::string why_not_whole() {
    const std::string why = watch_->why_not_whole(world_.removed_m3(solid_));
    most_off_m3_ = std::max(most_off_m3_, std::abs(watch_->off_m3()));
    return why;
  }
  std::string why_not_elastic() const {
    const SoftState state = world_.save();
    const SolidCutState& of = state.cut->solids[solid_];
    if (of.next.empty() && of.felt.empty()) return {};
    return testing::why_not_elastic(blocks_, solid_, of.next.empty() ? of.felt : of.next);
  }
  double most_off_m3() const { return most_off_m3_; }
  int pieces() const { return static_cast<int>(world_.pieces(solid_)); }

 private:
  void lead(const Vec3& from_W, const Vec3& to_W) {
    constexpr double kStep_m = 0.0012;
    const int count = 1 + static_cast<int>((to_W - from_W).norm() / kStep_m);
    for (int i = 1; i <= count; ++i) {
      tool_.X_WP.p = from_W + (i / static_cast<double>(count)) * (to_W - from_W);
      step();
    }
  }
  void step() {
    ++bones_.step;
    ++tool_.tick;
    const ToolState* const one = &tool_;
    world_.step(std::span(&one, 1), bones_);
  }

  const CutBlocks& blocks_ = cut_blocks();
  SoftWorld world_;
  SoftState start_;
  std::optional<CutBlockWatch> watch_;
  std::size_t solid_ = 0;
  double most_off_m3_ = 0;
  ToolState tool_;
  BoneSnapshot bones_;
};

}  // namespace osteon::testing
