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
  part_.reset();
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

Result<void> ExerciseRun::choose_part(const std::string& from, const std::string& to) {
  const auto& stages = scenario().stages;
  AttemptPart part{from.empty() ? stages.front().name : from, to.empty() ? stages.back().name : to};
  const auto found = stages_of(part, scenario());
  if (!found) return tl::unexpected(found.error());
  part_ = std::move(part);
  if (found->first == 0 && found->last + 1 == stages.size()) part_.reset();
  return {};
}

PartStages ExerciseRun::part_stages() const {
  const auto all = PartStages{0, static_cast<std::uint32_t>(scenario().stages.size() - 1)};
  if (!part_) return all;
  const auto found = stages_of(*part_, scenario());
  return found ? *found : all;
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
  watch_ = std::make_unique<AttemptWatch>(*plan_, *case_, hands_, tick_s);
  sources.case_spec = case_spec();
  sources.in_background = true;
  sources.graft = graft_;
  watch_->watch_tunnels(std::move(sources));
  watch_->watch_tray(tray);
  if (part_) watch_->set_part(*part_, part_stages());
  begin_anew(tick_s, std::move(file));
}

void ExerciseRun::go_on(double tick_s, BegunAttempt& begun,
                        std::function<std::optional<CarvedField>(std::uint32_t)> carved) {
  watch_ = std::move(begun.watch);
  watch_->go_on_live(std::move(carved));
  part_ = begun.part;
  begin_anew(tick_s, begun.run.file);
  for (std::size_t h = 0; h < last_.size(); ++h) last_[h] = begun.run.tools[h];
  stage_ = watch_->state().stage;
}

GhostWanted ExerciseRun::wanted_expert(std::uint64_t case_hash) const {
  const bool ends_early = part_ && part_stages().last + 1 < scenario().stages.size();
  return {scenario(), case_spec(), case_hash, graft_report_, ends_early ? part_->to : ""};
}

std::optional<BegunAttemptOrder> ExerciseRun::order_of_begin(RunTray tray, fs::path file) const {
  if (!plan_ || !part_ || part_stages().first == 0) return std::nullopt;
  return BegunAttemptOrder{wanted_expert(case_->hash),
                           *part_,
                           plan_.get(),
                           hands_,
                           case_,
                           graft_,
                           std::move(tray),
                           {},
                           std::move(file)};
}

void ExerciseRun::tell_opening(const LoadProgress* progress) {
  opening_ = progress ? *progress : LoadProgress();
}

void ExerciseRun::begin_anew(double tick_s, fs::path file) {
  tick_s_ = tick_s;
  file_ = std::move(file);
  ticks_.assign(hands_.size(), {});
  last_.assign(hands_.size(), {});
  order_ = {};
  skin_ = {};
  exam_.reset();
  refused_.reset();
  if (watch_->tunnels() && asks_for_exam(*plan_))
    exam_.emplace(*case_, watch_->tunnels()->whole_spec(), true);
  stage_marks_.clear();
  going_back_.clear();
  debrief_.reset();
  problem_.clear();
  now_s_ = 0;
  end_asked_.reset();
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
  skin_.see(*plan_, watch_->state(), bones.epoch);
  if (const auto said = skin_.take()) return said;
  if (asks_for_graft(*plan_)) order_.see(watch_->tunnels()->placing(), bones);
  if (const auto said = order_.take()) return said;
  if (!exam_) return std::nullopt;
  exam_->see(watch_->tunnels()->fixed(), bones);
  return exam_->take();
}

WorkPlace ExerciseRun::place_of_work() const {
  const auto& stages = scenario().stages;
  if (!watch_ || watch_->state().stage >= stages.size()) return WorkPlace::kJoint;
  const WorkPlace place = osteon::place_of_work(stages[watch_->state().stage]);
  const bool beside_limb = case_ && !is_practice_bench(*case_);
  return place == WorkPlace::kSkin || beside_limb ? place : WorkPlace::kJoint;
}

bool ExerciseRun::at_bench() const {
  const WorkPlace place = place_of_work();
  return place == WorkPlace::kFascia || place == WorkPlace::kBench;
}

bool ExerciseRun::works_at_bench(std::size_t hand) const {
  const std::vector<std::string> names = used_by(hand);
  return std::any_of(names.begin(), names.end(), [](const std::string& name) {
    return name == "tendon_stripper" || name.starts_with("graft_sizer");
  });
}

bool ExerciseRun::is_under_skin() const {
  if (place_of_work() == WorkPlace::kSkin) return false;
  const auto& soft = scenario().soft;
  const bool felt = std::any_of(soft.begin(), soft.end(), is_skin_of_portals);
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

void ExerciseRun::see_mark(std::uint32_t number) {
  if (watch_) watch_->keep(number);
}

std::optional<std::uint32_t> ExerciseRun::mark_of_stage(std::size_t stage) const {
  const auto found = stage_marks_.find(stage);
  return found == stage_marks_.end() ? std::nullopt : std::optional(found->second);
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
    const std::uint32_t epoch = last_[0].epoch;
    for (std::size_t h = 0; h < ticks_.size(); ++h)
      while (!ticks_[h].empty() && ticks_[h].front().tick <= tick) {
        last_[h] = ticks_[h].front();
        ticks_[h].pop_front();
      }
    if (last_[0].epoch != epoch && !going_back_.empty()) {
      watch_->go_back(going_back_.front());
      going_back_.pop_front();
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

bool ExerciseRun::asks_again(std::optional<std::size_t> for_stage) {
  constexpr double kSoonAgain_s = 5, kSoonInList_s = 15;
  const bool again = end_asked_ && end_asked_->for_stage == for_stage &&
                     now_s_ - end_asked_->at_s < (for_stage ? kSoonInList_s : kSoonAgain_s);
  end_asked_ = AskedToEnd{now_s_, for_stage};
  return again;
}

bool ExerciseRun::wants_to_end() { return asks_again(std::nullopt); }

bool ExerciseRun::wants_to_leave_for(std::size_t stage) { return asks_again(stage); }

bool ExerciseRun::can_begin_anew_at(std::size_t stage) const {
  if (stage >= scenario().stages.size() || mark_of_stage(stage)) return false;
  return scenario().stages[stage].restore_point && !scenario().stages[stage].restore_title.empty();
}

Result<void> ExerciseRun::leave_for(std::size_t stage) {
  if (!can_begin_anew_at(stage)) return fail("this stage has no start to go to", scenario().where);
  const auto& stages = scenario().stages;
  const bool beyond = stage > part_stages().last;
  const std::string to = stages[beyond ? stages.size() - 1 : part_stages().last].name;
  const auto noted = note_what_was_said();
  watch_.reset();
  page_ = ExercisePage::kBriefing;
  if (auto chosen = choose_part(stages[stage].name, to); !chosen) return chosen;
  return noted;
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
  if (part_)
    if (auto ok = write_note(file_, "part", to_text(*part_)); !ok) return ok;
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
      [order = DebriefOrder{file_, "", scenario().where, ""}](const Progress& progress) mutable {
        order.on_share = [&](double share) { progress("Replaying your attempt", share); };
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

}  // namespace osteon
