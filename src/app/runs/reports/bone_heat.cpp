#include "runs/reports/bone_heat.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace osteon {
namespace {

constexpr double kHeatCell_m = 0.0005, kHeatStep_s = 0.05;
constexpr double kAlong_m = 0.045, kAround_m = 0.006;

}  // namespace

bool makes_heat(const CarvingReadout& readout) { return readout.cutting_w + readout.rubbing_w > 0; }

BoneHeat::BoneHeat(const DrillTable& table, const CarvingReadout& first)
    : material_(table.heat),
      chips_share_(table.chips_heat_share),
      rubbing_share_(table.rubbing_heat_share),
      outrun_m_per_s_(table.outrun_m_per_s),
      bone_(first.bone) {
  box_B_.include(first.tip_B + 0.005 * first.axis_B);
  box_B_.include(first.tip_B - kAlong_m * first.axis_B);
  const Vec3 room = Vec3::Constant(first.radius_m + kAround_m);
  box_B_.lo -= room;
  box_B_.hi += room;
  if (auto grid = HeatGrid::make(box_B_, kHeatCell_m, material_)) heat_ = std::move(*grid);
}

// Heat is let out about the tip's rim. The bone before a quick drill goes with the heat in it.
void BoneHeat::warm(const CarvingReadout& readout, double step_s) {
  if (readout.bone != bone_ || !heat_ || !makes_heat(readout)) return;
  const double stays = 1 / (1 + readout.advance_m / step_s / outrun_m_per_s_);
  const double joules =
      stays * (chips_share_ * readout.cutting_w + rubbing_share_ * readout.rubbing_w) * step_s;
  const Vec3 x = readout.axis_B.unitOrthogonal(), y = readout.axis_B.cross(x);
  constexpr int kAround = 8;
  for (int i = 0; i < kAround; ++i) {
    const double a = 2 * std::numbers::pi * (i + 0.5) / kAround;
    const Vec3 rim = readout.radius_m * (std::cos(a) * x + std::sin(a) * y);
    heat_->add_heat(readout.tip_B + rim, joules / kAround);
  }
  if (readout.advance_m > 0) tip_ = readout.tip_B + kHeatCell_m * readout.axis_B;
  radius_m_ = readout.radius_m;
}

bool BoneHeat::pass(double step_s) {
  since_s_ += step_s;
  if (since_s_ < kHeatStep_s) return false;
  if (heat_ && tip_) {
    const Vec3 from = opened_.value_or(*tip_);
    heat_->open(from, *tip_, std::max(0.0, radius_m_ - 0.5 * kHeatCell_m));
    opened_ = tip_;
  }
  if (heat_) heat_->step(since_s_);
  since_s_ = 0;
  return heat_.has_value();
}

}  // namespace osteon
