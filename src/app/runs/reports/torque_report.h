#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "osteon/scene/portal.h"
#include "osteon/scene/state.h"
#include "osteon/session/session.h"

namespace osteon {

/// What a hand's grip bore in a run: the moment of contacts and portals about it (moment_at_grip).
struct TorqueReport {
  double peak_nm = 0;
  double peak_at_s = -1;  ///< -1: there was none
  double mean_nm = 0;     ///< over the ticks with any
};
/// "peak_nm", "peak_at_s", "mean_nm".
nlohmann::ordered_json to_json(const TorqueReport& report);
/// A line for a terminal; empty where there was none.
std::string to_text(const TorqueReport& report);

/// Gathers it for every hand, tick by tick.
class TorqueWatch {
 public:
  /// Of a session with this tray and these portals.
  TorqueWatch(Tray tray, std::vector<Portal> portals, std::size_t hands);
  /// Some instrument has a shaft: without one, all acts at the tip that is held.
  bool has_levers() const;
  Vec3 moment_W(const ToolState& tool) const;
  void see(std::size_t hand, const ToolState& tool);
  std::vector<TorqueReport> finish() const;

 private:
  struct Tally {
    double peak_nm = 0, peak_at_s = -1, sum_nm = 0;
    std::uint64_t ticks = 0;
  };
  Tray tray_;
  std::vector<Portal> portals_;
  std::vector<Tally> hands_;
};

/// Reports of one hand (an empty `names`) or several with "torque" beside each hand's own keys; as
/// they were where `torques` is empty.
std::string with_torque(const std::string& reports_json, std::span<const TorqueReport> torques,
                        std::span<const std::string> names);

}  // namespace osteon
