#include "exercises/water_watch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "osteon/scene/instrument.h"
#include "osteon/scene/portal.h"
#include "osteon/scene/tool_set.h"

namespace osteon {
namespace {

Result<std::vector<char>> lookers_of(const std::vector<std::string>& tray) {
  std::vector<char> looks(tray.size(), 0);
  if (tray.empty()) return looks;
  const auto instruments = load_instruments();
  if (!instruments) return tl::unexpected(instruments.error());
  for (std::size_t k = 0; k < tray.size(); ++k) {
    const auto name = parse_tool_name(tray[k]);
    const Instrument* found = name ? find_instrument(*instruments, name->name) : nullptr;
    looks[k] = found && found->optics ? 1 : 0;
  }
  return looks;
}

SightLost cause_of(const FluidJoint& joint, const FluidState& state) {
  FluidState clear = state;
  clear.blood = clear.debris = 0;
  if (is_obscured(joint, clear)) return SightLost::kPressure;
  const bool bloody = joint.blood_per_m * state.blood >= joint.debris_per_m * state.debris;
  return bloody ? SightLost::kBlood : SightLost::kDebris;
}

}  // namespace

WaterWatch::WaterWatch(const FluidJoint& joint, std::vector<char> looks, double tick_s,
                       bool by_portal)
    : joint_(joint),
      looks_(std::move(looks)),
      tick_s_(tick_s),
      by_portal_(by_portal),
      stride_(
          std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::lround(kStep_s / tick_s)))) {}

std::optional<WaterWatch> WaterWatch::of(const Case& the_case, const std::vector<std::string>& tray,
                                         double tick_s) {
  const auto joint = filled_joint(the_case);
  if (!joint) return std::nullopt;
  auto looks = lookers_of(tray);
  if (!looks || std::find(looks->begin(), looks->end(), 1) == looks->end()) return std::nullopt;
  return WaterWatch(*joint, std::move(*looks), tick_s, !find_portals(the_case).empty());
}

std::optional<std::size_t> WaterWatch::looking(std::span<const ToolState* const> tools) const {
  for (std::size_t h = 0; h < tools.size(); ++h)
    if (tools[h]->instrument < looks_.size() && looks_[tools[h]->instrument] &&
        (!by_portal_ || tools[h]->portal != kNoPortal))
      return h;
  return std::nullopt;
}

void WaterWatch::add(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                     std::vector<Event>& out) {
  if (tools.empty() || tools[0]->tick % stride_ != 0 || !bones.water.on) return;
  const double now_s = static_cast<double>(tools[0]->tick) * tick_s_;
  const auto hand = looking(tools);
  if (!hand) {
    was_obscured_ = false;
    return;
  }
  const FluidState state = fluid_of(bones.water);
  const bool obscured = is_obscured(joint_, state);
  count(now_s, obscured, state);
  Event event;
  event.tick = tools[*hand]->tick;
  event.kind = kWaterLooked;
  event.hand = static_cast<std::uint8_t>(*hand);
  event.p_W = tools[*hand]->X_WP.p;
  event.values = {obscured ? 1.0 : 0.0, turbidity(joint_, state), state.pressure_pa / kPa_per_mmHg};
  out.push_back(event);
}

// What is seen now counts for the time until the next look.
void WaterWatch::count(double now_s, bool obscured, const FluidState& state) {
  sight_.scope_s += kStep_s;
  if (obscured) {
    sight_.obscured_s += kStep_s;
    if (!was_obscured_) sight_.stretches.push_back({now_s, now_s, cause_of(joint_, state)});
    sight_.stretches.back().to_s = now_s + kStep_s;
  }
  was_obscured_ = obscured;
}

}  // namespace osteon
