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

/// For each place of a tray, what lies there does to the water while it has power.
struct WaterTools {
  std::vector<bool> sucks, removes;
  bool operator==(const WaterTools&) const = default;
};
WaterTools water_tools_of(const std::vector<std::string>& tray,
                          std::span<const Instrument> instruments);
Result<WaterTools> water_tools_of(const std::vector<std::string>& tray);

/// What hands do to the water at a moment.
struct WaterDeeds {
  double suction = 0;  ///< the strongest of all hands, 0 to 1
  /// Of the bone that is removed, and of the wall that bleeds, 0 to 1. The chips and the blood of a
  /// drill that comes from outside leave along its flutes, all but a fifth (D); what works through
  /// a portal leaves all of them in the joint.
  double share_into_joint = 1;
};
WaterDeeds deeds_of(const WaterTools& which, std::span<const ToolState> tools);

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
  void go_to(double time_s, const WaterDeeds& deeds, const ByTissue& removed_m3);

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
  double opened_m3_ = 0;  ///< soft bone and marrow whose wall bleeds into the joint
};

}  // namespace osteon
