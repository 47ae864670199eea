#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/image/progress.h"
#include "osteon/record/recording.h"
#include "osteon/render/prepare.h"
#include "osteon/scene/case.h"
#include "osteon/scene/path.h"
#include "osteon/session/session.h"
#include "runs/hands/push_history.h"
#include "runs/replays/replay_track.h"
#include "runs/reports/cut_history.h"
#include "runs/reports/run_events.h"
#include "window/controllers/sessions/instrument_tray.h"

namespace osteon {

/// What to open: a case, or a recording with the case that it was made on.
struct LoadOrder {
  std::string case_spec;             ///< as open_case takes it; not used for a recording
  std::filesystem::path recording;   ///< empty: the case alone
  std::shared_ptr<const Case> open;  ///< a case that is open already, used again when it is the one
  std::vector<std::string> instruments = {};  ///< in the tray whatever the case's region is
  /// Not for a recording: a picture soon, without the light between the bones, and what no cache
  /// holds of what is felt as hulls.
  bool at_once = false;
  double at_s = 0;                      ///< of a recording: the moment that is looked at first
  std::vector<std::string> softs = {};  ///< that give way in a live run, as SessionSettings::soft
  CarveSettings carve = {};  ///< how its bones are removed in a live run; `on` is not looked at
  bool needs_softs = false;  ///< a case that does not have them fails; else the user is told
};

class ReplayFilling;

struct LoadedReplay {
  std::filesystem::path file;
  RecordingHeader header;
  ReplayTrack track;                            ///< of the first hand
  std::vector<ReplayTrack> more;                ///< of the others
  std::vector<std::string> hands;               ///< names, where there are several
  std::vector<std::string> instruments;         ///< names by their place in the tray
  Tray tray;                                    ///< what the hands held
  std::vector<Portal> portals;                  ///< of the session, by ToolState::portal
  std::shared_ptr<const CarvingSetup> carving;  ///< what they removed bone with; null: nothing
  CutHistory cuts;
  std::shared_ptr<const SoftSetup> softs;  ///< what gave way; null: nothing
  PushHistory pushes;                      ///< on that
  RunEvents events;
  bool complete = true;  ///< false: the recording ended with a kill
  bool identical = true;
  std::uint64_t first_different_tick = 0;
  std::uint64_t ticks = 0;
  double duration_s = 0;
  /// Repeats what is still missing of a long recording (window/jobs/replay_filling.h); null:
  /// nothing is.
  std::shared_ptr<ReplayFilling> filling;
};

/// What a live run of a case removes bone with.
struct PreparedCarving {
  std::shared_ptr<const CarvingSetup> setup;  ///< null: nothing can be carved
  std::string problem;  ///< why nothing can, though a bone is felt as a field; empty: none
};
/// Bones felt as fields can be carved, by the instruments of a tray; seconds for each.
PreparedCarving prepare_carving(const Case& the_case, const InstrumentTray& tray,
                                const CarveSettings& carve);
bool has_field(const Case& the_case);

/// What gives way in a live run of a case.
struct PreparedSofts {
  RunSofts softs;
  std::string problem;  ///< why what was asked for does not; empty: it does
};
/// `names`: as SessionSettings::soft has them; none: nothing is soft. About a second for each
/// meniscus.
PreparedSofts prepare_softs(const Case& the_case, const InstrumentTray& tray,
                            const std::vector<std::string>& names);

struct Loaded {
  std::shared_ptr<const Case> the_case;
  std::string case_source;
  /// Of the case with all that is felt of it, or with what it is carved with where that is all that
  /// is missing; empty: this is it.
  std::string finer_source;
  std::optional<PreparedCase> prepared;  ///< none: `open` was used again
  bool lit = true;                       ///< false: `prepared` comes from prepare_unlit
  ProbePath demo;                        ///< empty when none could be made
  std::optional<PreparedTray> tray;      ///< of the case; none: `open` was used again
  PreparedCarving carving;
  CarveSettings carve;  ///< with which that was made
  PreparedSofts softs;
  std::optional<LoadedReplay> replay;
};

/// Opens something, as the work of a SideJob.
Result<Loaded> load(const LoadOrder& order, const Progress& progress);

}  // namespace osteon
