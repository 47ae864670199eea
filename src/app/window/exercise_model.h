#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace osteon {

/// Where the user is with an exercise.
enum class ExercisePage {
  kClosed,
  kCourse,    ///< all exercises
  kBriefing,  ///< what one of them asks
  kOpening,   ///< its patient is opened
  kRunning,
  kJudging,  ///< the recording is repeated and judged
  kResult
};

/// What of an attempt the result shows on the bones.
enum class DebriefView { kNothing, kWays, kForce, kScratch, kHeat };

/// What the panel tells of an expert's instruments beside the learner's.
struct GhostModel {
  bool allowed = false;  ///< by the exercise
  bool on = true, preparing = false;
  double strength = 1;     ///< 0..1, by the learner's results
  bool guides = false;     ///< leads the hands too
  bool can_guide = false;  ///< a device with motors is in use
  std::string problem;
};

/// The knee as the panel examines it: loads of both tests, and what the tibia does.
struct ExaminedKneeModel {
  bool shown = false, computing = false;
  bool grafted = false;  ///< a graft is fixed in it
  bool may = true;       ///< it is bent little enough
  double most_deg = 0;   ///< bent more it is not examined
  double full_n = 0, full_valgus_nm = 0, full_internal_nm = 0;
  double pull_n = 0, pivot_share = 0;          ///< wanted
  double now_n = 0, now_share = 0;             ///< on the tibia
  double front_mm = 0, other_mm = 0;           ///< of this knee, and of the intact one
  std::optional<double> lachman_mm, pivot_mm;  ///< side differences that were found
  std::string problem;
};

/// The knee that is bent by the panel: with a placed graft in it, or to be examined.
struct BentKneeModel {
  bool shown = false;
  bool placed = false;  ///< a graft lies in it: it is worked and pulled
  ExaminedKneeModel exam;
  double least_deg = 0, most_deg = 0, wanted_deg = 0, tension_n = 0;
  std::uint32_t cycles = 0;
  std::vector<double> flexion_deg, between_mm;  ///< the graft's way, where it was bent to
};

/// What the panel for exercises shows.
struct ExerciseModel {
  struct Card {
    std::string title, text;
    std::string played;  ///< "3 attempts, passed"; empty: never
  };
  struct Stage {
    std::string title, instruction;
    bool done = false, live = false;
    double at_s = 0;
    std::string restore_title = {};  ///< its start can be gone to; empty: it cannot
    bool anew = false;               ///< likewise, by beginning anew: this attempt was not there
    std::string name = {};           ///< in the exercise's file
    bool can_begin = false;          ///< the attempt may begin with it
    bool in_part = true;             ///< it is of the part that was chosen
  };
  struct Fault {
    std::string title, severity, consequence;
    double at_s = 0;
    std::string where;  ///< the bone; may be empty
  };
  struct Measure {
    std::string name, unit;
    double value = 0, aim = 0;
    bool lower_is_better = true;
  };
  /// What the exercise asks to be said of the patient.
  struct Asked {
    std::string name, title;
    std::vector<std::string> grades;  ///< beside "none"
    std::string stated;               ///< empty: nothing yet
    std::string truth;                ///< of the result
  };
  ExercisePage page = ExercisePage::kClosed;
  std::vector<Card> cards;
  std::string title, text;
  std::vector<std::string> hands;  ///< "Probe: hook probe, through 3-4"
  std::vector<Stage> stages;
  std::vector<Fault> faults;      ///< briefing: what must not happen; later: what did
  std::vector<Measure> measures;  ///< briefing: aims; result: values
  std::optional<std::uint64_t> seed;
  bool parted = false;  ///< a part of the stages was chosen
  std::string opening;  ///< what is done before it begins; empty: the patient is opened
  double opened = 0;    ///< 0..1, of that
  double elapsed_s = 0, limit_s = 0;
  std::vector<std::string> left;  ///< what the live stage still asks for
  std::size_t goals = 0;          ///< of the live stage, those left counted
  /// What was found out and is needed: "Femoral channel", "32.7 mm", where it comes from.
  struct Told {
    std::string name, value, meaning;
  };
  std::vector<Told> told;
  std::string cue;  ///< asked for; empty: not shown
  bool has_cue = false;
  int hints = 0, undone = 0;
  double guided_s = 0;  ///< how long a hand was led
  bool paused = false;
  std::vector<Asked> asked;
  GhostModel ghost;
  BentKneeModel knee;
  double judged = 0;                          ///< 0..1, while judging
  DebriefView shown = DebriefView::kNothing;  ///< on the bones, of the result
  std::vector<DebriefView> can_show;
  bool shows_expert = false;  ///< the expert's ways are known
  std::string verdict, why;   ///< in a sentence; empty: passed
  std::optional<double> score, score_lo, score_hi;
  bool repeats = true;  ///< the recording repeats exactly
  std::string file, problem;
};

/// What it asks for.
struct ExerciseRequests {
  bool toggle = false;
  std::optional<std::size_t> choose = {};
  std::optional<std::optional<std::uint64_t>> seed = {};
  bool back = false;
  /// Names of the first and the last stage; empty: of all.
  std::optional<std::pair<std::string, std::string>> part = {};
  bool begin = false;
  bool stop_opening = false;
  bool end = false;  ///< judge what was done
  bool hint = false;
  bool undo = false;
  std::optional<std::size_t> return_to = {};            ///< to the start of that stage
  std::optional<double> bend_deg = {}, tension_n = {};  ///< of the knee and the graft's tail
  std::optional<double> pull_n = {}, pivot_share = {};  ///< on the tibia that is examined
  bool ghost = false;                                   ///< switched on or off
  bool guide = false;                                   ///< likewise: leads the hands
  bool as_expert = false;     ///< the active hand holds its instrument as the expert does
  bool to_expert = false;     ///< and comes to where he has it, if that is near
  double along_expert_s = 0;  ///< it goes on along his way, in his own time, for so long
  bool pause = false;         ///< or go on
  std::optional<std::pair<std::string, std::string>> state = {};  ///< finding and grade
  bool pages = false;                                             ///< to print
  bool watch = false;
  std::optional<DebriefView> show = {};
};

}  // namespace osteon
