#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "exercises/drill_watch.h"
#include "osteon/carve/carved_field.h"
#include "osteon/procedure/graft_watch.h"
#include "osteon/procedure/judge.h"
#include "osteon/scene/placing.h"
#include "osteon/scene/state.h"
#include "runs/reports/acl_report.h"
#include "runs/reports/drilled_bone.h"
#include "runs/reports/graft_report.h"
#include "runs/reports/old_tunnels.h"

namespace osteon {

/// Whether a scenario asks about landmarks felt or tunnels.
bool asks_about_tunnels(const ScenarioPlan& plan);

/// What locates tunnels.
inline constexpr std::string_view kGuidePin = "guide_pin";

/// What is known of a run beside its tools.
struct TunnelSources {
  std::string case_spec;          ///< names the case: its knee, stretched out, is grown to measure
  std::vector<std::string> tray;  ///< of the session
  /// A copy of a bone as it is now, by its number in the case; none: nothing was cut from it.
  std::function<std::optional<CarvedField>(std::uint32_t)> carved = {};
  /// Measures on another thread and tells when that is done: for who may not wait. What is told
  /// then comes at a later tick than elsewhere.
  bool in_background = false;
  std::optional<MadeGraft> graft = {};  ///< none: one that fits, made as an expert does
};

/// Makes the events of tunnel_events.h from what hands did in a knee. The line of a tunnel is that
/// of a pin which is pressed on a bone and held still: from its tip along its axis, as deep as the
/// scenario says or through the bone. Of each bone the last line counts; all is measured once each
/// bone has one, anew whenever one changes, and as the attempt ends. Where the scenario asks for
/// tunnels that are drilled, their lines are the axes of holes found in what is left of the bones:
/// looked for when drills and pins are out of a bone, and as the attempt ends. A function of the
/// tools' states and the cuts: a replay makes the same events. The plan and the case must outlive
/// it.
class TunnelWatch {
 public:
  /// `pins`: of each hand whether it holds a pin. `widths_m`: of each instrument of the tray how
  /// wide it drills, 0: it does not.
  TunnelWatch(const ScenarioPlan& plan, const Case& the_case, TunnelSources sources,
              std::vector<char> pins, std::vector<double> widths_m, double tick_s);
  void add(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
           std::vector<Event>& out);
  /// The attempt is over: what was not measured yet is.
  void finish(std::vector<Event>& out);
  /// See AttemptWatch::go_on_live.
  void go_on_live(std::function<std::optional<CarvedField>(std::uint32_t)> carved) {
    sources_.carved = std::move(carved);
    sources_.in_background = true;
  }
  /// What was measured.
  const AclReport& report() const { return work_.report; }
  /// A graft for both tunnels as they were measured last; none: there are no two, or what was
  /// measured is no longer what there is, or the graft is still being made at a bench.
  std::optional<PlacingPlan> placing() const { return at_hand_ ? placing_ : std::nullopt; }
  /// The graft that is fixed in the knee, as the tests of it had it; none: none is, or it is being
  /// tested.
  std::optional<KneeGraft> fixed() const;
  /// Grows the knee before anything was drilled in it.
  const std::string& whole_spec() const { return work_.spec; }
  /// What there is for a graft, whether one has been made or not.
  std::optional<GraftRoom> room() const { return at_hand_ ? room_ : std::nullopt; }
  /// Why tunnels could not be measured: their line misses what it must meet, for example.
  const std::optional<Error>& problem() const { return refused_ ? refused_ : work_.problem; }

 private:
  static constexpr std::size_t kBones = 2;  ///< femur, tibia
  /// How a pin must be held, and what its line becomes.
  struct Wanted {
    bool asked = false;
    double force_n = 0.3, for_s = 1, depth_m = 0, reamed_m = 0.008;
  };
  struct Line {
    bool known = false;
    Vec3 from_B = Vec3::Zero(), to_B = Vec3::Zero();
    double wide_m = 0.008;
    bool open = false;  ///< at both ends, as was seen in what is left
  };
  /// What is measured, and what comes of it.
  struct Work {
    std::string spec;            ///< before any tunnel
    const Case* felt = nullptr;  ///< as it is at the beginning of the attempt
    std::array<std::uint32_t, kBones> bones{kNoSubject, kNoSubject};  ///< of that case
    bool had_tunnels = false;                                         ///< at the beginning
    std::optional<OldHoles> old;           ///< none: not looked for yet, or there were none
    std::shared_ptr<const CaseDef> whole;  ///< stretched out; null: to be grown
    std::array<std::string, kBones> names;
    std::array<Line, kBones> lines;
    std::array<std::optional<CarvedField>, kBones> cuts;  ///< none: the line stands
    std::array<std::optional<DrilledHole>, kBones> holes;
    std::array<bool, kBones> is_new{};    ///< not told yet
    std::optional<GraftChoices> choices;  ///< of a graft that was fixed
    AclReport report;
    std::optional<Error> problem;
  };
  static Work measured(Work work);
  static void find_lines(Work& work);
  static DrilledLine in_world(const Work& work, std::size_t k, const DrilledLine& line_B);
  static Result<AclReport> report_of(Work& work);
  /// A pin on a bone.
  struct Hold {
    std::size_t bone = kBones;
    std::uint64_t since = 0;
    Vec3 tip_B = Vec3::Zero();
    bool told = false;
  };
  /// A landmark that is to be felt.
  struct FeltMark {
    std::uint32_t landmark = 0;
    std::uint32_t soft = kNoSubject;  ///< the meniscus that it lies on
  };
  void see_marks(const ToolState& tool, std::size_t hand, const BoneSnapshot& bones,
                 std::vector<Event>& out) const;
  void follow_pin(const ToolState& tool, std::size_t hand, const BoneSnapshot& bones,
                  std::vector<Event>& out);
  std::size_t pressed(const ToolState& tool, const BoneSnapshot& bones) const;
  void locate(const ToolState& tool, std::size_t hand, const Pose& X_BT, std::vector<Event>& out);
  bool all_located() const;
  void follow_drills(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                     std::vector<Event>& out);
  void take_cuts(std::size_t k);
  void look_again(const BoneSnapshot& bones);
  void follow_fixing(const BoneSnapshot& bones, std::vector<Event>& out);
  void plan_graft();
  void follow_bench(const GraftBenchState& bench);
  Event measured_at() const;
  void measure(const Event& at, std::vector<Event>& out);
  void tell_measured(const Event& at, std::vector<Event>& out);
  void tell_drilled(const Event& at, std::vector<Event>& out) const;

  const Case* case_;
  TunnelSources sources_;
  std::vector<char> pins_;
  double tick_s_;
  std::uint64_t stride_;
  std::vector<FeltMark> felt_;
  std::array<std::uint32_t, kBones> bones_{kNoSubject, kNoSubject};
  std::array<Wanted, kBones> wanted_;
  std::array<Line, kBones> lines_;
  std::vector<Hold> holds_;  ///< by hand
  std::uint64_t last_tick_ = 0;
  bool fresh_ = false;                 ///< a line has changed since they were measured
  std::optional<DrillWatch> drills_;   ///< none: tunnels are located alone
  std::array<bool, kBones> untold_{};  ///< measured, but not through yet
  bool over_ = false;                  ///< the attempt: what is, is judged
  std::array<bool, kBones> is_socket_{};
  std::optional<PlacingPlan> placing_;
  std::optional<GraftRoom> room_;
  std::optional<GraftBenchPlan> bench_;  ///< none: the graft is made elsewhere
  std::optional<Error> refused_;         ///< why the graft does not go into the tunnels
  std::optional<MadeGraft> made_;        ///< of the bench; none: no button hangs on it
  bool at_hand_ = false;                 ///< what placing_ says stands in the bones
  std::uint32_t epoch_ = 0;              ///< of the bones that were seen last
  std::uint32_t measured_epoch_ = 0;     ///< of the bones when they were measured last
  bool fixed_ = false;                   ///< a graft is, and was tested
  Work work_;
  std::future<Work> job_;  ///< of what is measured in the background
  Event asked_;            ///< who asked for it
};

}  // namespace osteon
