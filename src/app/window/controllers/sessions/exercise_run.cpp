#include "window/controllers/sessions/exercise_run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <utility>

#include "exercises/debrief_pictures.h"
#include "exercises/guided_time.h"
#include "exercises/portal_choice.h"
#include "exercises/result_files.h"
#include "exercises/result_sender.h"
#include "osteon/procedure/attempt.h"
#include "osteon/record/recording_note.h"
#include "ui/label.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

// What a user did before, by exercise. A server is not asked while the window waits.
std::vector<std::string> played_before(const std::vector<Scenario>& scenarios) {
  std::map<std::string, std::pair<int, bool>> played;
  if (!is_results_server(results_place()))
    if (const auto store = ResultStore::open(results_place(), 0.2))
      if (const auto rows = store->list({learner_here(), ""}))
        for (const AttemptRow& row : *rows) {
          auto& [count, passed] = played[row.scenario];
          ++count;
          passed = passed || row.verdict == "passed";
        }
  std::vector<std::string> words;
  for (const Scenario& scenario : scenarios) {
    const auto it = played.find(scenario.name);
    words.push_back(it == played.end() ? ""
                                       : std::to_string(it->second.first) +
                                             (it->second.first == 1 ? " attempt" : " attempts") +
                                             (it->second.second ? ", passed" : ", not passed yet"));
  }
  return words;
}

// What is to be done at a mark; a bone is to be touched.
std::string verb_of(const PlannedRule& goal) {
  const std::string& kind = goal.rule.kind;
  return kind == "seen"      ? "see "
         : kind == "through" ? "go through "
         : kind == "felt"    ? "press "
                             : "";
}

std::string subject_of(const PlannedRule& goal, std::size_t i, const Case& the_case) {
  const std::uint32_t at = goal.bones[i];
  if (goal.about == SubjectKind::kLandmark)
    return at < the_case.landmarks.size() ? verb_of(goal) + label_of(the_case.landmarks[at].name)
                                          : "";
  return at < the_case.bones.size() ? label_of(the_case.bones[at].name) : "";
}

// A case that is a bench and nothing else is on show as it is.
bool is_practice_bench(const Case& the_case) {
  return std::none_of(the_case.bones.begin(), the_case.bones.end(),
                      [](const Bone& bone) { return bone.beside; });
}

}  // namespace

void ExerciseRun::close_page() {
  if (page_ != ExercisePage::kOpening && page_ != ExercisePage::kRunning &&
      page_ != ExercisePage::kJudging)
    page_ = ExercisePage::kClosed;
}

void ExerciseRun::take_exercises(ExerciseList set) {
  course_title_ = set.title;
  scenarios_ = std::move(set.scenarios);
  set_seeds_ = std::move(set.seeds);
  // Where no course says otherwise, the first thing that a student meets comes first. None of those
  // has a patient that is set.
  if (course_title_.empty() && std::none_of(set_seeds_.begin(), set_seeds_.end(),
                                            [](const auto& seed) { return seed.has_value(); }))
    std::stable_partition(scenarios_.begin(), scenarios_.end(),
                          [](const Scenario& s) { return s.hands.empty(); });
  for (const Error& fault : set.faults)
    left_out_ += (left_out_.empty() ? "" : "\n") + fault.message();
}

void ExerciseRun::toggle() {
  if (page_ != ExercisePage::kClosed) return close_page();
  problem_.clear();
  if (scenarios_.empty()) {
    auto set = set_exercises();
    if (!set) problem_ = set.error().message();
    if (set) take_exercises(std::move(*set));
  }
  if (problem_.empty()) problem_ = left_out_;
  played_ = played_before(scenarios_);
  page_ = ExercisePage::kCourse;
}

void ExerciseRun::choose(std::size_t exercise) {
  if (exercise >= scenarios_.size()) return;
  chosen_ = exercise;
  shortened_.reset();
  graft_report_.clear();
  graft_.reset();
  portals_.reset();
  placed_spec_.clear();
  if (exercise < set_seeds_.size() && set_seeds_[exercise]) seed_ = set_seeds_[exercise];
  problem_.clear();
  page_ = ExercisePage::kBriefing;
}

bool ExerciseRun::choose(const std::string& name) {
  for (std::size_t i = 0; i < scenarios_.size(); ++i)
    if (scenarios_[i].name == name) choose(i);
  if (page_ == ExercisePage::kBriefing) return true;
  // One that is not set may still be named.
  auto scenario = open_scenario(name);
  if (!scenario) return false;
  scenarios_.push_back(std::move(*scenario));
  choose(scenarios_.size() - 1);
  return true;
}

void ExerciseRun::back() {
  problem_.clear();
  if (page_ != ExercisePage::kBriefing && page_ != ExercisePage::kResult) return;
  played_ = played_before(scenarios_);
  page_ = ExercisePage::kCourse;
}

std::string ExerciseRun::case_spec() const {
  return placed_spec_.empty() ? case_spec_of(scenario(), "", seed_) : placed_spec_;
}

Result<void> ExerciseRun::use_graft(const std::string& report, const std::string& where) {
  auto made = made_graft(report, where);
  if (!made) return tl::unexpected(made.error());
  graft_ = *made;
  graft_report_ = report;
  if (!shortened_) shortened_ = scenario();
  leave_out_bench_stages(*shortened_);
  return {};
}

Result<void> ExerciseRun::use_portals(const std::string& report, const std::string& where) {
  auto made = read_portals(report, where);
  if (!made) return tl::unexpected(made.error());
  portals_ = std::move(*made);
  portals_from_ = where;
  if (!shortened_) shortened_ = scenario();
  leave_out_puncture_stages(*shortened_);
  return {};
}

std::function<Result<std::string>()> ExerciseRun::portals_to_place() const {
  if (!portals_ || !placed_spec_.empty()) return {};
  return [spec = case_spec(), made = *portals_, where = portals_from_] {
    return with_made_portals(spec, made, where);
  };
}

void ExerciseRun::fail_to_begin(const std::string& why) {
  problem_ = why;
  watch_.reset();
  page_ = ExercisePage::kBriefing;
}

std::optional<std::vector<PlannedHand>> ExerciseRun::plan(std::shared_ptr<const Case> the_case) {
  auto planned = plan_scenario(scenario(), *the_case);
  auto hands = plan_hands(scenario(), *the_case);
  if (!planned || !hands) {
    fail_to_begin(planned ? hands.error().message() : planned.error().message());
    return std::nullopt;
  }
  case_ = std::move(the_case);
  watch_.reset();
  plan_ = std::make_unique<ScenarioPlan>(std::move(*planned));
  hands_ = std::move(*hands);
  return hands_;
}

std::vector<Vec3> ExerciseRun::places_W() const {
  std::vector<Vec3> places;
  if (!plan_) return places;
  for (const auto& goals : plan_->goals)
    for (const PlannedRule& goal : goals)
      places.insert(places.end(), goal.places_W.begin(), goal.places_W.end());
  return places;
}

void ExerciseRun::begin(double tick_s, fs::path file, TunnelSources sources,
                        const std::vector<std::string>& tray) {
  tick_s_ = tick_s;
  file_ = std::move(file);
  watch_ = std::make_unique<AttemptWatch>(*plan_, *case_, hands_, tick_s);
  sources.case_spec = case_spec();
  sources.in_background = true;
  sources.graft = graft_;
  watch_->watch_tunnels(std::move(sources));
  watch_->watch_tray(tray);
  ticks_.assign(hands_.size(), {});
  last_.assign(hands_.size(), {});
  order_ = {};
  skin_ = {};
  exam_.reset();
  refused_.reset();
  if (watch_->tunnels() && asks_for_exam(*plan_))
    exam_.emplace(*case_, watch_->tunnels()->whole_spec(), true);
  stage_marks_.clear();
  debrief_.reset();
  problem_.clear();
  now_s_ = 0;
  stage_ = 0;
  cue_shown_ = paused_ = false;
  pauses_.clear();
  stated_.clear();
  hints_ = undone_ = 0;
  guided_s_ = 0;
  page_ = ExercisePage::kRunning;
}

std::optional<Command> ExerciseRun::next_order(const BoneSnapshot& bones) {
  if (!watch_ || !watch_->tunnels() || paused_) return std::nullopt;
  if (const auto refused = std::exchange(refused_, std::nullopt)) return refused;
  skin_.see(*plan_, watch_->state());
  if (const auto said = skin_.take()) return said;
  if (asks_for_graft(*plan_)) order_.see(watch_->tunnels()->placing(), bones);
  if (const auto said = order_.take()) return said;
  if (!exam_) return std::nullopt;
  exam_->see(watch_->tunnels()->fixed(), bones);
  return exam_->take();
}

bool ExerciseRun::at_bench() const {
  const auto& stages = scenario().stages;
  return watch_ && case_ && !is_practice_bench(*case_) && watch_->state().stage < stages.size() &&
         is_at_bench(stages[watch_->state().stage]);
}

bool ExerciseRun::works_at_bench(std::size_t hand) const {
  const std::vector<std::string> names = used_by(hand);
  return std::any_of(names.begin(), names.end(), [](const std::string& name) {
    return name == "tendon_stripper" || name.starts_with("graft_sizer");
  });
}

bool ExerciseRun::is_under_skin() const {
  const auto& soft = scenario().soft;
  const bool felt = std::any_of(soft.begin(), soft.end(),
                                [](const std::string& name) { return name.starts_with("skin"); });
  if (!felt || !plan_ || !watch_) return !felt;
  const auto from = stage_bent_after_portals(*plan_);
  return from && watch_->state().stage >= *from;
}

std::vector<std::string> ExerciseRun::used_by(std::size_t hand) const {
  if (hand >= hands_.size()) return {};
  std::vector<std::string> names{hands_[hand].instrument};
  names.insert(names.end(), hands_[hand].also.begin(), hands_[hand].also.end());
  return names;
}

void ExerciseRun::keep_mark(std::uint32_t number) {
  if (watch_) stage_marks_[watch_->state().stage] = number;
}

std::optional<std::uint32_t> ExerciseRun::mark_of_stage(std::size_t stage) const {
  const auto found = stage_marks_.find(stage);
  return found == stage_marks_.end() ? std::nullopt : std::optional(found->second);
}

BentKneeModel ExerciseRun::knee(const BoneSnapshot& bones) const {
  BentKneeModel model;
  const GraftPlacingState& placing = bones.placing;
  if (!watch_ || !case_ || case_->joints.empty() || page_ != ExercisePage::kRunning) return model;
  model.placed = placing.on && placing.phase == PlacingPhase::kTurned;
  if (exam_ && asks_now("knee_examined")) describe_exam(bones, model.exam);
  // Once it was bent it can be bent back.
  model.shown =
      model.placed || (exam_ && (model.exam.shown || asks_now("knee_bent") || bones.bend.on));
  if (!model.shown) return model;
  const CaseJoint& joint = case_->joints.front();
  model.least_deg = joint.min_deg();
  model.most_deg = joint.max_deg();
  model.wanted_deg = bones.bend.on ? bones.bend.wanted_deg : joint.at_deg;
  model.tension_n = placing.tension_n;
  model.cycles = bones.bend.cycles;
  const BentGraft& bent = watch_->placing().bent();
  for (std::size_t i = 0; i < bent.lengths_m.size(); ++i) {
    if (!(bent.lengths_m[i] > 0)) continue;
    model.flexion_deg.push_back(10.0 * static_cast<double>(i));
    model.between_mm.push_back(1e3 * bent.lengths_m[i]);
  }
  return model;
}

bool ExerciseRun::asks_now(std::string_view kind) const {
  const std::uint32_t stage = watch_->state().stage;
  if (stage >= plan_->goals.size()) return false;
  const auto& goals = plan_->goals[stage];
  return std::any_of(goals.begin(), goals.end(),
                     [&](const PlannedRule& goal) { return goal.rule.kind == kind; });
}

void ExerciseRun::describe_exam(const BoneSnapshot& bones, ExaminedKneeModel& model) const {
  const KneeExamState& exam = bones.exam;
  const auto is_of = [](KneeTest test) { return static_cast<std::size_t>(test); };
  model.shown = true;
  model.problem = exam_->problem() ? exam_->problem()->message() : std::string();
  model.computing = !exam.on || (bones.placing.screw.done && exam.knee == 0);
  model.grafted = exam.knee == 1;
  model.most_deg = KneeGiveTable::kMost_deg;
  model.may = bones.bend.on ? bones.bend.now_deg <= KneeGiveTable::kMost_deg
                            : case_->joints.front().at_deg <= KneeGiveTable::kMost_deg;
  model.full_n = exam.front_n;
  model.full_valgus_nm = exam.valgus_nm;
  model.full_internal_nm = exam.internal_nm;
  model.pull_n = exam.front_n * exam.wanted[is_of(KneeTest::kLachman)];
  model.pivot_share = exam.wanted[is_of(KneeTest::kPivot)];
  model.now_n = exam.front_n * exam.now[is_of(KneeTest::kLachman)];
  model.now_share = exam.now[is_of(KneeTest::kPivot)];
  model.front_mm = 1e3 * exam.give.front_m;
  model.other_mm = 1e3 * exam.give.other_front_m;
  const auto found = watch_->exam();
  if (!found) return;
  const auto& of_this = found->found[exam.knee];
  if (of_this[0]) model.lachman_mm = 1e3 * of_this[0]->side_difference_m();
  if (of_this[1]) model.pivot_mm = 1e3 * of_this[1]->side_difference_m();
}

bool ExerciseRun::follow(const BoneSnapshot& bones) {
  if (!watch_) return false;
  const auto all_have = [&] {
    return std::all_of(ticks_.begin(), ticks_.end(), [](const auto& q) { return !q.empty(); });
  };
  std::vector<const ToolState*> tools;
  for (const ToolState& tool : last_) tools.push_back(&tool);
  while (!watch_->over() && all_have()) {
    // Where one hand's ticks have a gap the others wait for it.
    std::uint64_t tick = 0;
    for (const auto& queue : ticks_) tick = std::max(tick, queue.front().tick);
    for (std::size_t h = 0; h < ticks_.size(); ++h)
      while (!ticks_[h].empty() && ticks_[h].front().tick <= tick) {
        last_[h] = ticks_[h].front();
        ticks_[h].pop_front();
      }
    watch_->add(tools, bones);
    now_s_ = watch_->now_s();
  }
  const std::uint32_t stage = watch_->state().stage;
  if (stage == stage_) return false;
  stage_ = stage;
  cue_shown_ = false;
  return stage < scenario().stages.size() && scenario().stages[stage].restore_point;
}

void ExerciseRun::show_cue() {
  if (!cue_shown_) ++hints_;
  cue_shown_ = true;
}

// A pause begins after the newest tick that any hand has told, and ends so.
void ExerciseRun::pause(bool paused) {
  if (!watch_ || page_ != ExercisePage::kRunning || paused == paused_) return;
  std::uint64_t told = 0;
  for (std::size_t h = 0; h < ticks_.size(); ++h)
    told = std::max({told, last_[h].tick, ticks_[h].empty() ? 0 : ticks_[h].back().tick});
  paused_ = paused;
  if (paused)
    pauses_.push_back({told + 1});
  else
    pauses_.back().to = told + 1;
  watch_->set_pauses(pauses_);
}

void ExerciseRun::state_finding(const std::string& name, const std::string& grade) {
  if (page_ != ExercisePage::kRunning) return;
  if (grade.empty())
    stated_.erase(name);
  else
    stated_[name] = grade;
}

// The verdict is made from the recording alone: what was said goes with it.
Result<void> ExerciseRun::note_what_was_said() const {
  if (!pauses_.empty())
    if (auto ok = write_note(file_, "pauses", to_text(pauses_)); !ok) return ok;
  if (!graft_report_.empty())
    if (auto ok = write_note(file_, "graft", graft_report_); !ok) return ok;
  if (guided_s_ > 0)
    if (auto ok = write_note(file_, "guided", guided_text(guided_s_)); !ok) return ok;
  if (!scenario().asks.empty()) return write_note(file_, "findings", to_json(stated_));
  return {};
}

void ExerciseRun::judge() {
  pause(false);
  if (const auto noted = note_what_was_said(); !noted) problem_ = noted.error().message();
  page_ = ExercisePage::kJudging;
  judging_ = std::make_unique<SideJob<Debrief>>(
      [order = DebriefOrder{file_, "", scenario().where, ""}](const Progress& progress) {
        progress("Replaying your attempt", 0.1);
        return make_debrief(order);
      });
}

void ExerciseRun::poll() {
  if (!judging_ || !judging_->done()) return;
  auto judged = judging_->take();
  judging_.reset();
  if (!judged || !judged->outcome) {
    problem_ = judged ? "The recording contains no attempt." : judged.error().message();
    page_ = ExercisePage::kResult;
    return;
  }
  debrief_ = std::move(*judged);
  page_ = ExercisePage::kResult;
  keep();
}

void ExerciseRun::keep() {
  const std::string report = report_of(*debrief_);
  const auto standard = standard_in_use(scenario().name);
  const auto noted =
      note_attempt(file_, scenario(), standard ? *standard : std::nullopt, "a person", report);
  if (!noted) problem_ = noted.error().message();
  const auto kept = keep_report(report, learner_here(), file_);
  if (!kept) problem_ = kept.error().message();
  if (kept && *kept) problem_ = (*kept)->message();
  (void)send_results_in_background();
}

std::optional<Error> ExerciseRun::save_pages(const fs::path& file) const {
  if (!debrief_) return std::nullopt;
  const auto pictures = draw_debrief_here(*debrief_);
  const auto saved =
      save_debrief(*debrief_, file, pictures ? *pictures : std::vector<DebriefPicture>());
  return saved ? std::optional<Error>{} : saved.error();
}

ExerciseModel ExerciseRun::model() const {
  ExerciseModel model;
  model.page = page_;
  model.problem = problem_;
  model.seed = seed_;
  if (page_ == ExercisePage::kClosed) return model;
  if (page_ == ExercisePage::kCourse) {
    for (std::size_t i = 0; i < scenarios_.size(); ++i)
      model.cards.push_back({scenarios_[i].title, scenarios_[i].text, played_[i]});
    model.title = course_title_;
    return model;
  }
  model.title = scenario().title;
  model.text = scenario().text;
  model.limit_s = scenario().time_limit_s;
  if (page_ == ExercisePage::kRunning)
    describe_run(model);
  else if (page_ == ExercisePage::kResult && debrief_)
    describe_result(model);
  else
    describe_briefing(model);
  if (judging_) model.judged = judging_->progress().fraction;
  return model;
}

void ExerciseRun::describe_briefing(ExerciseModel& model) const {
  for (const ScenarioHand& hand : scenario().hands)
    model.hands.push_back(label_of(hand.name) + ": " + label_of(hand.instrument) +
                          (hand.portal.empty() ? "" : ", through " + label_of(hand.portal)));
  for (const ScenarioStage& stage : scenario().stages)
    model.stages.push_back({stage.title, stage.instruction});
  for (const ScenarioError& error : scenario().errors)
    model.faults.push_back(
        {error.title, std::string(to_text(error.severity)), error.consequence, 0, {}});
  for (const ScenarioMetric& metric : scenario().metrics)
    model.measures.push_back(
        {metric.name, metric.unit, 0, metric.threshold, metric.lower_is_better});
}

void ExerciseRun::describe_run(ExerciseModel& model) const {
  const ScenarioState& state = watch_->state();
  for (std::size_t i = 0; i < scenario().stages.size(); ++i) {
    const ScenarioStage& stage = scenario().stages[i];
    const double at_s = i < state.completed_s.size() ? state.completed_s[i] : -1;
    model.stages.push_back({stage.title, stage.instruction, at_s >= 0, i == state.stage, at_s, {}});
    if (mark_of_stage(i))
      model.stages.back().restore_title =
          stage.restore_title.empty() ? stage.title : stage.restore_title;
  }
  for (const MadeError& made : state.errors) {
    const ScenarioError& error = scenario().errors[made.error];
    model.faults.push_back(
        {error.title, std::string(to_text(error.severity)), error.consequence, made.at_s,
         made.bone < case_->bones.size() ? label_of(case_->bones[made.bone].name) : std::string()});
  }
  model.elapsed_s = now_s_;
  model.paused = paused_;
  describe_asked(model);
  model.told = facts_of(watch_->graft());
  for (auto& fact : facts_of(watch_->placing())) model.told.push_back(std::move(fact));
  if (const auto cleared = watch_->cleared_percent(); cleared && asks_now("stumps_cleared"))
    model.told.push_back({"Torn ends cleared", std::to_string(*cleared) + " %",
                          "Of what the torn ligament has left; what lies on the bone stays"});
  model.hints = hints_;
  model.undone = undone_;
  model.guided_s = guided_s_;
  if (state.stage >= scenario().stages.size()) return;
  const std::string& cue = scenario().stages[state.stage].cue;
  model.has_cue = !cue.empty();
  if (cue_shown_) model.cue = cue;
  const auto& goals = plan_->goals[state.stage];
  for (std::size_t g = 0; g < goals.size() && g < state.goals.size(); ++g)
    for (std::size_t i = 0; i < goals[g].bones.size(); ++i) {
      ++model.goals;
      const bool done =
          state.goals[g].met || (i < state.goals[g].done.size() && state.goals[g].done[i] != 0);
      if (!done) model.left.push_back(subject_of(goals[g], i, *case_));
    }
}

void ExerciseRun::describe_asked(ExerciseModel& model) const {
  for (const AskedFinding& asked : scenario().asks) {
    const auto said = stated_.find(asked.name);
    model.asked.push_back({asked.name,
                           asked.title,
                           asked.grades,
                           said == stated_.end() ? std::string() : said->second,
                           {}});
  }
}

void ExerciseRun::describe_result(ExerciseModel& model) const {
  const Outcome& outcome = *debrief_->outcome;
  for (std::size_t i = 0; i < outcome.stages.size() && i < scenario().stages.size(); ++i) {
    const auto& done = outcome.stages[i].completed_s;
    model.stages.push_back(
        {scenario().stages[i].title, "", done.has_value(), false, done.value_or(0)});
  }
  for (const Outcome::Error& made : outcome.errors) {
    const auto it =
        std::find_if(scenario().errors.begin(), scenario().errors.end(),
                     [&](const ScenarioError& error) { return error.name == made.name; });
    if (it != scenario().errors.end())
      model.faults.push_back({it->title, std::string(to_text(made.severity)), it->consequence,
                              made.at_s, label_of(made.subject)});
  }
  for (const ScenarioMetric& metric : scenario().metrics)
    if (const auto it = outcome.metrics.find(metric.name); it != outcome.metrics.end())
      model.measures.push_back(
          {metric.name, metric.unit, it->second, metric.threshold, metric.lower_is_better});
  for (const GradedFinding& graded : outcome.findings)
    model.asked.push_back({graded.name, graded.title, {}, graded.stated, graded.truth});
  model.verdict = std::string(to_text(outcome.verdict));
  model.why = why_of(outcome, debrief_->pass_score);
  if (outcome.score) {
    model.score = outcome.score->value;
    model.score_lo = outcome.score->lo;
    model.score_hi = outcome.score->hi;
  }
  model.repeats = debrief_->identical;
  model.file = file_.string();
  model.elapsed_s = debrief_->duration_s;
  model.hints = hints_;
  model.undone = undone_;
  model.guided_s = guided_s_;
}

}  // namespace osteon
