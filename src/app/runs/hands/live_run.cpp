#include "runs/hands/live_run.h"

#include <algorithm>
#include <utility>

#include "osteon/physics/soft_setup.h"
#include "runs/hands/begun_run.h"
#include "runs/hands/tray.h"

namespace osteon {
namespace {

constexpr double kUnfelt_n = 0.05;
constexpr double kShownForceLimit_n = 8.0;  // of a device without motors: a teaching device's

bool has_motors(const LiveHand& hand) {
  return hand.choice.info.peak_force_n > 0 && !plays_demo(hand.choice);
}

}  // namespace

SessionSettings settings_for(const DeviceInfo& info, const FeelSettings& feel, double scale) {
  SessionSettings settings;
  HapticParams& haptic = settings.haptic;
  haptic.stiffness_n_per_m = feel.stiffness_n_per_m;
  if (info.max_stiffness_n_per_m > 0)
    haptic.stiffness_n_per_m = std::min(feel.stiffness_n_per_m, info.max_stiffness_n_per_m / scale);
  haptic.friction_scale = feel.friction_scale;
  haptic.max_force_n = info.peak_force_n > 0 ? info.peak_force_n : kShownForceLimit_n;
  if (info.max_slew_n_per_s > 0) haptic.max_slew_n_per_s = info.max_slew_n_per_s;
  settings.physics.hold_bones = feel.bones_held;
  return settings;
}

void keep_to_weakest(const HapticParams& of_device, HapticParams& all) {
  all.stiffness_n_per_m = std::min(all.stiffness_n_per_m, of_device.stiffness_n_per_m);
  all.max_force_n = std::min(all.max_force_n, of_device.max_force_n);
  all.max_slew_n_per_s = std::min(all.max_slew_n_per_s, of_device.max_slew_n_per_s);
}

LiveRun::LiveRun(std::shared_ptr<const Case> the_case, std::string case_source, ProbePath demo,
                 const FeelSettings& feel, RunTray tray)
    : case_(std::move(the_case)),
      case_source_(std::move(case_source)),
      demo_(std::move(demo)),
      feel_(feel),
      tray_(std::move(tray)),
      hands_(1),
      carved_(std::make_unique<CarvedPicture>(nullptr)) {
  now().snapshot.bones = rest_snapshot(*case_);
}

Result<void> LiveRun::start(const DeviceChoice& choice, const Pose& X_WD_start,
                            const MappingSettings& user, const Quat& q_WC) {
  return start({LiveHandOrder{choice, {}, 0, user}}, {X_WD_start}, q_WC);
}

Result<void> LiveRun::start(const std::vector<LiveHandOrder>& hands,
                            const std::vector<Pose>& X_WD_start, const Quat& q_WC) {
  if (recording_) return fail("stop the recording before choosing another device");
  if (hands.empty() || hands.size() > kMaxHands || hands.size() != X_WD_start.size())
    return fail("a session has one to four hands", "hands", "Give fewer");
  end_run();
  // A device that no hand has any more is closed with its hand; the others stay open.
  for (std::size_t i = hands.size(); i < hands_.size(); ++i)
    if (hands_[i].held) hands_[i].held->close();
  hands_.resize(hands.size());
  for (std::size_t i = 0; i < hands.size(); ++i) {
    hands_[i].choice = hands[i].choice;
    hands_[i].name = hands[i].name;
    hands_[i].instrument = hands[i].instrument;
    hands_[i].user = sane(hands[i].user);
    hands_[i].orders.reset();
    if (!plays_demo(hands[i].choice) || !demo_.with_instruments || demo_.samples.empty()) continue;
    // A hand that was told what to hold takes power and jaws alone from the path.
    const bool told = hands[i].instrument != 0;
    hands_[i].orders.emplace(told ? without_instruments(demo_) : demo_, tray_.names,
                             HapticParams{}.tick_s);
    if (!told) hands_[i].instrument = hands_[i].orders->first_instrument();
  }
  active_ = 0;
  shared_ = false;
  q_WC_ = q_WC;
  force_on_ = true;
  return start_run(X_WD_start, nullptr);
}

std::vector<Pose> LiveRun::poses_now() const {
  std::vector<Pose> poses;
  for (const LiveHand& hand : hands_) poses.push_back(hand.probe_now());
  return poses;
}

// Leaves every device in its hand's `held` and keeps what tripped.
void LiveRun::end_run() {
  if (!runtime_) return;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    const ForceOff cause = runtime_->device_status(i).cause;
    hands_[i].tripped = cause == ForceOff::kSoftware ? ForceOff::kNone : cause;
    if (hands_[i].snapshot.tool.tick > 0) hands_[i].instrument = hands_[i].snapshot.tool.instrument;
  }
  (void)runtime_->stop();
  keep_devices();
  runtime_.reset();
}

void LiveRun::keep_devices() {
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    std::unique_ptr<HapticDevice> device = runtime_->take_device(i);
    if (!share_) hands_[i].held = std::move(device);
    hands_[i].mouse = nullptr;
    hands_[i].pad = nullptr;
  }
  if (share_) hands_[0].held = share_->take_device();
  share_.reset();
}

SessionSettings LiveRun::settings_now() const {
  SessionSettings settings = settings_for(hands_[0].opened, feel_, hands_[0].mapping.scale);
  for (const LiveHand& hand : hands_)
    keep_to_weakest(settings_for(hand.opened, feel_, hand.mapping.scale).haptic, settings.haptic);
  settings.hands.clear();
  for (const LiveHand& hand : hands_) settings.hands.push_back({hand.name, hand.instrument});
  settings.tray = tray_.names;
  settings.carve = tray_.carve;
  settings.carve.on = tray_.carving != nullptr;
  settings.soft_structures = !case_->softs.empty();
  if (tray_.softs.setup) {
    settings.soft = tray_.softs.names;
    settings.soft_hash = tray_.softs.setup->hash;
  }
  return settings;
}

std::unique_ptr<Runtime> LiveRun::make_runtime(std::vector<HandPlan> hands,
                                               std::unique_ptr<RecordFeed> feed, BegunRun* begun) {
  RunPlan plan;
  plan.the_case = case_;
  plan.settings = settings_;
  plan.carving = tray_.carving;
  plan.softs = tray_.softs.setup;
  if (begun)
    return std::make_unique<Runtime>(plan, std::move(hands), std::move(feed),
                                     std::move(*begun->session));
  return std::make_unique<Runtime>(plan, std::move(hands), std::move(feed), tray_.tools);
}

Result<void> LiveRun::start_run(const std::vector<Pose>& X_WD_start,
                                std::unique_ptr<RecordFeed> feed, BegunRun* begun) {
  end_run();
  auto plans = shares() ? make_shared_hands(X_WD_start) : make_hands(X_WD_start);
  if (!plans) return tl::unexpected(plans.error());
  settings_ = begun ? begun->settings : settings_now();
  recording_ = feed != nullptr;
  carved_ = begun ? std::move(begun->carved) : std::make_unique<CarvedPicture>(tray_.carving);
  ++run_number_;
  runtime_ = make_runtime(std::move(*plans), std::move(feed), begun);
  for (LiveHand& hand : hands_) {
    hand.force.clear();
    hand.contacts.clear();
    if (hand.snapshot.bones.count == 0) hand.snapshot.bones = rest_snapshot(*case_);
  }
  events_.clear();
  pushes_ = {};
  marks_.clear();
  mark_news_.clear();
  next_mark_ = 0;
  undone_at_s_ = -10;
  if (std::exchange(judged_next_, false)) runtime_->judge_ticks();
  runtime_->start();
  mark();  // the begin of a run is a restore point
  return {};
}

std::unique_ptr<HapticDevice> LiveRun::lend_device() {
  if (recording_ || !runtime_) return nullptr;
  const std::size_t of = shares() ? 0 : active_;
  end_run();
  return std::move(hands_[of].held);
}

Result<void> LiveRun::take_back(std::unique_ptr<HapticDevice> device) {
  hands_[shares() ? 0 : active_].held = std::move(device);
  return start_run(poses_now(), nullptr);
}

Result<void> LiveRun::change_mapping(const MappingSettings& user, const Quat& q_WC) {
  if (recording_) return fail("stop the recording before changing the mapping");
  for (std::size_t i = 0; i < hands_.size(); ++i)
    if (shares() || i == active_) hands_[i].user = sane(user);
  q_WC_ = q_WC;
  return start_run(poses_now(), nullptr);
}

Result<void> LiveRun::exchange_case(std::shared_ptr<const Case> the_case, std::string case_source,
                                    ProbePath demo, std::shared_ptr<const CarvingSetup> carving,
                                    RunSofts softs) {
  if (recording_) return fail("stop the recording before changing the bones");
  case_ = std::move(the_case);
  case_source_ = std::move(case_source);
  demo_ = std::move(demo);
  tray_.carving = std::move(carving);
  tray_.softs = std::move(softs);
  return runtime_ ? start_run(poses_now(), nullptr) : Result<void>();
}

bool LiveRun::touches_nothing() const {
  return std::all_of(hands_.begin(), hands_.end(), [](const LiveHand& hand) {
    return hand.snapshot.tool.contact_count == 0 && hand.snapshot.tool.force_W.norm() < kUnfelt_n;
  });
}

RecordingHeader LiveRun::header() const {
  RecordingHeader header =
      recording_header(*case_, settings_now(), case_source_, OSTEON_VERSION, tray_.tools);
  header.case_path = absolute_case_path(case_source_);
  return header;
}

Result<void> LiveRun::start_recording(const std::filesystem::path& file) {
  if (recording_) return fail("a recording is already running");
  if (!runtime_) return fail("there is no run to record");
  for (LiveHand& hand : hands_)
    if (hand.snapshot.tool.tick > 0) hand.instrument = hand.snapshot.tool.instrument;
  std::error_code ec;
  std::filesystem::create_directories(file.parent_path(), ec);
  auto writer = RecordingWriter::create(file, header());
  if (!writer) return tl::unexpected(writer.error());
  recording_file_ = file;
  return start_run(poses_now(),
                   std::make_unique<RecordFeed>(std::move(*writer), 8.0, hands_.size()));
}

Result<void> LiveRun::start_judged_recording(const std::filesystem::path& file) {
  judged_next_ = true;
  Result<void> started = start_recording(file);
  judged_next_ = false;
  return started;
}

// A device with motors holds its instrument another way than the hand before it: as after a way
// back, forces fade until all is free. How bone feels is for the device and its user to say.
Result<void> LiveRun::go_on(BegunRun begun) {
  if (recording_) return fail("a recording is already running");
  if (begun.tools.size() != hands_.size())
    return fail("the run was begun by " + std::to_string(begun.tools.size()) + " hands, not by " +
                std::to_string(hands_.size()));
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    poses.push_back(begun.tools[i].X_WD);
    hands_[i].instrument = begun.tools[i].instrument;
    hands_[i].snapshot.tool = begun.tools[i];
  }
  recording_file_ = begun.file;
  judged_next_ = true;
  auto started = start_run(poses, std::move(begun.feed), &begun);
  judged_next_ = false;
  if (!started) return started;
  const HapticParams wanted = settings_now().haptic;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    runtime_->send({CommandKind::kSetStiffness, wanted.stiffness_n_per_m}, i);
    runtime_->send({CommandKind::kSetFrictionScale, wanted.friction_scale}, i);
  }
  if (std::any_of(hands_.begin(), hands_.end(), has_motors)) go_back(marks_.back());
  return {};
}

Result<void> LiveRun::stop_recording() {
  if (!recording_) return {};
  const Result<void> closed = runtime_->stop();
  recording_ = false;
  const Result<void> restarted = start_run(poses_now(), nullptr);
  return closed ? restarted : closed;
}

Result<void> LiveRun::end() {
  if (!runtime_) return {};
  const Result<void> closed = runtime_->stop();
  recording_ = false;
  end_run();
  for (LiveHand& hand : hands_)
    if (hand.held) std::exchange(hand.held, nullptr)->close();
  return closed;
}

void LiveRun::update() {
  if (!runtime_) return;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    LiveHand& hand = hands_[i];
    const RenderSnapshot& newest = runtime_->snapshot(i);
    if (newest.tool.tick > 0) hand.snapshot = newest;
    hand.status = runtime_->device_status(i);
    hand.haptic = runtime_->haptic_stats(i);
    Telemetry point;
    while (runtime_->pop_telemetry(point, i)) {
      hand.force.add(point.peak_force_n);
      hand.contacts.add(point.time_s, point.bones_mask, point.peak_force_n);
    }
    Event event;
    while (runtime_->pop_event(event, i)) events_.add(event, settings_.haptic.tick_s);
    forgive_the_harmless(i);
    send_orders(i);
  }
  see_cuts();
  pushes_ = runtime_->pushes();
  physics_stats_ = runtime_->physics_stats();
  if (!recording_ || runtime_->recording()) return;
  recording_failure_ = runtime_->recording_failure();
  recording_ = false;
}

void LiveRun::send_orders(std::size_t i) {
  LiveHand& hand = hands_[i];
  if (!hand.orders || hand.snapshot.tool.tick == 0) return;
  if (const auto command = hand.orders->at(hand.snapshot.tool.tick))
    (void)runtime_->send(*command, i);
}

void LiveRun::see_cuts() {
  CutsPatch patch;
  while (CutsFeed* feed = runtime_->cuts_feed()) {
    if (!feed->take(patch)) return;
    carved_->take(patch);
  }
}

// A device without motors cannot hurt a hand: it goes on by itself, and the user is told.
void LiveRun::forgive_the_harmless(std::size_t i) {
  const LiveHand& hand = hands_[i];
  const ForceOff cause = hand.status.cause;
  const bool a_trip = cause == ForceOff::kVelocity || cause == ForceOff::kWatchdog;
  if (!a_trip || hand.opened.peak_force_n > 0 || !force_on_) return;
  runtime_->set_force_enabled(true, i);
  harmless_trip_ = cause == ForceOff::kVelocity
                       ? "The hand moved faster than 1 m/s: a device with motors would have "
                         "switched its force off."
                       : "This computer was too busy for a moment: a device with motors would have "
                         "switched its force off.";
}

std::string LiveRun::take_recording_failure() { return std::exchange(recording_failure_, {}); }

std::string LiveRun::take_harmless_trip() { return std::exchange(harmless_trip_, {}); }

std::string LiveRun::realtime_warning() const {
  return runtime_ ? runtime_->realtime_warning() : std::string();
}

void LiveRun::set_feel(const Command& command) {
  if (command.kind == CommandKind::kSetStiffness) feel_.stiffness_n_per_m = command.value;
  if (command.kind == CommandKind::kSetFrictionScale) feel_.friction_scale = command.value;
  if (command.kind == CommandKind::kHoldBones) feel_.bones_held = command.value != 0;
  if (!runtime_) return;
  if (command.kind == CommandKind::kGrab || command.kind == CommandKind::kHoldBones)
    return (void)runtime_->send(command, active_);
  for (std::size_t i = 0; i < hands_.size(); ++i) runtime_->send(command, i);
}

bool LiveRun::say(const Command& command) { return runtime_ && runtime_->send(command); }

bool LiveRun::set_pump(double pump_pa, double outlet_open) {
  return runtime_ && runtime_->send({CommandKind::kPump, pump_pa}) &&
         runtime_->send({CommandKind::kOutlet, outlet_open});
}

void LiveRun::set_force(bool on) {
  force_on_ = on;
  if (!runtime_) return;
  runtime_->set_force_enabled(on);
  for (std::size_t i = 0; i < hands_.size(); ++i)
    runtime_->send({CommandKind::kForceOff, on ? 0.0 : 1.0}, i);
}

void LiveRun::resume() {
  const ForceOff cause = now().status.cause;
  const bool fault = cause != ForceOff::kNone && cause != ForceOff::kSoftware;
  if (runtime_ && force_on_ && fault)
    runtime_->set_force_enabled(true, active_);
  else
    set_force(true);
}

void LiveRun::calibrate() {
  if (runtime_) runtime_->calibrate_device(active_);
}

void LiveRun::guide(std::size_t hand, const GuideLine& line) {
  if (hand < hands_.size()) hands_[hand].guide = line;
}

double LiveRun::guided_s() const {
  double longest_s = 0;
  for (const LiveHand& hand : hands_) longest_s = std::max(longest_s, hand.status.guided_s);
  return longest_s;
}

bool LiveRun::can_guide() const { return std::any_of(hands_.begin(), hands_.end(), has_motors); }

void LiveRun::tell_hand(HandWishes pedals, const Camera& camera) {
  if (!runtime_) return;
  q_WC_ = camera.q_WC;
  pedals.q_WV = q_WC_;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    const bool real = has_motors(hands_[i]);
    pedals.guide = real ? hands_[i].guide : GuideLine{};
    pedals.turn_axes = real && hands_[i].user.axes == MappingAxes::kView && !shares();
    runtime_->set_hand_wishes(pedals, i);
  }
}

}  // namespace osteon
