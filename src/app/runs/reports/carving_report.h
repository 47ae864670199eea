#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "osteon/carve/removed.h"
#include "osteon/physics/carving.h"
#include "osteon/physics/heat_pulse.h"
#include "osteon/session/session.h"

namespace osteon {

/// What was carved in a run, and how warm it got.
struct CarvingReport {
  std::vector<std::string> bones;    ///< of the case
  std::vector<ByTissue> removed_m3;  ///< of each bone
  std::vector<Event> events;         ///< codes 200 to 299
  double tick_s = 0.001;
  double most_thrust_n = 0, most_torque_nm = 0;
  double hottest_c = 37;
  std::array<double, 2> necrosis_m3{};
  std::vector<std::array<double, 2>> necrosis_by_bone_m3;  ///< as `bones`; none: nothing was warm
  double water_m3 = 0;            ///< that flowed over the bones while heat was followed
  double dust_m3 = 0;             ///< hung on nothing and fell off, too small for an event
  std::vector<double> pieces_m3;  ///< the same, each with its event
  /// A piece that lies loose, or is held, at the end.
  struct Loose {
    std::uint32_t bone = 0;
    double volume_m3 = 0, mass_kg = 0;
    Vec3 p_W = Vec3::Zero();  ///< of its middle
    bool held = false;
  };
  std::vector<Loose> loose;
};
/// "removed_mm3", "removed_by_tissue_mm3", "removed_by_bone_mm3", "heat", "events" ...
nlohmann::ordered_json to_json(const CarvingReport& report);
std::string to_text(const CarvingReport& report);

/// Follows the heat in the bones of a session, tick by tick.
class SessionHeat {
 public:
  /// After each tick.
  void see(const Session& session);
  /// None: nothing can be carved in that session.
  const std::optional<HeatOfBones>& bones() const { return heat_; }
  double water_m3() const { return water_m3_; }

 private:
  std::optional<HeatPulses> pulses_;
  std::optional<HeatOfBones> heat_;
  double water_m3_ = 0;
  std::uint64_t step_ = 0;
};

/// Looks at a session that carves, tick by tick, and follows the heat in the bones that are cut.
class CarvingWatch {
 public:
  /// After each tick.
  void see(const Session& session);
  /// None: nothing can be carved in that session.
  std::optional<CarvingReport> finish(const Session& session) const;

 private:
  CarvingReport report_;
  SessionHeat heat_;
};

}  // namespace osteon
