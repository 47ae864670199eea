#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "osteon/carve/carved_field.h"
#include "osteon/physics/joint_fluid.h"
#include "osteon/render/scope_renderer.h"
#include "osteon/scene/instrument.h"
#include "osteon/scene/state.h"

namespace osteon {

/// What a user sets of a joint's water.
struct WaterSettings {
  double pump_pa = FluidDrive().pump_pa;
  double outlet_open = FluidDrive().outlet_open;
};

/// For each place of a tray, whether what lies there sucks while it has power.
using Suckers = std::vector<bool>;
Suckers suckers_of(const std::vector<std::string>& tray, std::span<const Instrument> instruments);
Result<Suckers> suckers_of(const std::vector<std::string>& tray);
/// The strongest suction of all hands, 0 to 1.
double suction_of(const Suckers& suckers, std::span<const ToolState> tools);

/// The water in a joint while a session goes on, for who draws what a scope shows. Bone that is
/// removed becomes slurry, and the soft bone and marrow that it lays open bleed; pressure stops the
/// bleeding, flow and suction clear the water. Feels nothing and changes no session: the same
/// moments give the same water.
class JointWater {
 public:
  /// Distended by clear water.
  explicit JointWater(const FluidJoint& joint);

  /// Takes effect with the next moment; settings out of range are not taken.
  void set(const WaterSettings& settings);
  const WaterSettings& settings() const { return settings_; }

  /// What there is at `time_s` of the session, later than the moment before. `removed_m3`: of all
  /// bones since the session began. Where time or bone goes back, or time leaps by more than a
  /// second, the water begins anew, clear.
  void go_to(double time_s, double suction, const ByTissue& removed_m3);

  ScopeWater seen() const;
  double turbidity() const { return osteon::turbidity(joint_, state_); }
  const FluidState& state() const { return state_; }

 private:
  void begin_clear();

  FluidJoint joint_;
  WaterSettings settings_;
  FluidState state_;
  std::optional<double> time_s_;
  ByTissue removed_m3_{};
};

}  // namespace osteon
