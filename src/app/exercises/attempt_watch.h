#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "exercises/attempt_part.h"
#include "exercises/attempt_pause.h"
#include "exercises/tunnel_watch.h"
#include "exercises/water_watch.h"
#include "osteon/base/result.h"
#include "osteon/procedure/attempt.h"
#include "osteon/procedure/cut_watch.h"
#include "osteon/procedure/graft_watch.h"
#include "osteon/procedure/knee_exam_watch.h"
#include "osteon/procedure/placing_watch.h"
#include "osteon/procedure/portal_watch.h"
#include "osteon/procedure/ring_watch.h"
#include "osteon/procedure/scope_watch.h"
#include "osteon/procedure/skin_watch.h"
#include "osteon/procedure/sound_part_watch.h"
#include "osteon/procedure/stump_watch.h"
#include "osteon/procedure/tool_events.h"
#include "osteon/scene/instrument.h"

namespace osteon {

/// What a scenario's hand holds; of a scenario without hands the wrist probe.
struct PlannedHand {
  std::string name;
  std::string instrument;  ///< as a tray names it
  std::optional<ScopeOptics> optics;
  std::optional<Vec3> portal_W;
  double shaft_radius_m = 0.00075;
  double tip_radius_m = 0.00075;
  bool removes = false;                ///< bone
  Vec3 shaft_offset_T = Vec3::Zero();  ///< the shaft's axis runs along z of Tool through this point
  bool pin = false;                    ///< what it holds locates tunnels
  std::vector<std::string> also = {};  ///< what it may take beside its instrument
};
/// Fails on an instrument that there is none of, and on a portal that the case lacks.
Result<std::vector<PlannedHand>> plan_hands(const Scenario& scenario, const Case& the_case);

/// Judges an attempt tick by tick. A function of what the hands' tools did. The plan, the case and
/// the hands must outlive it.
class AttemptWatch {
 public:
  AttemptWatch(const ScenarioPlan& plan, const Case& the_case, std::span<const PlannedHand> hands,
               double tick_s);
  void add(std::span<const ToolState* const> tools, const BoneSnapshot& bones);
  /// A restore point was set, or the session went back to one: before the tick that comes next.
  /// What was done since is to be done again; of a part not what was done before it.
  void keep(std::uint32_t mark) { marks_[mark] = state_; }
  void go_back(std::uint32_t mark);
  bool over() const { return state_.over; }
  const ScenarioState& state() const { return state_; }
  /// `stated`: what the learner says is wrong with the patient.
  Result<Outcome> finish(const Standard* standard, const StatedFindings& stated = {});
  /// Ticks that do not count: the clock stands, nothing is judged. Those of the future as well, so
  /// that a pause may be told as it begins.
  void set_pauses(std::vector<AttemptPause> pauses) { pauses_ = std::move(pauses); }
  /// The attempt is over with the part's last stage, and its outcome tells of the part alone. Until
  /// the part begins everything is judged, but nothing is measured. `part`: of the scenario;
  /// before the first tick, and again once its first tick is known.
  void set_part(const AttemptPart& part, PartStages stages);
  /// Of the attempt, or its part: pauses left out.
  double now_s() const;
  /// When the part began; 0: there is none.
  double part_from_s() const { return part_ ? part_->from_s : 0; }
  /// Measures tunnels, where the scenario asks for it; once, before the first tick.
  void watch_tunnels(TunnelSources sources);
  /// From now on tunnels are measured on another thread, with what is left of the bones as `carved`
  /// tells.
  void go_on_live(std::function<std::optional<CarvedField>(std::uint32_t)> carved) {
    if (tunnels_) tunnels_->go_on_live(std::move(carved));
  }
  /// Null: the scenario does not ask for tunnels.
  const TunnelWatch* tunnels() const { return tunnels_ ? &*tunnels_ : nullptr; }
  /// Follows the water in the joint, where the tray has a scope, its needles, and what clears soft
  /// tissue; once, before the first tick.
  void watch_tray(const std::vector<std::string>& tray);
  /// Of a case with a bench.
  const GraftWatch& graft() const { return graft_; }
  const PlacingWatch& placing() const { return placing_; }
  /// Portals that were made in skin.
  const std::vector<MadePortalFound>& made_portals() const { return portals_->found(); }
  /// What was found of the knee by hand; none: the scenario does not ask for it.
  std::optional<KneeExam> exam() const;
  /// Of what torn ligaments have left; none: it is not felt.
  std::optional<int> cleared_percent() const { return stumps_->percent(); }
  /// Whether what clears them would be watched now; none: nothing is in a portal that could.
  std::optional<bool> clears_watched(std::span<const ToolState* const> tools,
                                     const BoneSnapshot& bones) const {
    const auto watched = stumps_->is_tip_watched(tools, bones);
    return watched && water_ && water_->is_obscured_now() ? false : watched;
  }

 private:
  struct Part {
    PartStages stages;
    std::uint64_t from_tick = 0;
    double from_s = 0;
  };
  struct HandCut {
    std::size_t hand = 0;
    CutWatch watch;
  };
  void note_held(std::span<const ToolState* const> tools);
  void judge_fresh();
  Result<Outcome> outcome_of_all(Metrics metrics, const Standard* standard,
                                 const StatedFindings& stated) const;
  void add_counted(std::span<const ToolState* const> tools, const BoneSnapshot& bones);

  const ScenarioPlan* plan_;
  const Case* case_;
  double tick_s_;
  std::vector<ToolEvents> events_;
  std::vector<ScopeWatch> scopes_;
  std::vector<char> pins_;  // by hand
  std::optional<TunnelWatch> tunnels_;
  std::optional<WaterWatch> water_;
  AttemptMeter meter_;  // of the first hand
  ScenarioState state_;
  std::map<std::uint32_t, ScenarioState> marks_;  ///< by number
  bool tells_tips_ = false;
  std::vector<HandCut> cuts_;
  RingWatch rings_;
  GraftWatch graft_;
  PlacingWatch placing_;
  std::optional<StumpWatch> stumps_;
  SkinWatch skin_;
  std::optional<SoundPartWatch> sound_parts_;
  KneeExamWatch exam_;
  std::optional<PortalWatch> portals_;
  std::vector<AttemptPause> pauses_;
  std::optional<Part> part_;
  std::vector<ToolState> shifted_;
  std::vector<const ToolState*> shifted_tools_;
  std::vector<std::string> tray_;       ///< by ToolState::instrument
  std::vector<std::string_view> held_;  ///< by hand: a name of tray_, or nothing
  std::vector<Event> fresh_;
  double now_s_ = 0;
};

}  // namespace osteon
