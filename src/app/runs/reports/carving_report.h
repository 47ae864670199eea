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
#include "osteon/session/session.h"
#include "runs/reports/bone_heat.h"

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

/// Looks at a session that carves, tick by tick, and follows the heat about the first place that is
/// cut.
class CarvingWatch {
 public:
  /// After each tick.
  void see(const Session& session);
  /// None: nothing can be carved in that session.
  std::optional<CarvingReport> finish(const Session& session) const;

 private:
  void warm(const CarvingReadout& readout, const DrillTable& table, double step_s);

  CarvingReport report_;
  std::optional<BoneHeat> heat_;
};

}  // namespace osteon
