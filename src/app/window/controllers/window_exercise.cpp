#include <algorithm>
#include <utility>

#include "osteon/procedure/judge.h"
#include "runs/tray.h"
#include "window/window_app.h"

namespace osteon {
namespace {

constexpr double kHandsApart_m = 0.025;
constexpr double kBeforePortal_m = 0.012;

}  // namespace

void WindowApp::apply_exercise(const ExerciseRequests& requests) {
  if (requests.toggle) exercise_.toggle();
  if (requests.choose) exercise_.choose(*requests.choose);
  if (requests.seed) exercise_.set_seed(*requests.seed);
  if (requests.back) exercise_.back();
  if (requests.begin && !job_) open_exercise();
  if (exercise_.page() == ExercisePage::kRunning) {
    if (requests.hint) exercise_.show_cue();
    if (requests.undo && live_ && live_->undo()) exercise_.count_undo();
    if (requests.end) end_exercise();
  }
  if (requests.pages) {
    auto file = exercise_.recording();
    file.replace_extension(".pdf");
    const auto failed = exercise_.save_pages(file);
    note(failed ? ToastKind::kError : ToastKind::kInfo,
         failed ? failed->message() : "Saved as " + file.string());
  }
  if (requests.watch) {
    exercise_.toggle();
    open({{}, exercise_.recording(), nullptr});
  }
}

// As the command line names it.
void WindowApp::show_exercise(const std::string& name) {
  exercise_.toggle();
  if (!exercise_.choose(name))
    note(ToastKind::kWarning, "There is no exercise '" + name + "'. These are there.");
}

// The patient of the exercise takes the place of what is on show, unless it is that already.
void WindowApp::open_exercise() {
  if (live_ && live_->recording())
    return note(ToastKind::kWarning, "Stop the recording before an exercise.");
  const std::string spec = exercise_.case_spec();
  const bool all_here = want_instruments(exercise_.scenario());
  exercise_.wait_for_case();
  if (live_ && case_ && case_source_ == spec && all_here) return begin_exercise();
  open({spec, {}, nullptr});
}

// False: the tray lacked one. What removes bone is prepared with the case, by the tray.
bool WindowApp::want_instruments(const Scenario& scenario) {
  bool all = true;
  for (const ScenarioHand& hand : scenario.hands) {
    if (hand.instrument == kWristProbe || tray_.find(hand.instrument)) continue;
    instruments_.push_back(hand.instrument);
    all = false;
  }
  return all;
}

std::vector<Pose> WindowApp::exercise_poses(const std::vector<PlannedHand>& hands) const {
  std::vector<Pose> poses;
  const Pose offered = offered_probe(view_.camera, case_->bounds_W());
  const double middle = 0.5 * static_cast<double>(hands.size() - 1);
  for (std::size_t i = 0; i < hands.size(); ++i) {
    const double right_m = kHandsApart_m * (static_cast<double>(i) - middle);
    Pose X{offered.p + right_m * (view_.camera.q_WC * Vec3::UnitX()), offered.q};
    for (const Portal& portal : portals_)
      if (hands[i].portal_W && (portal.p_W - *hands[i].portal_W).norm() < 1e-6)
        X = {portal.p_W - kBeforePortal_m * portal.nhat_W,
             Quat::FromTwoVectors(Vec3::UnitZ(), -portal.nhat_W).normalized()};
    poses.push_back(X);
  }
  return poses;
}

// One device serves all hands by turns; hands by mouse have a mouse each.
Result<void> WindowApp::start_exercise_hands(const std::vector<PlannedHand>& hands) {
  std::vector<std::string> wanted;
  for (const PlannedHand& hand : hands)
    wanted.push_back(hand.instrument == kWristProbe ? std::string() : hand.instrument);
  make_tray();
  make_live();
  const int chosen = find_choice(choices_, settings_.device);
  const DeviceChoice& choice = choices_[static_cast<std::size_t>(chosen)];
  const std::vector<Pose> poses = exercise_poses(hands);
  const auto order = [&](std::size_t i) {
    return LiveHandOrder{choice, hands.size() > 1 ? hands[i].name : std::string(),
                         tray_.find(wanted[i]).value_or(0), mapping_for(choice)};
  };
  std::vector<LiveHandOrder> orders;
  const std::size_t at_once = choice.driver == "mouse" ? hands.size() : 1;
  for (std::size_t i = 0; i < at_once; ++i) orders.push_back(order(i));
  auto started = live_->start(orders, {poses.begin(), poses.begin() + static_cast<long>(at_once)},
                              view_.camera.q_WC);
  for (std::size_t i = at_once; i < hands.size() && started; ++i)
    started = live_->add_hand(poses[i], order(i).instrument);
  return started;
}

void WindowApp::begin_exercise() {
  const auto hands = exercise_.plan(case_);
  if (!hands) return;
  Result<void> started = start_exercise_hands(*hands);
  const auto file = dated_file(data_home_dir() / "recordings", exercise_.scenario().name, ".osr");
  if (started) started = live_->start_judged_recording(file);
  if (!started) {
    exercise_.fail_to_begin(started.error().message());
    return;
  }
  exercise_.begin(SessionSettings{}.haptic.tick_s, file);
  const bool looks = std::any_of(hands->begin(), hands->end(),
                                 [](const PlannedHand& hand) { return hand.optics.has_value(); });
  if (looks && layout_ == PictureLayout::kOutside) layout_ = PictureLayout::kAll;
  note(ToastKind::kInfo, "The time runs. M takes the probe, Esc lets go of it.");
}

void WindowApp::poll_exercise() {
  exercise_.poll();
  if (exercise_.page() == ExercisePage::kOpening && !job_)
    exercise_.fail_to_begin("The patient could not be opened.");
  if (exercise_.page() != ExercisePage::kRunning || !live_) return;
  ToolState tool;
  for (std::size_t h = 0; h < std::min(exercise_.hands(), live_->hands()); ++h)
    while (live_->pop_judged(tool, h)) exercise_.take(h, tool);
  if (exercise_.follow(shown_.bones)) live_->mark();
  if (exercise_.over() || !live_->recording()) end_exercise();
}

void WindowApp::end_exercise() {
  const Result<void> stopped = live_->stop_recording();
  if (!stopped) note(ToastKind::kError, stopped.error().message());
  probe_toggled_ = false;
  exercise_.judge();
}

}  // namespace osteon
