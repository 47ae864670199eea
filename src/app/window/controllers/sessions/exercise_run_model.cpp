// What the panels show of an exercise.
#include <algorithm>
#include <string>
#include <utility>

#include "ui/label.h"
#include "window/controllers/sessions/exercise_run.h"

namespace osteon {
namespace {

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

}  // namespace

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

std::vector<ExerciseModel::Told> ExerciseRun::sights(const BoneSnapshot& bones) const {
  if (!watch_ || !case_ || page_ != ExercisePage::kRunning) return {};
  auto facts = sights_of(*plan_, watch_->state(), *case_, hands_, last_, bones);
  if (!asks_now("stumps_cleared")) return facts;
  std::vector<const ToolState*> tools;
  for (const ToolState& tool : last_) tools.push_back(&tool);
  if (const auto watched = watch_->clears_watched(tools, bones))
    facts.push_back({"Tip in the scope's picture", *watched ? "yes" : "no: do not clear",
                     "What is cleared while the scope does not see the tip is an error, and so is "
                     "what the water hides"});
  return facts;
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
  const PartStages part = part_stages();
  model.parted = part_.has_value();
  for (std::uint32_t i = 0; i < scenario().stages.size(); ++i) {
    const ScenarioStage& stage = scenario().stages[i];
    model.stages.push_back({stage.title, stage.instruction});
    model.stages.back().name = stage.name;
    model.stages.back().can_begin = i == 0 || stage.restore_point;
    model.stages.back().in_part = i >= part.first && i <= part.last;
  }
  if (page_ == ExercisePage::kOpening) {
    model.opening = opening_.what;
    model.opened = opening_.fraction;
  }
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
    const double done_s = i < state.completed_s.size() ? state.completed_s[i] : -1;
    const double at_s = done_s < 0 ? done_s : std::max(0.0, done_s - watch_->part_from_s());
    model.stages.push_back({stage.title, stage.instruction, at_s >= 0, i == state.stage, at_s, {}});
    model.stages.back().anew = can_begin_anew_at(i);
    if (mark_of_stage(i) || model.stages.back().anew)
      model.stages.back().restore_title =
          stage.restore_title.empty() ? stage.title : stage.restore_title;
  }
  for (const MadeError& made : state.errors) {
    if (made.at_s < watch_->part_from_s()) continue;
    const ScenarioError& error = scenario().errors[made.error];
    model.faults.push_back(
        {error.title, std::string(to_text(error.severity)), error.consequence,
         made.at_s - watch_->part_from_s(),
         made.bone < case_->bones.size() ? label_of(case_->bones[made.bone].name) : std::string()});
  }
  model.elapsed_s = now_s_;
  model.paused = paused_;
  describe_asked(model);
  if (asks_now("tendons_found")) model.told = fascia_of(watch_->graft());
  if (asks_now("tendons_stripped")) model.told = bands_of(watch_->graft());
  for (auto& fact : facts_of(watch_->graft())) model.told.push_back(std::move(fact));
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
  for (std::size_t g = 0; g < goals.size() && g < state.goals.size(); ++g) {
    const std::string words = goals[g].bones.empty() ? words_of_goal(goals[g].rule.kind) : "";
    if (words.empty()) continue;
    ++model.goals;
    if (!state.goals[g].met) model.left.push_back(words);
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
  for (const Outcome::Stage& stage : outcome.stages) {
    const auto it = std::find_if(scenario().stages.begin(), scenario().stages.end(),
                                 [&](const ScenarioStage& one) { return one.name == stage.name; });
    const auto& done = stage.completed_s;
    if (it != scenario().stages.end())
      model.stages.push_back({it->title, "", done.has_value(), false, done.value_or(0)});
  }
  model.parted = debrief_->part.has_value();
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
  if (model.parted && outcome.verdict == Verdict::kUndecided)
    model.why =
        "Every stage of this part was done without a grave error. Only a whole attempt "
        "is scored.";
  if (outcome.score && is_whole(outcome)) {
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
