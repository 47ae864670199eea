#include "window/controllers/sessions/exercise_control.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <utility>

#include "cases/xdg.h"
#include "exercises/debrief_pictures.h"
#include "exercises/pause_force.h"
#include "osteon/base/file.h"
#include "osteon/base/turn.h"
#include "osteon/physics/guide_line.h"
#include "osteon/physics/soft_setup.h"
#include "osteon/procedure/judge.h"
#include "osteon/render/anatomical_view.h"
#include "osteon/scene/graft_bench.h"
#include "runs/hands/tray.h"
#include "runs/pictures/work_camera.h"

namespace osteon {
namespace {

constexpr double kHandsApart_m = 0.025;
constexpr double kAside_m = 0.12;  // of hands that wait while two work
constexpr int kOrdersAtOnce = 8;   // about as many as the physics takes until the next picture
constexpr double kBeforePortal_m = 0.012;
constexpr double kNearExpert_m = 0.05;  // to where he has an instrument, by a key
constexpr double kArrived_m = 0.005, kHighOver_m = 0.2;
constexpr std::array<std::pair<DebriefView, DamageKind>, 3> kDamageViews{
    {{DebriefView::kForce, DamageKind::kForce},
     {DebriefView::kScratch, DamageKind::kScratch},
     {DebriefView::kHeat, DamageKind::kHeat}}};

void switch_pause(ExerciseRun& exercise, LiveRun* live) {
  const bool begins = !exercise.paused();
  if (live && begins) exercise.keep_force_wish(live->force_wanted());
  if (live)
    if (const auto force =
            force_at_pause(begins, exercise.force_was_wanted(), live->device_status().cause))
      live->set_force(*force);
  exercise.pause(begins);
}

}  // namespace

void ExerciseControl::apply(const ExerciseRequests& requests) {
  if (requests.toggle) exercise_.toggle();
  if (requests.choose) exercise_.choose(*requests.choose);
  if (requests.seed) exercise_.set_seed(*requests.seed);
  if (requests.part)
    if (const auto chosen = exercise_.choose_part(requests.part->first, requests.part->second);
        !chosen)
      host_.note(ToastKind::kWarning, chosen.error().message());
  if (requests.stop_opening && beginning_) stop_begin("");
  if (requests.back) exercise_.back();
  if (requests.begin && !cases_.loading()) open_patient();
  if (running()) {
    if (requests.hint) exercise_.show_cue();
    if (requests.undo && live_.run() && live_.run()->undo()) count_undo();
    if (LiveRun* const run = live_.run()) {
      if (requests.bend_deg) run->say({CommandKind::kBend, *requests.bend_deg});
      if (requests.tension_n) run->say({CommandKind::kTension, *requests.tension_n});
      if (requests.pull_n) run->say({CommandKind::kLachman, *requests.pull_n});
      if (requests.pivot_share) run->say({CommandKind::kPivot, *requests.pivot_share});
    }
    if (requests.ghost) ghost_.toggle();
    if (requests.guide) ghost_.toggle_guide();
    if (requests.as_expert) hold_as_expert(requests.to_expert);
    if (requests.along_expert_s > 0) follow_expert(requests.along_expert_s);
    if (requests.state) exercise_.state_finding(requests.state->first, requests.state->second);
    if (requests.pause) switch_pause(exercise_, live_.run());
    if (requests.end) ask_to_end();
  }
  if (requests.return_to && running()) go_to_start_of(*requests.return_to);
  if (requests.pages) save_pages();
  if (requests.show) wanted_ = *requests.show;
  if (requests.watch) {
    exercise_.toggle();
    cases_.open({{}, exercise_.recording(), nullptr});
  }
}

// The tip stays where it is, or comes to the expert's way: that is a hint. A shaft in a portal,
// which gives it its direction, is turned about itself alone, and goes on along his way: nobody can
// see how to lead a scope or a shaver to him there.
void ExerciseControl::hold_as_expert(bool comes_to_him) {
  LiveRun* const run = live_.run();
  if (!run || !run->by_mouse()) return;
  const bool in_portal = sight_.shown().tool.portal < scene_.portals.size();
  if (in_portal && comes_to_him) return go_on_as_expert(*run);
  const auto expert = ghost_.beside_active_hand();
  if (!expert) return tell_no_expert();
  const Pose& X_WD = run->hand(run->active()).X_WD_wanted;
  const Pose held = on_own_line(*run, *expert);
  if (!comes_to_him) return run->bring({X_WD.p, held.q});
  if (!is_near_expert(X_WD.p, held.p)) return;
  constexpr double kSame_m = 0.0005, kSame_rad = 0.01;
  if ((held.p - X_WD.p).norm() < kSame_m && held.q.angularDistance(X_WD.q) < kSame_rad)
    host_.note(ToastKind::kInfo, "Here the expert has it so, too: go on with the wheel.");
  exercise_.count_hint();
  run->bring(held);
}

// What a pin or a sleeve leads is held in its line, which need not be the expert's: until it has
// been slipped on.
Pose ExerciseControl::on_own_line(const LiveRun& run, const Pose& expert) const {
  const BoneSnapshot& bones = sight_.shown().bones;
  const std::uint32_t held = run.hand(run.active()).snapshot.tool.instrument;
  const auto& carving = run.tray().carving;
  if (!carving || held >= carving->tray.size() || !carving->tray[held]) return expert;
  if (run.active() < bones.guides.size() && bones.guides[run.active()].on) return expert;
  const auto on_rod = held_on_rod(bones.rods, std::span(bones.bones).first(bones.count),
                                  *carving->tray[held], expert);
  return on_rod && (on_rod->p - expert.p).norm() < kNearExpert_m ? *on_rod : expert;
}

void ExerciseControl::go_on_as_expert(LiveRun& run) {
  const auto onward = ghost_.onward_with_active_hand();
  if (!onward) return tell_no_expert();
  const Pose held = on_own_line(run, onward->X_WT);
  if (!is_near_expert(run.hand(run.active()).X_WD_wanted.p, held.p)) return;
  exercise_.count_hint();
  run.bring(held);
  if (onward->ends) tell_end_of_way();
}

// While the key is held. Each press of it was counted as a hint.
void ExerciseControl::follow_expert(double for_s) {
  LiveRun* const run = live_.run();
  const bool in_portal = sight_.shown().tool.portal < scene_.portals.size();
  if (!run || !run->by_mouse() || !in_portal) return;
  const auto along = ghost_.along_with_active_hand(for_s);
  if (!along) return;
  run->bring(on_own_line(*run, along->X_WT));
  if (along->ends) tell_end_of_way();
}

void ExerciseControl::tell_end_of_way() {
  host_.note(ToastKind::kInfo,
             "The expert's way to this step ends here. Press again to go along it once more.");
}

void ExerciseControl::tell_no_expert() {
  host_.note(ToastKind::kInfo,
             ghost_.model().preparing
                 ? "The expert's way is not known yet: his run is still being computed."
                 : "The expert who is shown does not hold this instrument with this hand now.");
}

bool ExerciseControl::is_near_expert(const Vec3& tip_W, const Vec3& expert_W) {
  const double away_m = (expert_W - tip_W).norm();
  if (away_m <= kNearExpert_m) return true;
  host_.note(ToastKind::kInfo, "The tip is " + std::to_string(std::lround(1e3 * away_m)) +
                                   " mm from the expert's way: bring it within 50 first.");
  return false;
}

std::vector<std::string> ExerciseControl::used_by_active_hand() const {
  if (!running() || !live_.run()) return {};
  return exercise_.used_by(live_.run()->active());
}

// What this attempt has not done is done by the expert, in an attempt that begins there.
void ExerciseControl::go_to_start_of(std::size_t stage) {
  LiveRun* const run = live_.run();
  const auto mark = exercise_.mark_of_stage(stage);
  if (run && mark && run->go_back(*mark)) {
    count_undo();
    tell_what_is_undone(stage);
  }
  if (!run || mark || !exercise_.can_begin_anew_at(stage)) return;
  if (!exercise_.wants_to_leave_for(stage))
    return host_.note(ToastKind::kWarning,
                      "You have not been there. Chosen once more, this attempt ends without a "
                      "verdict, the expert does what comes before, and you begin there.");
  stop_working();
  const auto left = exercise_.leave_for(stage);
  if (!left) host_.note(ToastKind::kError, left.error().message());
  open_patient();
}

void ExerciseControl::tell_what_is_undone(std::size_t stage) {
  const auto& stages = exercise_.scenario().stages;
  const ScenarioState* const state = exercise_.state();
  if (!state || stage >= std::min<std::size_t>(state->stage, stages.size())) return;
  host_.note(ToastKind::kInfo, "As at the start of \"" + stages[stage].title +
                                   "\": what was done since is to be done again.");
}

void ExerciseControl::count_undo() {
  exercise_.count_undo();
  ghost_.restart();
}

ExerciseModel ExerciseControl::model() const {
  ExerciseModel model = exercise_.model();
  model.ghost = ghost_.model();
  if (const Debrief* const debrief = exercise_.debrief()) {
    model.shown = shown_;
    model.shows_expert = !debrief->expert.empty();
    model.can_show.push_back(DebriefView::kWays);
    for (const auto& [view, kind] : kDamageViews)
      if (shows_damage(debrief->damage, kind)) model.can_show.push_back(view);
  }
  model.knee = exercise_.knee(sight_.shown().bones);
  for (auto& sight : exercise_.sights(sight_.shown().bones)) model.told.push_back(std::move(sight));
  return model;
}

// On the case on show, while the result is open.
void ExerciseControl::show_debrief() {
  const Debrief* const debrief = exercise_.debrief();
  if (!debrief) wanted_ = DebriefView::kNothing;
  if (wanted_ == shown_ || !scene_.renderer) return;
  shown_ = wanted_;
  std::vector<SolidMark> marks;
  if (shown_ == DebriefView::kWays) marks = way_marks(*debrief);
  for (const auto& [view, kind] : kDamageViews)
    if (shown_ == view) marks = damage_marks(*debrief, kind);
  scene_.renderer->set_marks(marks);
}

void ExerciseControl::save_pages() {
  auto file = exercise_.recording();
  file.replace_extension(".pdf");
  const auto failed = exercise_.save_pages(file);
  host_.note(failed ? ToastKind::kError : ToastKind::kInfo,
             failed ? failed->message() : "Saved as " + file.string());
}

// NAME, or NAME:SEED.
void ExerciseControl::show(const std::string& order) {
  const std::size_t colon = order.rfind(':');
  const std::string name = order.substr(0, colon);
  exercise_.toggle();
  if (!exercise_.choose(name))
    host_.note(ToastKind::kWarning, "There is no exercise '" + name + "'. Choose one of these.");
  take_made_before();
  if (colon == order.npos) return;
  // After the exercise is chosen: a course may have set another patient for it.
  std::uint64_t seed = 0;
  const char* const end = order.data() + order.size();
  if (std::from_chars(order.data() + colon + 1, end, seed) == std::from_chars_result{end, {}})
    exercise_.set_seed(seed);
  else
    host_.note(ToastKind::kWarning, "'" + order.substr(colon + 1) + "' is not a seed.");
}

// What the command line names beside the exercise.
void ExerciseControl::take_made_before() {
  if (exercise_.page() != ExercisePage::kBriefing) return;
  const auto use = [&](const std::filesystem::path& file, auto&& take) {
    if (file.empty()) return;
    const auto report = read_file(file, 16u << 20);
    const Result<void> used =
        report ? take(*report, file.string()) : Result<void>(tl::unexpected(report.error()));
    if (!used) host_.note(ToastKind::kWarning, used.error().message());
  };
  use(host_.order.graft, [&](const std::string& report, const std::string& where) {
    return exercise_.use_graft(report, where);
  });
  use(host_.order.portals, [&](const std::string& report, const std::string& where) {
    return exercise_.use_portals(report, where);
  });
  if (host_.order.from_stage.empty() && host_.order.to_stage.empty()) return;
  const auto chosen = exercise_.choose_part(host_.order.from_stage, host_.order.to_stage);
  if (!chosen) host_.note(ToastKind::kWarning, chosen.error().message());
}

// True: it goes on, or it has failed. The patient is opened once the places are known.
bool ExerciseControl::places_portals() {
  if (!placing_) {
    auto place = exercise_.portals_to_place();
    if (!place) return false;
    exercise_.wait_for_case();
    placing_ = std::make_unique<SideJob<std::string>>([place](const Progress&) { return place(); });
    return true;
  }
  if (!placing_->done()) return true;
  auto placed = placing_->take();
  placing_.reset();
  if (!placed) {
    exercise_.fail_to_begin(placed.error().message());
    return true;
  }
  exercise_.set_placed(std::move(*placed));
  return false;
}

// The patient of the exercise takes the place of what is on show, unless it is that already.
void ExerciseControl::open_patient() {
  if (live_.recording())
    return host_.note(ToastKind::kWarning, "Stop the recording before starting an exercise.");
  if (places_portals()) return;
  const std::string spec = exercise_.case_spec();
  const bool all_here = want_instruments(exercise_.scenario());
  exercise_.wait_for_case();
  const std::vector<std::string>& soft = exercise_.scenario().soft;
  if (live_.run() && scene_.the_case && scene_.source == spec && all_here &&
      scene_.softs.names == soft && scene_.carve == carve_settings(exercise_.scenario()) &&
      scene_.finer_source.empty())  // what carves its bones is ready
    return begin();
  LoadOrder order{spec, {}, nullptr};
  order.softs = soft;
  order.carve = carve_settings(exercise_.scenario());
  cases_.open(std::move(order), true);
}

// False: the tray lacked one. What removes bone is prepared with the case, by the tray.
bool ExerciseControl::want_instruments(const Scenario& scenario) {
  bool all = true;
  const auto want = [&](const std::string& name) {
    if (name == kWristProbe || live_.tray().find(name)) return;
    live_.want_instrument(name);
    all = false;
  };
  for (const ScenarioHand& hand : scenario.hands) {
    want(hand.instrument);
    for (const std::string& other : hand.also) want(other);
  }
  return all;
}

// Before their portals where they have one, else side by side. From the third on they wait farther
// aside: instruments meet, and what rests before the knee is in the way of those that go in.
std::vector<LiveControl::PlacedHand> ExerciseControl::placed(
    const std::vector<PlannedHand>& hands) const {
  std::vector<LiveControl::PlacedHand> placed;
  const Camera& camera = sight_.view().camera;
  const Pose offered = offered_probe(camera, scene_.the_case->bounds_W());
  const double middle = 0.5 * static_cast<double>(std::min<std::size_t>(hands.size(), 2) - 1);
  for (std::size_t i = 0; i < hands.size(); ++i) {
    const double right_m =
        kHandsApart_m * (static_cast<double>(i) - middle) + (i < 2 ? 0.0 : kAside_m);
    Pose X{offered.p + right_m * (camera.q_WC * Vec3::UnitX()), offered.q};
    for (const Portal& portal : find_portals(*scene_.the_case))
      if (hands[i].portal_W && (portal.p_W - *hands[i].portal_W).norm() < 1e-6)
        X = {portal.p_W - kBeforePortal_m * portal.nhat_W,
             turn_between(Vec3::UnitZ(), -portal.nhat_W).normalized()};
    const bool plain = hands[i].instrument == kWristProbe;
    placed.push_back({hands[i].name, plain ? std::string() : hands[i].instrument, X});
  }
  return placed;
}

// From straight above, as a case begins, the hands are beside the picture.
void ExerciseControl::look_at_the_box(const std::vector<PlannedHand>& hands) {
  if (anatomical_frame(*scene_.the_case).from_bones) return;
  std::vector<Vec3> portals;
  for (const PlannedHand& hand : hands)
    if (hand.portal_W) portals.push_back(*hand.portal_W);
  if (portals.empty()) {
    host_.exercise_runs = true;  // its card is wider than the one beside which the case was opened
    return sight_.look_at_all();
  }
  std::vector<Vec3> places = exercise_.places_W();
  for (const Bone& bone : scene_.the_case->bones)
    if (bone.name != "floor") places.push_back(bone.X_WB.p);
  sight_.view().camera =
      side_camera(sight_.view().camera, portals, places, sight_.viewport().aspect());
}

void ExerciseControl::begin() {
  const auto hands = exercise_.plan(scene_.the_case);
  if (!hands) return;
  Result<void> started = live_.start_placed(placed(*hands));
  const auto file = dated_file(data_home_dir() / "recordings", exercise_.scenario().name, ".osr");
  auto later = started ? exercise_.order_of_begin(live_.run()->tray(), file) : std::nullopt;
  if (later) {
    exercise_.wait_for_case();
    later->place = [tray = live_.tray()](const std::string& name) { return tray.find(name); };
    begun_hands_ = *hands;
    beginning_ = std::make_unique<SideJob<BegunAttempt>>(
        [order = std::move(*later)](const Progress& progress) {
          return begin_attempt(order, progress);
        });
    return;
  }
  if (started) started = live_.run()->start_judged_recording(file);
  if (!started) {
    exercise_.fail_to_begin(started.error().message());
    return;
  }
  exercise_.begin(SessionSettings{}.haptic.tick_s, file,
                  {"", live_.run()->tray().names, carved_now()}, live_.run()->tray().names);
  if (exercise_.scenario().stages[0].restore_point) exercise_.keep_mark(live_.run()->mark());
  begin_to_work(*hands);
}

std::function<std::optional<CarvedField>(std::uint32_t)> ExerciseControl::carved_now() const {
  return [this](std::uint32_t bone) -> std::optional<CarvedField> {
    LiveRun* const run = live_.run();
    return run ? run->carved().cut_bone(bone) : std::nullopt;
  };
}

// What the expert does before the part that is played.
void ExerciseControl::poll_begin() {
  const LoadProgress progress = beginning_->progress();
  exercise_.tell_opening(&progress);
  if (!beginning_->done()) return;
  auto begun = beginning_->take();
  beginning_.reset();
  exercise_.tell_opening(nullptr);
  if (!begun) return exercise_.fail_to_begin(begun.error().message());
  LiveRun* const run = live_.run();
  if (!run) return exercise_.fail_to_begin("The patient is no longer open.");
  exercise_.go_on(SessionSettings{}.haptic.tick_s, *begun, carved_now());
  const auto gone_on = run->go_on(std::move(begun->run));
  if (!gone_on) {
    // It holds the expert's part alone, and no attempt.
    std::error_code ec;
    std::filesystem::remove(exercise_.recording(), ec);
    return exercise_.fail_to_begin(gone_on.error().message());
  }
  exercise_.keep_mark(run->mark());
  begin_to_work(std::exchange(begun_hands_, {}));
}

void ExerciseControl::stop_begin(const std::string& why) {
  beginning_.reset();
  exercise_.tell_opening(nullptr);
  exercise_.fail_to_begin(why);
}

// The hands are in place and the time runs.
void ExerciseControl::begin_to_work(const std::vector<PlannedHand>& hands) {
  ghost_.begin(exercise_.wanted_expert(scene_.the_case->hash));
  const bool looks = std::any_of(hands.begin(), hands.end(),
                                 [](const PlannedHand& hand) { return hand.optics.has_value(); });
  const auto& felt = live_.run()->softs();
  waits_for_portal_ =
      looks && felt && std::any_of(felt->skins.begin(), felt->skins.end(), is_for_portal);
  scene_.views.set_skin_felt(waits_for_portal_);
  if (looks && !waits_for_portal_) show_scope();
  look_at_the_box(hands);
  // A cut of 10 mm is small in a picture of the whole leg. Elsewhere the picture goes by itself.
  if (waits_for_portal_ && exercise_.place_of_work() == WorkPlace::kJoint) sight_.fly_close_up({});
  skin_clear_.reset();
  at_ = WorkPlace::kJoint;
  hand_before_bench_.reset();
  ways_.clear();
  host_.note(ToastKind::kInfo, "The time is running. M takes the instrument, Esc releases it.");
}

void ExerciseControl::show_scope() {
  if (sight_.layout() == PictureLayout::kOutside) sight_.set_layout(PictureLayout::kAll);
}

// Portals are made on what is seen from outside; then a scope is in one.
void ExerciseControl::go_in_with_scope() {
  if (!waits_for_portal_ || !scene_.views.looking() || scene_.views.scope_is_before_skin()) return;
  waits_for_portal_ = false;
  show_scope();
}

// Skin that nothing feels would hide where aimers, pins and drills go. What the user chooses stays
// until that changes.
void ExerciseControl::show_skin() {
  constexpr float kClearSkin = 0.28f;
  const bool clear = exercise_.is_under_skin();
  if (clear == skin_clear_) return;
  skin_clear_ = clear;
  auto& softs = sight_.view().softs;
  for (std::size_t i = 0; i < std::min(softs.size(), scene_.the_case->softs.size()); ++i)
    if (scene_.the_case->softs[i].kind == "skin") softs[i].opacity = clear ? kClearSkin : 1;
}

// How the picture is taken elsewhere than at the joint; none: there is no such place.
std::optional<Camera> ExerciseControl::camera_at(WorkPlace place) const {
  const Case& the_case = *scene_.the_case;
  const Camera& from = sight_.view().camera;
  if (const bool near = place == WorkPlace::kFascia; near || place == WorkPlace::kBench) {
    const auto bench = find_graft_bench(the_case);
    if (bench) return bench_camera(from, *bench, sight_.viewport().aspect(), near);
  }
  const auto& felt = live_.run()->softs();
  for (std::size_t s = 0; felt && place == WorkPlace::kSkin && s < felt->skins.size(); ++s) {
    const SkinPatch& patch = felt->skins[s];
    if (!is_for_portal(patch))
      return skin_camera(from, the_case.bone(patch.bone).X_WB * patch.X_BS);
  }
  return std::nullopt;
}

// The bench is another place than the joint, and so is skin beside it: the picture goes there with
// the stage, and back. Where a part ends before a stage at the bench it stays.
void ExerciseControl::go_with_stage() {
  const ScenarioState* const state = exercise_.state();
  if (state && state->over) return;
  const WorkPlace place = exercise_.place_of_work();
  bring_to_bench(exercise_.at_bench());
  if (place == at_) return;
  Camera& camera = sight_.view().camera;
  if (place == WorkPlace::kJoint) {
    camera = camera_at_joint_;
    sight_.set_layout(layout_at_joint_);
    at_ = place;
    return;
  }
  const auto there = camera_at(place);
  if (!there) return;
  if (at_ == WorkPlace::kJoint) {
    camera_at_joint_ = camera;
    // A scope shows nothing there.
    layout_at_joint_ = sight_.layout();
    sight_.set_layout(PictureLayout::kOutside);
  }
  camera = *there;
  at_ = place;
}

// So does the hand that works there, if the mouse moves it: over the bench, clear of what lies on
// it.
void ExerciseControl::bring_to_bench(bool at_bench) {
  LiveRun& run = *live_.run();
  const Pose at = sight_.shown().tool.X_WP;
  if (!ways_.empty() && run.by_mouse() && (at.p - ways_.front().p).norm() < kArrived_m) {
    ways_.pop_front();
    if (!ways_.empty()) run.bring(ways_.front());
  }
  const bool may = run.by_mouse() && exercise_.works_at_bench(run.active());
  if (at_bench == hand_before_bench_.has_value() || !may) return;
  const auto bench = find_graft_bench(*scene_.the_case);
  if (!bench) return;
  const Pose low = beside_bench(*bench, exercise_.place_of_work() == WorkPlace::kFascia);
  const Pose high{low.p + Vec3(0, 0, kHighOver_m), low.q};
  ways_ = {high, at_bench ? low : *hand_before_bench_};
  hand_before_bench_ = at_bench ? std::optional<Pose>(at) : std::nullopt;
  run.bring(high);
}

// Set by this control, or by a hand's mark.
void ExerciseControl::follow_marks(LiveRun& run) {
  for (const LiveRun::MarkNews& news : run.take_mark_news())
    if (news.goes_back)
      exercise_.go_back(news.number);
    else
      exercise_.see_mark(news.number);
}

void ExerciseControl::poll() {
  if (!cases_.ready() && exercise_.page() != ExercisePage::kJudging) return;
  const bool judging = exercise_.page() == ExercisePage::kJudging;
  exercise_.poll();
  if (judging && exercise_.debrief() && ghost_.track()) exercise_.set_expert(*ghost_.track());
  show_debrief();
  if (placing_) return placing_->done() ? open_patient() : void();
  if (beginning_) return poll_begin();
  if (opening() && !cases_.loading()) exercise_.fail_to_begin("The patient could not be opened.");
  LiveRun* const run = live_.run();
  if (!running() || !run) return;
  ToolState tool;
  for (std::size_t h = 0; h < std::min(exercise_.hands(), run->hands()); ++h)
    while (run->pop_judged(tool, h)) exercise_.take(h, tool);
  follow_marks(*run);
  if (exercise_.follow(sight_.shown().bones)) exercise_.keep_mark(run->mark());
  go_in_with_scope();
  show_skin();
  go_with_stage();
  for (int i = 0; i < kOrdersAtOnce; ++i) {
    const auto said = exercise_.next_order(sight_.shown().bones);
    if (!said) break;
    if (run->say(*said)) continue;
    exercise_.refuse(*said);
    break;
  }
  ghost_.poll(exercise_);
  exercise_.set_guided(run->guided_s());
  if (exercise_.over() || !run->recording()) end();
}

void ExerciseControl::ask_to_end() {
  if (exercise_.wants_to_end()) return end();
  host_.note(ToastKind::kWarning, "Once more (J) ends the attempt, and it is judged.");
}

void ExerciseControl::stop_working() {
  ghost_.end();
  exercise_.pause(false);  // the force stays off: nobody asked for it
  const Result<void> stopped = live_.run()->stop_recording();
  if (!stopped) host_.note(ToastKind::kError, stopped.error().message());
  live_.let_probe_go();
}

void ExerciseControl::end() {
  stop_working();
  exercise_.judge();
}

}  // namespace osteon
