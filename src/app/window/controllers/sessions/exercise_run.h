#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "exercises/attempt_part.h"
#include "exercises/attempt_watch.h"
#include "exercises/debrief.h"
#include "exercises/exam_order.h"
#include "exercises/ghost/begun_attempt.h"
#include "exercises/graft_order.h"
#include "exercises/seat_files.h"
#include "exercises/skin_order.h"
#include "runs/reports/portal_report.h"
#include "ui/side_job.h"
#include "window/controllers/sessions/exercise_facts.h"
#include "window/exercise_model.h"

namespace osteon {

/// An exercise in the window, from the course to its result. Follows the run tick by tick, to show
/// how far it is; the verdict comes from the recording, repeated and judged as `osteon debrief`
/// does. Knows neither window nor picture nor devices.
class ExerciseRun {
 public:
  ExercisePage page() const { return page_; }
  /// Closes the course, a briefing or a result; an exercise that runs goes on.
  void close_page();
  /// Opens the course, or closes what is open; an exercise under way goes on.
  void toggle();
  void choose(std::size_t exercise);
  bool choose(const std::string& name);
  void set_seed(std::optional<std::uint64_t> seed) {
    seed_ = seed;
    placed_spec_.clear();
  }
  /// A graft and portals that were made in exercises of their own, as their reports tell them: the
  /// chosen exercise leaves out the stages in which they are made. `where`: names the report.
  Result<void> use_graft(const std::string& report, const std::string& where);
  Result<void> use_portals(const std::string& report, const std::string& where);
  /// What has to be known before the patient is opened; returns where he is then. Takes long, and
  /// may be done on another thread. Empty: nothing has.
  std::function<Result<std::string>()> portals_to_place() const;
  void set_placed(std::string case_spec) { placed_spec_ = std::move(case_spec); }
  /// Of the graft that was made before; empty: none.
  const std::string& graft_report() const { return graft_report_; }
  /// The part of the exercise that is played: its first and last stage by name. Empty: the first
  /// and the last one of all. Fails, and changes nothing, where there is no such part.
  Result<void> choose_part(const std::string& from, const std::string& to);
  void back();

  const Scenario& scenario() const { return shortened_ ? *shortened_ : scenarios_[chosen_]; }
  std::string case_spec() const;
  void wait_for_case() {
    page_ = ExercisePage::kOpening;
    problem_.clear();  // of the last try: how far this one is takes its place
  }
  /// The patient is open: what the hands shall hold. An error is shown on the briefing.
  std::optional<std::vector<PlannedHand>> plan(std::shared_ptr<const Case> the_case);
  /// Where the goals' landmarks are, of the exercise that was planned last.
  std::vector<Vec3> places_W() const;
  /// From tick 0 of a run that is recorded to `file`. `sources`: what else is known of the run,
  /// where the exercise asks for tunnels; they are measured on another thread.
  void begin(double tick_s, std::filesystem::path file, TunnelSources sources = {},
             const std::vector<std::string>& tray = {});
  void fail_to_begin(const std::string& why);
  /// What an expert shall show on that case, and do before the part that was chosen.
  GhostWanted wanted_expert(std::uint64_t case_hash) const;
  /// What makes the begin of the part that was chosen, once the exercise is planned. None: it has
  /// no begin.
  std::optional<BegunAttemptOrder> order_of_begin(RunTray tray, std::filesystem::path file) const;
  /// As `begin`, from where the expert has come; takes the attempt's judge. `carved`: see
  /// TunnelSources.
  void go_on(double tick_s, BegunAttempt& begun,
             std::function<std::optional<CarvedField>(std::uint32_t)> carved);
  /// What is done meanwhile; null: nothing is told.
  void tell_opening(const LoadProgress* progress);

  /// One tick of one hand, in the order of that hand's ticks.
  void take(std::size_t hand, const ToolState& tool) { ticks_[hand].push_back(tool); }
  /// Judges the ticks that all hands have done. True: a stage has begun that can be come back to.
  bool follow(const BoneSnapshot& bones);
  /// What the tunnels that were drilled ask to be handed over, and how the knee gives; none:
  /// nothing, or not yet.
  std::optional<Command> next_order(const BoneSnapshot& bones);
  /// One of those could not be said: it is the next again.
  void refuse(const Command& order) { refused_ = order; }
  /// Where what the live stage asks for is done; at a bench: only at one beside a limb.
  WorkPlace place_of_work() const;
  bool at_bench() const;  ///< kFascia or kBench
  /// Whether a hand may take what is used there.
  bool works_at_bench(std::size_t hand) const;
  /// Whether skin is no longer felt, or never was: what lies under it is worked on.
  bool is_under_skin() const;
  /// Instruments that a hand has and may take, by the tray's names.
  std::vector<std::string> used_by(std::size_t hand) const;
  /// The live stage's start was kept as that restore point of the run.
  void keep_mark(std::uint32_t number);
  /// The run set a restore point: the attempt is kept with it.
  void see_mark(std::uint32_t number);
  /// The run goes back to one: so does the attempt, with the hands' first tick after it.
  void go_back(std::uint32_t number) { going_back_.push_back(number); }
  /// The restore point of a stage's start; none: it has none, or was not reached.
  std::optional<std::uint32_t> mark_of_stage(std::size_t stage) const;
  /// Whether the user may go to a stage's start that was not reached: one with a name of its own.
  bool can_begin_anew_at(std::size_t stage) const;
  /// True the second time within some seconds of the attempt, as `wants_to_end`.
  bool wants_to_leave_for(std::size_t stage);
  /// The attempt ends without a verdict, its recording is kept; the part from that stage on is what
  /// is opened next.
  Result<void> leave_for(std::size_t stage);
  /// The knee, where a graft lies in it; `bones`: as they are shown.
  BentKneeModel knee(const BoneSnapshot& bones) const;
  /// What its landmarks that shall be seen miss, and whether the tip that clears stumps is seen;
  /// `bones` as they are shown.
  std::vector<ExerciseModel::Told> sights(const BoneSnapshot& bones) const;
  /// How far it is; null: none has begun. `now_s`: pauses left out.
  const ScenarioState* state() const { return watch_ ? &watch_->state() : nullptr; }
  double now_s() const { return now_s_; }
  bool over() const { return watch_ && watch_->over(); }
  /// True the second time within some seconds of the attempt: one key must not end an hour's work.
  bool wants_to_end();
  void show_cue();
  void count_hint() { ++hints_; }
  /// While it is paused the clock stands and nothing that the hands do is judged.
  void pause(bool paused);
  bool paused() const { return paused_; }
  /// Whether the force was on as the pause began, for when it ends.
  void keep_force_wish(bool on) { force_was_wanted_ = on; }
  bool force_was_wanted() const { return force_was_wanted_; }
  /// What the user says is wrong with the patient; an empty grade takes it back.
  void state_finding(const std::string& name, const std::string& grade);
  void count_undo() { ++undone_; }
  /// For how long a device has led a hand so far.
  void set_guided(double seconds) { guided_s_ = seconds; }
  std::size_t hands() const { return ticks_.size(); }

  /// The recording is whole: judges it on a thread of its own.
  void judge();
  /// Takes in the verdict; the result is kept among the user's attempts.
  void poll();
  /// Returns when the verdict can be taken in.
  void wait_for_verdict() const {
    if (judging_) judging_->wait();
  }
  /// Draws pictures: with the window's context current.
  std::optional<Error> save_pages(const std::filesystem::path& file) const;
  const std::filesystem::path& recording() const { return file_; }
  /// Of the result; null: there is none.
  const Debrief* debrief() const {
    return page_ == ExercisePage::kResult && debrief_ ? &*debrief_ : nullptr;
  }
  /// Puts an expert's ways beside those of the result.
  void set_expert(const GhostTrack& track) {
    if (debrief_ && wants_expert(*debrief_)) show_expert(track, *debrief_);
  }

  ExerciseModel model() const;

 private:
  void begin_anew(double tick_s, std::filesystem::path file);
  PartStages part_stages() const;
  void describe_briefing(ExerciseModel& model) const;
  void describe_run(ExerciseModel& model) const;
  void describe_result(ExerciseModel& model) const;
  void describe_asked(ExerciseModel& model) const;
  /// Whether the live stage has a goal of that kind.
  bool asks_now(std::string_view kind) const;
  void describe_exam(const BoneSnapshot& bones, ExaminedKneeModel& model) const;
  void take_exercises(ExerciseList set);
  void keep();
  Result<void> note_what_was_said() const;

  ExercisePage page_ = ExercisePage::kClosed;
  std::vector<Scenario> scenarios_;
  std::vector<std::string> played_;                      ///< as scenarios_
  std::vector<std::optional<std::uint64_t>> set_seeds_;  ///< by a course, as scenarios_
  std::string course_title_, left_out_;                  ///< which files could not be used, and why
  std::size_t chosen_ = 0;
  std::optional<Scenario> shortened_;  ///< of the chosen one, by what was made before
  std::string graft_report_;           ///< empty: the graft is made, or none is needed
  std::optional<MadeGraft> graft_;
  std::optional<ReportedPortals> portals_;
  std::string portals_from_, placed_spec_;
  std::optional<AttemptPart> part_;  ///< none: all
  std::optional<std::uint64_t> seed_;
  std::string problem_;
  LoadProgress opening_;  ///< empty words: as usual

  std::shared_ptr<const Case> case_;
  std::unique_ptr<ScenarioPlan> plan_;
  std::vector<PlannedHand> hands_;
  std::unique_ptr<AttemptWatch> watch_;
  GraftOrder order_;
  SkinOrder skin_;
  std::optional<ExamOrder> exam_;  ///< none: the exercise does not have the knee examined
  std::optional<Command> refused_;
  std::map<std::size_t, std::uint32_t> stage_marks_;
  std::deque<std::uint32_t> going_back_;      ///< restore points, the next one first
  std::vector<std::deque<ToolState>> ticks_;  ///< by hand, not judged yet
  std::vector<ToolState> last_;               ///< by hand
  double tick_s_ = 0.001, now_s_ = 0;
  /// `now_s_` when the user wanted to end it, and to go to the start of a stage instead.
  struct AskedToEnd {
    double at_s = 0;
    std::optional<std::size_t> for_stage = {};
  };
  std::optional<AskedToEnd> end_asked_;
  bool asks_again(std::optional<std::size_t> for_stage);
  std::uint32_t stage_ = 0;
  bool cue_shown_ = false, paused_ = false, force_was_wanted_ = true;
  std::vector<AttemptPause> pauses_;
  StatedFindings stated_;
  int hints_ = 0, undone_ = 0;
  double guided_s_ = 0;
  std::filesystem::path file_;

  std::unique_ptr<SideJob<Debrief>> judging_;
  std::optional<Debrief> debrief_;
};

}  // namespace osteon
