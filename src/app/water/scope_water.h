#pragma once

#include <optional>

#include "osteon/physics/joint_water.h"
#include "osteon/render/scope_renderer.h"
#include "osteon/scene/state.h"

namespace osteon {

/// What a user sets of a joint's water.
struct WaterSettings {
  double pump_pa = FluidDrive().pump_pa;
  double outlet_open = FluidDrive().outlet_open;
  bool operator==(const WaterSettings&) const = default;
};

/// What a scope sees of the water of a session: blood and debris in it, and the plume before each
/// wound of a soft part. Clear where `bones` have no water. `fluid`: the mixture, if not that of
/// the session.
ScopeWater scope_water(const FluidJoint& joint, const BoneSnapshot& bones,
                       const FluidState* fluid = nullptr);

/// The water of a session as it would be with the pump set otherwise: what bleeds and is removed is
/// the session's. For films; steps by their pictures.
class OtherPump {
 public:
  OtherPump(const FluidJoint& joint, const WaterSettings& settings);
  /// What there is at `time_s` of the session, later than the moment before. Where time goes back
  /// or leaps by more than a second, the water begins as it is in the session then.
  void go_to(double time_s, const WaterState& session);
  const FluidState& state() const { return state_; }

 private:
  FluidJoint joint_;
  WaterSettings settings_;
  FluidState state_;
  std::optional<double> time_s_;
};

}  // namespace osteon
