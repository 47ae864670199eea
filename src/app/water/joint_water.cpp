#include "water/joint_water.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "osteon/carve/removed.h"
#include "osteon/scene/tool_set.h"

namespace osteon {
namespace {

constexpr double kLeap_s = 1;
constexpr double kFills_s = 120;      // until a joint that fills has come to rest
constexpr double kFillStep_s = 0.05;  // of it
// 0.05 ml/min from each cm2 of opened soft bone (D): both tunnels of a ligament, some 15 cm2, then
// give 45 ml in the first hour without pressure.
constexpr double kOoze_m_per_s = 8.3e-6;
constexpr double kFluteShare = 0.2;
constexpr double kLeastRemoved_m3 = 1e-12;  // less is rounding

double vascular_m3(const ByTissue& removed_m3) {
  return removed_m3[static_cast<std::size_t>(BoneTissue::kCancellous)] +
         removed_m3[static_cast<std::size_t>(BoneTissue::kMarrow)];
}

// Of a ball of that volume: no hole has less wall.
double wall_m2(double volume_m3) {
  return std::cbrt(36 * std::numbers::pi * volume_m3 * volume_m3);
}

}  // namespace

WaterTools water_tools_of(const std::vector<std::string>& tray,
                          std::span<const Instrument> instruments) {
  WaterTools which{std::vector<bool>(tray.size(), false), std::vector<bool>(tray.size(), false)};
  for (std::size_t k = 0; k < tray.size(); ++k) {
    const auto name = parse_tool_name(tray[k]);
    const Instrument* instrument = name ? find_instrument(instruments, name->name) : nullptr;
    which.sucks[k] = instrument && instrument->can(InstrumentFunction::kSuck);
    which.removes[k] = instrument && instrument->removal.has_value();
  }
  return which;
}

Result<WaterTools> water_tools_of(const std::vector<std::string>& tray) {
  if (tray.empty()) return WaterTools();
  const auto instruments = load_instruments();
  if (!instruments) return tl::unexpected(instruments.error());
  return water_tools_of(tray, *instruments);
}

WaterDeeds deeds_of(const WaterTools& which, std::span<const ToolState> tools) {
  WaterDeeds deeds;
  bool outside = false, inside = false;
  for (const ToolState& tool : tools) {
    if (tool.instrument >= which.sucks.size() || !(tool.power > 0)) continue;
    if (which.sucks[tool.instrument])
      deeds.suction = std::max(deeds.suction, std::min(tool.power, 1.0));
    if (!which.removes[tool.instrument]) continue;
    (tool.portal == kNoPortal ? outside : inside) = true;
  }
  if (outside && !inside) deeds.share_into_joint = kFluteShare;
  return deeds;
}

JointWater::JointWater(const FluidJoint& joint) : joint_(joint) { begin_clear(); }

void JointWater::begin_clear() {
  state_ = {};
  FluidDrive drive;
  drive.pump_pa = settings_.pump_pa;
  drive.outlet_open = settings_.outlet_open;
  for (double t = 0; t < kFills_s; t += kFillStep_s)
    state_ = step_fluid(joint_, drive, state_, kFillStep_s);
  state_.time_s = state_.obscured_s = 0;
}

void JointWater::set(const WaterSettings& settings) {
  FluidDrive drive;
  drive.pump_pa = settings.pump_pa;
  drive.outlet_open = settings.outlet_open;
  if (check_fluid(drive)) settings_ = settings;
}

void JointWater::go_to(double time_s, const WaterDeeds& deeds, const ByTissue& removed_m3) {
  if (!std::isfinite(time_s)) return;
  const double dt_s = time_s_ ? time_s - *time_s_ : 0;
  const double gone_m3 = total(removed_m3) - total(removed_m3_);
  if (!time_s_ || dt_s < 0 || dt_s > kLeap_s || gone_m3 < -kLeastRemoved_m3) {
    if (time_s_) begin_clear();
    opened_m3_ = std::max(0.0, vascular_m3(removed_m3));
  } else if (dt_s > 0) {
    const double share = std::clamp(deeds.share_into_joint, 0.0, 1.0);
    opened_m3_ += share * std::max(0.0, vascular_m3(removed_m3) - vascular_m3(removed_m3_));
    FluidDrive drive;
    drive.pump_pa = settings_.pump_pa;
    drive.outlet_open = settings_.outlet_open;
    drive.suction = std::clamp(deeds.suction, 0.0, 1.0);
    drive.debris_m3_s = share * std::max(0.0, gone_m3) / dt_s;
    drive.bleeding_m3_s = kOoze_m_per_s * wall_m2(opened_m3_);
    state_ = step_fluid(joint_, drive, state_, dt_s);
  }
  time_s_ = time_s;
  removed_m3_ = removed_m3;
}

ScopeWater JointWater::seen() const {
  const double all = light_taken_per_m(joint_, state_);
  const double blood = joint_.blood_per_m * state_.blood;
  return {all, all > 0 ? blood / all : 0, 0};
}

}  // namespace osteon
