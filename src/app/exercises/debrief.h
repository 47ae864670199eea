#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "exercises/attempt_part.h"
#include "exercises/damage_map.h"
#include "exercises/ghost/ghost_track.h"
#include "osteon/base/result.h"
#include "osteon/procedure/attempt.h"
#include "osteon/procedure/judge.h"
#include "osteon/procedure/knee_exam_watch.h"
#include "osteon/procedure/portal_watch.h"
#include "osteon/procedure/report.h"
#include "osteon/procedure/scenario.h"
#include "osteon/render/renderer.h"
#include "osteon/scene/state.h"
#include "runs/reports/acl_report.h"
#include "runs/reports/graft_report.h"
#include "runs/reports/placing_report.h"

namespace osteon {

/// One hand over a repeated attempt, 20 values a second.
struct HandTrace {
  std::string name;
  std::vector<double> time_s;
  std::vector<double> force_n;      ///< the greatest since the value before
  std::vector<Vec3> tip_W;          ///< m
  std::vector<BoneReport> touched;  ///< bones that it touched, the hardest pressed first
};

/// What a recording shows once it has been repeated and judged again.
struct Debrief {
  std::string case_name, surgeon;
  double duration_s = 0;
  bool identical = true;             ///< repeated bit by bit
  std::optional<Scenario> scenario;  ///< none: the recording contains no exercise
  std::optional<Outcome> outcome;
  std::optional<double> pass_score = {};      ///< that its standard wants
  std::optional<AclReport> acl;               ///< of an exercise that asks for tunnels
  std::optional<GraftReport> graft = {};      ///< of a graft that was made at a bench
  std::optional<PlacingReport> placing = {};  ///< of a graft that was placed
  std::optional<KneeExam> exam = {};          ///< of a knee that was to be examined by hand
  std::vector<MadePortalFound> made_portals = {};
  std::optional<AttemptPart> part = {};  ///< that was played; none: all. Times are since its begin
  std::string not_measured;              ///< why they could not be measured
  std::vector<Report> reports;           ///< of each of `hands`
  std::vector<HandTrace> hands;
  std::string case_spec;  ///< of the case that it was repeated on
  std::shared_ptr<const Case> the_case;
  DamageMap damage;                       ///< what all hands left on the surfaces
  double guided_s = 0;                    ///< how long a hand was led along an expert's way
  std::vector<std::vector<Vec3>> expert;  ///< an expert's tips beside `hands`; none: not known
};

/// A picture of the scene with what was done in it.
struct DebriefPicture {
  std::string title;
  Image image;
};

struct DebriefOrder {
  std::filesystem::path recording;
  std::string case_spec, scenario, standard;  ///< empty: the recording's own
  /// Of a recording of an exercise, after each tick: the hands' tools and how far the attempt is.
  /// Empty: nobody is told.
  std::function<void(std::span<const ToolState* const>, const ScenarioState&)> on_judged = {};
  /// About a hundred times: which share of the recording has been repeated. May be empty.
  std::function<void(double)> on_share = {};
};
Result<Debrief> make_debrief(const DebriefOrder& order);
/// The report of the attempt as JSON, as `osteon run` writes it.
std::string report_of(const Debrief& debrief);

/// Puts an expert's ways beside those of the hands.
void show_expert(const GhostTrack& track, Debrief& debrief);
/// The learner's hands may be shown an expert: the exercise allows it, and they are not the
/// virtual expert's own.
bool wants_expert(const Debrief& debrief);

/// Pages to print: verdict and score with its interval, stages and errors on the line of time with
/// the force, forces by structure, metrics, and each hand's way, an expert's beside it, seen from
/// above and from the side. `pictures`: of draw_debrief, if any.
Result<void> save_debrief(const Debrief& debrief, const std::filesystem::path& file,
                          std::span<const DebriefPicture> pictures = {});

}  // namespace osteon
