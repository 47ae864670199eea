#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "osteon/session/session.h"

namespace osteon {

/// What soft parts have met in a run.
struct SoftReport {
  struct Part {
    std::string name;
    double peak_force_n = 0;    ///< of a hand on it
    double peak_tension_n = 0;  ///< of the whole part, by bones and hands
    double first_tension_n = 0;
    double contact_s = 0;
    bool is_solid = false;       ///< it has no tension
    bool is_skin = false;        ///< a patch; nor has this
    double deepest_mm = 0;       ///< of a solid: how far it gave way
    double held_open_mm = 0;     ///< of skin: how far lips stood apart at a tool that held them
    double removed_mm3 = 0;      ///< of a solid: by cuts
    std::uint32_t pieces = 0;    ///< that came off
    bool is_stump = false;       ///< a solid of which something is to be cleared
    double cleared_percent = 0;  ///< of that
    double cut_mm = 0;           ///< of skin: length that is open
    std::uint32_t holes = 0;     ///< of skin: that trocars have made
    std::uint32_t portals = 0;   ///< of skin: that were made in it
    bool whole = true;           ///< at the end; torn by a finding or in the run: false
    bool lost = false;           ///< it could not be solved
  };
  /// A piece that was cut off and lies loose at the end.
  struct Loose {
    std::uint32_t part = 0;  ///< in `subjects`
    double volume_mm3 = 0;
    Vec3 p_W = Vec3::Zero();  ///< of its middle
    bool held = false;
  };
  std::vector<Part> parts;
  std::vector<Loose> loose;
  std::vector<Event> events;          ///< codes 100 to 199
  std::vector<std::string> subjects;  ///< soft parts of the case
  std::vector<std::string> portals;   ///< of the session
  double tick_s = 0.001;
};
/// "parts": "name", "peak_force_n", "peak_tension_n", "contact_s" ...; "events".
nlohmann::ordered_json to_json(const SoftReport& report);
std::string to_text(const SoftReport& report);

/// Looks at a session with soft parts, tick by tick.
class SoftWatch {
 public:
  /// After each tick.
  void see(const Session& session);
  /// None: nothing is soft in that session.
  std::optional<SoftReport> finish(const Session& session) const;

 private:
  void see_step(const Session& session);

  SoftReport report_;
};

}  // namespace osteon
