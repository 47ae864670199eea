#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "osteon/procedure/sight_events.h"
#include "osteon/scene/case.h"
#include "osteon/scene/event.h"
#include "osteon/scene/state.h"
#include "water/joint_water.h"

namespace osteon {

/// What is known of a run's water beside its tools.
struct WaterSources {
  std::vector<std::string> tray;  ///< of the session
  /// Bone that is gone since the session began, m3, asked a few times a second; none: no bone goes.
  std::function<ByTissue()> removed = {};
};

/// Whether a joint of this case is filled with water: a wrist or a knee, no box of exercises.
bool holds_water(const Case& the_case);

/// Follows the water in a joint through an attempt and tells when a scope shows nothing: for want
/// of pressure, or for blood and debris. The pump stands as it does where nobody has set it. A
/// function of the tools' states and of the bone that is gone: a replay tells the same.
class WaterWatch {
 public:
  /// `looks`: of each instrument of the tray whether one looks through it.
  WaterWatch(const FluidJoint& joint, std::vector<char> looks, WaterTools which,
             std::function<ByTissue()> removed, double tick_s);
  /// None where the case holds no water or no instrument of the tray looks.
  static std::optional<WaterWatch> of(const Case& the_case, WaterSources sources, double tick_s);

  /// Adds the tick's events to `out`.
  void add(std::span<const ToolState* const> tools, std::vector<Event>& out);
  const ObscuredSight& sight() const { return sight_; }
  const JointWater& water() const { return water_; }

 private:
  static constexpr double kStep_s = 0.1;

  std::optional<std::size_t> looking(std::span<const ToolState* const> tools) const;
  void count(double now_s, bool obscured);

  FluidJoint joint_;
  JointWater water_;
  std::vector<char> looks_;  // by place in the tray
  WaterTools which_;
  std::function<ByTissue()> removed_;
  double tick_s_;
  std::uint64_t stride_;
  ObscuredSight sight_;
  bool was_obscured_ = false;
};

}  // namespace osteon
