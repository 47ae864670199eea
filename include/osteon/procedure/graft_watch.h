#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "osteon/scene/event.h"
#include "osteon/scene/graft_bench.h"
#include "osteon/scene/state.h"

namespace osteon {

// Codes of events that who watches a graft being made makes; the session makes none of them.
/// A band of a tendon was cut: {bands left, of both; 0; 0}.
inline constexpr EventKind kBandCut{450};
/// A tendon came out: {its length mm; 1: cut off at a band; tendons stripped whole}.
inline constexpr EventKind kTendonStripped{451};
/// A tendon was folded: {strands of the graft; 0; 0}.
inline constexpr EventKind kTendonFolded{452};
/// A sizer passed, or did not: {smallest that passed mm; largest that did not mm; length mm}; 0:
/// none yet.
inline constexpr EventKind kGraftSized{453};
/// The board has kept the graft stretched: {for how long, as if at 80 N, s; tension N; 0}.
inline constexpr EventKind kGraftTensioned{454};
/// A button's loop hangs on the graft: {loop mm; graft in the socket mm; 1: the button can turn}.
inline constexpr EventKind kLoopHung{455};
/// What was measured when the loop was hung: {a GraftValue; the value; 0}.
inline constexpr EventKind kGraftMeasured{456};

/// Muscle was scraped off a tendon, in steps of a tenth: {what is left, of the tendon that has more
/// of it, %; 0; 0}.
inline constexpr EventKind kMuscleScraped{465};
/// Thread went through a tendon's end: {passes, of the tendon that has fewer; 0; 0}.
inline constexpr EventKind kTendonStitched{466};

/// The fascia over the tendons was opened farther: {its longest open stretch mm; 0; 0}.
inline constexpr EventKind kFasciaOpened{475};
/// A tendon was lifted out from under the fascia: {tendons found; 0; 0}.
inline constexpr EventKind kTendonFound{476};
/// A blade on the fascia hurt what lies by it: {0: the medial collateral ligament, 1: the saphenous
/// nerve; 0; 0}.
inline constexpr EventKind kByFasciaHurt{477};

/// What is measured of a graft.
enum class GraftValue : std::uint8_t {
  kDiameter,
  kLength,
  kStrands,
  kInSocket,
  kCreepLeft,
  kMuscleLeft,  ///< of the tendon that has more of it
  kStitches,    ///< passes of thread, of the tendon that has fewer
  kTunnelOver   ///< how much wider than its sizer the wider tunnel is; only in a knee
};
/// By GraftValue: names with their units, each of a rule `outside_NAME` for errors.
inline constexpr std::array<std::string_view, 8> kGraftValueNames{
    "graft_diameter_mm",    "graft_length_mm",       "graft_strands",  "graft_in_socket_mm",
    "graft_creep_left_pct", "graft_muscle_left_pct", "graft_stitches", "tunnel_over_graft_mm"};

/// The tunnels that a graft is for, as they were measured in a knee.
struct GraftRoom {
  double channel_m = 0, socket_m = 0;  ///< of the femur
  double narrow_m = 0, wide_m = 0;     ///< the narrower and the wider of both tunnels
};

/// Follows a bench's graft by what snapshots say. A function of them: a replay finds the same. The
/// hand of an event is the first.
class GraftWatch {
 public:
  explicit GraftWatch(const Case& the_case);
  /// The graft is for tunnels that are drilled and measured, not for the bench's own channel: its
  /// loop is judged once they are known. None: they are not, or no longer.
  void set_room(const std::optional<GraftRoom>& room);
  void add(std::uint64_t tick, const BoneSnapshot& bones, std::vector<Event>& out);
  /// The bench as last seen; none: the case has none.
  const std::optional<GraftBenchPlan>& plan() const { return plan_; }
  const GraftBenchState& state() const { return seen_; }

 private:
  void tell_finding(std::uint64_t tick, const GraftBenchState& now, std::vector<Event>& out) const;
  void tell_tendons(std::uint64_t tick, const GraftBenchState& now, std::vector<Event>& out) const;
  void tell_table_work(std::uint64_t tick, const GraftBenchState& now,
                       std::vector<Event>& out) const;
  void tell_graft(std::uint64_t tick, const GraftBenchState& now, std::vector<Event>& out);

  void tell_loop(std::uint64_t tick, const Graft& graft, const GraftBenchState& now,
                 std::vector<Event>& out);

  std::optional<GraftBenchPlan> plan_;
  GraftBenchState seen_;
  std::optional<GraftRoom> room_;
  bool drilled_ = false;  ///< the tunnels are: without a room nothing fits or does not
  double told_creep_s_ = 0, told_loop_m_ = 0;
};

}  // namespace osteon
