#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "osteon/base/percentiles.h"
#include "osteon/base/result.h"
#include "osteon/scene/case.h"
#include "osteon/scene/event.h"
#include "osteon/scene/portal.h"
#include "osteon/scene/state.h"

namespace osteon {

struct BoneReport {
  std::string name;
  double first_contact_s = -1;  ///< -1: never touched
  double contact_time_s = 0;
  double peak_force_n = 0;
  double mean_force_n = 0;  ///< over the time in contact
  double deepest_mm = 0;    ///< hand past the surface, along the normal

  bool touched() const { return first_contact_s >= 0; }
};

/// A hole in the skin that a hand's instrument may pass through.
struct PortalReport {
  std::string name;
  double time_s = 0;  ///< with a shaft in it
  std::uint64_t times_entered = 0;
};

struct Report {
  std::string case_name;
  std::uint64_t case_hash = 0;
  double duration_s = 0;
  std::vector<BoneReport> bones;                ///< all bones of the case, in its order
  std::vector<PortalReport> portals;            ///< all that were open or made, in their order
  std::map<std::string, std::uint64_t> events;  ///< how many of each kind, by its name
  double path_length_mm = 0;                    ///< of the proxy, resampled at 100 Hz
  double smoothness_sparc = 0;                  ///< spectral arc length; 0 smoothest
  double tick_p50_us = 0, tick_p99_us = 0, tick_p999_us = 0, tick_max_us = 0;
  /// Of a physics step, which serves all hands; 0 when not measured.
  double step_p50_us = 0, step_p99_us = 0, step_p999_us = 0, step_max_us = 0;
  std::uint64_t ticks = 0;
  std::uint64_t missed_ticks = 0;
  std::uint64_t state_hash = 0;
  double realtime_factor = 0;  ///< simulated over elapsed time; 0 when not measured
};

/// Gathers a report from the tool's states, one a tick. `add` allocates only when its reserved time
/// (ten minutes) is exceeded. Keeps a pointer to the case, which must outlive it.
///
/// A bone counts as touched in a tick when the tool has a contact with it; the force on a bone is
/// the magnitude of the sum over its contacts. A force or depth that is not finite counts as zero.
/// `finish` leaves the timing, `state_hash` and `realtime_factor` to whoever ran the ticks.
class ReportBuilder {
 public:
  /// `portals`: of the session, by ToolState::portal.
  explicit ReportBuilder(const Case& the_case, double tick_s = 0.001,
                         std::span<const Portal> portals = {});
  void add(const ToolState& tool);
  /// Of the same hand. Allocates nothing.
  void add(const Event& event);
  Report finish() const;

 private:
  struct BoneTally {
    double first_s = -1, time_s = 0, peak_n = 0, sum_n = 0, deepest_m = 0;
    std::uint64_t contact_ticks = 0;
  };
  void add_contacts(const ToolState& tool);
  void add_portal(std::uint32_t portal);
  void add_position(const Vec3& p_WP);

  const Case* case_;
  double tick_s_;
  std::uint64_t stride_;  // ticks from one sample of the path to the next
  std::uint64_t ticks_ = 0;
  std::vector<BoneTally> tallies_;
  std::vector<PortalReport> portals_;
  std::vector<bool> to_make_;  ///< of portals_: nothing is said of it while no shaft has been in it
  std::vector<std::uint64_t> portal_ticks_;
  std::vector<std::uint64_t> events_;  // by place in event_table()
  std::uint32_t portal_ = kNoPortal;
  std::vector<Vec3> path_100hz_;
  Vec3 last_p_WP_ = Vec3::Zero();
};

/// Fills tick_p50_us ... tick_max_us from measured durations.
void set_tick_times(Report& report, const Percentiles& durations);
/// Likewise step_p50_us ... step_max_us.
void set_step_times(Report& report, const Percentiles& durations);

/// A report as JSON, in this order; the same text in every locale:
/// ```
/// { "case": "wrist", "case_hash": "<16 hex digits>", "duration_s": 60.0, "ticks": 60000,
///   "bones": { "<name>": { "first_contact_s": 1.2,   (-1: never touched)
///                          "contact_time_s": 3.4, "peak_force_n": 2.1, "mean_force_n": 1.0,
///                          "deepest_mm": 0.8 }, ... all bones of the case ... },
///   "portals": { "<name>": { "time_s": 12.5, "times_entered": 2 }, ... },   (where any is open)
///   "events": { "contact_begin": 12, ... },   (kinds that there were; left out where there was
///   none) "path_length_mm": 812.5, "smoothness_sparc": -7.1, "state_hash": "<16 hex digits>",
///   "tick_us": { "p50": 9.1, "p99": 20.3, "p999": 31.0, "max": 55.7 },
///   "step_us": { ... the same of a physics step ... },   (where it was measured: in a replay)
///   "missed_ticks": 0, "realtime_factor": 41.0 }
/// ```
/// Up to `state_hash` a report depends on case and input alone; `tick_us`, `step_us`,
/// `missed_ticks` and `realtime_factor` depend on the machine.
std::string to_json(const Report& report);
/// Table for a terminal; bones that were never touched share its last line.
std::string to_text(const Report& report);

/// Spectral arc length of a speed profile sampled at `rate_hz` (Balasubramanian, Melendez-Calderon,
/// Roby-Brami, Burdet, "On the analysis of movement smoothness", 2015, equations 9-10): cut-off at
/// most 10 Hz, amplitude threshold 0.05, zero-padding level 4 (less beyond 2^18 samples, to bound
/// the memory). Negative; nearer 0 is smoother. Does not depend on the amplitude. 0 for fewer than
/// 2 samples, no movement, or a sample that is not finite.
double sparc(const std::vector<double>& speed, double rate_hz);

/// Compares a report with an expectation. One line a deviation; empty when all hold. Fails on a
/// malformed expectation: not JSON, an unknown or repeated key, a bone that the case does not have,
/// an empty range, or one that expects nothing.
///
/// The expectation is JSON; every key is optional:
/// ```
/// { "case": "wrist",                       the report's case
///   "touched": ["radius", "lunate"],       bones that must be touched
///   "untouched": ["hamate"],               bones that must not; or "all_others": every bone that
///                                          neither "touched" nor "order" nor "bones" names
///   "order": ["radius", "lunate"],         touched, first contacts in this order
///   "bones": { "lunate": { "first_contact_s": RANGE, "contact_time_s": RANGE,
///                          "peak_force_n": RANGE, "mean_force_n": RANGE, "deepest_mm": RANGE } },
///   "path_length_mm": RANGE, "duration_s": RANGE, "smoothness_sparc": RANGE, "ticks": RANGE,
///   "missed_ticks": RANGE, "realtime_factor": RANGE,
///   "tick_us": { "p50": RANGE, "p99": RANGE, "p999": RANGE, "max": RANGE },
///   "state_hash": "<16 hex digits>" }
/// ```
/// RANGE is `{"min": a, "max": b}` (one of them may be missing), `{"value": v, "abs": t}` (v - t to
/// v + t) or `{"value": v, "rel": r}` (v - r |v| to v + r |v|); the ends belong to it. A bone with
/// ranges must be touched.
Result<std::vector<std::string>> check_expectation(const Report& report,
                                                   const std::string& expectation_json);

}  // namespace osteon
