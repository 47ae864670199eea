#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands/teaching/live_play.h"
#include "exercises/attempt_part.h"
#include "exercises/ghost/ghost_track.h"
#include "exercises/scenario_files.h"
#include "osteon/base/result.h"
#include "osteon/procedure/attempt.h"
#include "osteon/procedure/knee_exam_watch.h"
#include "osteon/procedure/portal_watch.h"
#include "osteon/procedure/report.h"
#include "osteon/scene/case.h"
#include "osteon/surgeon/skill.h"
#include "runs/reports/acl_report.h"
#include "runs/reports/graft_report.h"
#include "runs/reports/placing_report.h"

namespace osteon {

/// One attempt by a virtual surgeon, without a window, as fast as it goes or on devices.
struct ScenarioRun {
  Scenario scenario;
  std::optional<Standard> standard;
  std::string case_spec;
  Skill skill;
  std::optional<std::filesystem::path> record_to;
  std::string graft_json = {};                ///< a report of making one; empty: a graft that fits
  std::optional<StatedFindings> stated = {};  ///< none: as the surgeon's skill allows
  std::string to_stage =
      {};  ///< ends when this one is done, and is judged up to it; empty: the last
  /// Plays it in real time on these devices (play_live), and judges what was recorded; empty: as
  /// fast as it goes, without devices. They are used up.
  std::shared_ptr<std::vector<LedDevice>> live = {};
  std::function<void()> step_devices = {};  ///< of a live run without threads, as play_live has it
  bool keeps_way = false;                   ///< the outcome has the surgeon's way; not a live run's
};
struct ScenarioOutcome {
  std::vector<Report> reports;  ///< of each hand
  std::vector<std::string> hands;
  Outcome outcome;
  std::vector<std::string> unreachable;            ///< bones that the surgeon found no way to
  std::optional<AclReport> acl;                    ///< of a scenario that asks for tunnels
  std::string not_measured;                        ///< why they could not be measured
  std::optional<GraftReport> graft = {};           ///< of a case with a bench
  std::optional<PlacingReport> placing = {};       ///< of a case with tunnels for a graft
  std::optional<KneeExam> exam = {};               ///< of a scenario that has the knee examined
  std::vector<MadePortalFound> made_portals = {};  ///< in skin
  std::shared_ptr<const Case> the_case = {};
  std::string case_spec = {};
  std::optional<LivePlayed> live = {};   ///< of a live run
  bool identical = true;                 ///< of a live run: its recording repeats bit by bit
  std::optional<AttemptPart> part = {};  ///< of a run that ended with an earlier stage
  std::optional<GhostTrack> way = {};    ///< as ghost_of_recording has it of the run's recording
};
/// The report as JSON, with what was measured of its tunnels as `acl`, of a graft that was made as
/// `acl.made` (in an exercise without tunnels `acl.graft`), and how one was placed as
/// `acl.placing`, what was found of the knee by hand as `acl.examined`, and its portals
/// (portal_report.h).
std::string to_json(const ScenarioOutcome& done);
Result<ScenarioOutcome> run_scenario(const ScenarioRun& run);

}  // namespace osteon
