#include "runs/live_run.h"

#include <algorithm>
#include <utility>

#include "loops/device_log.h"
#include "osteon/device/mouse_device.h"

namespace osteon {
namespace {

constexpr double kShownForceLimit_n = 8.0;  // of a device without motors: a teaching device's
// In contact the mouse's hand stays this near to the probe: else a long drag into bone would have
// to be undone all the way before the probe comes off.
constexpr double kTether_m = 0.015;
constexpr double kLogged_s = 20;

// A device with motors and a pose of its own, which is not the program's.
bool is_real(const DeviceChoice& choice) {
  return choice.info.peak_force_n > 0 && !plays_demo(choice);
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

LiveRun::LiveRun(std::shared_ptr<const Case> the_case, std::string case_source, ProbePath demo,
                 const FeelSettings& feel)
    : case_(std::move(the_case)),
      case_source_(std::move(case_source)),
      demo_(std::move(demo)),
      feel_(feel),
      snapshot_{rest_snapshot(*case_), {}} {}

Result<void> LiveRun::start(const DeviceChoice& choice, const Pose& X_WD_start,
                            const MappingSettings& user, const Quat& q_WC) {
  if (recording_) return fail("stop the recording before choosing another device");
  choice_ = choice;
  user_ = sane(user);
  q_WC_ = q_WC;
  force_on_ = true;
  return start_run(X_WD_start, nullptr);
}

// Before the first tick has been seen it is where the run began.
Pose LiveRun::probe_now() const {
  return snapshot_.tool.tick > 0 ? snapshot_.tool.X_WP : X_WD_wanted_;
}

// Leaves the run's device in `held_` and keeps what tripped.
void LiveRun::end_run() {
  if (!runtime_) return;
  const ForceOff cause = runtime_->device_status().cause;
  tripped_ = cause == ForceOff::kSoftware ? ForceOff::kNone : cause;
  (void)runtime_->stop();
  held_ = runtime_->take_device();
  runtime_.reset();
  mouse_ = nullptr;
  pad_ = nullptr;
}

// A real device stays open from run to run: it may have been homed by hand, and no other program
// shall have it in between.
Result<std::unique_ptr<HapticDevice>> LiveRun::device_for_next_run() {
  end_run();
  std::unique_ptr<HapticDevice> held = std::move(held_);
  const bool same = device_driver_ == choice_.driver && device_serial_ == choice_.info.serial;
  same_device_ = held && same && is_real(choice_) && held->read().connected;
  if (!same) tripped_ = ForceOff::kNone;
  device_driver_ = choice_.driver;
  device_serial_ = choice_.info.serial;
  if (same_device_) return held;
  if (held) held->close();
  auto opened = open_choice(choice_, demo_);
  if (!opened || force_log_.empty() || choice_.info.peak_force_n <= 0) return opened;
  return std::make_unique<DeviceLog>(std::move(*opened), kLogged_s, force_log_);
}

DeviceMapping LiveRun::mapping_at(const Pose& X_WD_start, HapticDevice& device) const {
  DeviceMapping mapping;
  if (plays_demo(choice_)) return mapping;
  mapping.X_WV = X_WD_start;
  if (!is_real(choice_)) return mapping;
  mapping.X_WV.q = user_.axes == MappingAxes::kPatient ? patient_axes() : q_WC_;
  mapping.scale = user_.scale;
  if (!same_device_) return mapping;
  // The hand is somewhere already, and there is where the probe was.
  const Pose X_VD = device.read().X_VD;
  if (is_finite(X_VD)) mapping.X_WV.p -= mapping.X_WV.q * (mapping.scale * X_VD.p);
  return mapping;
}

Result<void> LiveRun::start_run(const Pose& X_WD_start, std::unique_ptr<RecordFeed> feed) {
  auto device = device_for_next_run();
  if (!device) return tl::unexpected(device.error());
  mapping_ = mapping_at(X_WD_start, **device);
  // A list may know less than the open device, which has said what it is.
  opened_ = (*device)->info();
  settings_ = settings_for(opened_, feel_, mapping_.scale);
  X_WD_wanted_ = X_WD_start;
  mouse_ = dynamic_cast<MouseDevice*>(device->get());
  pad_ = dynamic_cast<PadDevice*>(device->get());
  recording_ = feed != nullptr;
  RunPlan plan;
  plan.the_case = case_;
  plan.settings = settings_;
  plan.mapping = mapping_;
  if (is_real(choice_)) plan.mapping_settings = user_;
  plan.force_enabled = force_on_ && tripped_ == ForceOff::kNone;
  plan.off_because = tripped_;
  runtime_ = std::make_unique<Runtime>(plan, std::move(*device), std::move(feed));
  force_.clear();
  contacts_.clear();
  runtime_->start();
  return {};
}

std::unique_ptr<HapticDevice> LiveRun::lend_device() {
  if (recording_ || !runtime_) return nullptr;
  end_run();
  return std::move(held_);
}

Result<void> LiveRun::take_back(std::unique_ptr<HapticDevice> device) {
  held_ = std::move(device);
  return start_run(probe_now(), nullptr);
}

Result<void> LiveRun::change_mapping(const MappingSettings& user, const Quat& q_WC) {
  if (recording_) return fail("stop the recording before changing the mapping");
  user_ = sane(user);
  q_WC_ = q_WC;
  return start_run(probe_now(), nullptr);
}

RecordingHeader LiveRun::header() const {
  RecordingHeader header;
  header.case_name = case_->name;
  header.case_source = case_source_;
  header.case_hash = case_->hash;
  const double scale = is_real(choice_) ? user_.scale : 1;
  const SessionSettings settings = settings_for(opened_, feel_, scale);
  header.seed = settings.seed;
  header.settings_json = to_json(settings);
  header.osteon_version = OSTEON_VERSION;
  return header;
}

Result<void> LiveRun::start_recording(const std::filesystem::path& file) {
  if (recording_) return fail("there is a recording already");
  if (!runtime_) return fail("nothing is running that could be recorded");
  std::error_code ec;
  std::filesystem::create_directories(file.parent_path(), ec);
  auto writer = RecordingWriter::create(file, header());
  if (!writer) return tl::unexpected(writer.error());
  recording_file_ = file;
  return start_run(probe_now(), std::make_unique<RecordFeed>(std::move(*writer)));
}

Result<void> LiveRun::stop_recording() {
  if (!recording_) return {};
  const Result<void> closed = runtime_->stop();
  recording_ = false;
  const Result<void> restarted = start_run(probe_now(), nullptr);
  return closed ? restarted : closed;
}

Result<void> LiveRun::end() {
  if (!runtime_) return {};
  const Result<void> closed = runtime_->stop();
  recording_ = false;
  end_run();
  if (held_) held_->close();
  held_.reset();
  return closed;
}

void LiveRun::update() {
  if (!runtime_) return;
  const RenderSnapshot& newest = runtime_->snapshot();
  if (newest.tool.tick > 0) snapshot_ = newest;
  device_status_ = runtime_->device_status();
  haptic_stats_ = runtime_->haptic_stats();
  physics_stats_ = runtime_->physics_stats();
  Telemetry point;
  while (runtime_->pop_telemetry(point)) {
    force_.add(point.peak_force_n);
    contacts_.add(point.time_s, point.bones_mask, point.peak_force_n);
  }
  if (!recording_ || runtime_->recording()) return;
  recording_failure_ = runtime_->recording_failure();
  recording_ = false;
}

std::string LiveRun::take_recording_failure() { return std::exchange(recording_failure_, {}); }

std::string LiveRun::realtime_warning() const {
  return runtime_ ? runtime_->realtime_warning() : std::string();
}

void LiveRun::set_feel(const Command& command) {
  if (command.kind == CommandKind::kSetStiffness) feel_.stiffness_n_per_m = command.value;
  if (command.kind == CommandKind::kSetFrictionScale) feel_.friction_scale = command.value;
  if (command.kind == CommandKind::kHoldBones) feel_.bones_held = command.value != 0;
  if (runtime_) runtime_->send(command);
}

void LiveRun::set_force(bool on) {
  force_on_ = on;
  if (!runtime_) return;
  runtime_->set_force_enabled(on);
  runtime_->send({CommandKind::kForceOff, on ? 0.0 : 1.0});
}

void LiveRun::move_hand(const ProbeMotion& motion, const Camera& camera, const Viewport& viewport,
                        double dt_s) {
  if (!mouse_) return;
  X_WD_wanted_ = drag_probe(X_WD_wanted_, motion, camera, viewport, dt_s);
  const ToolState& tool = snapshot_.tool;
  const Vec3 away = X_WD_wanted_.p - tool.X_WP.p;
  if (tool.contact_count > 0 && away.norm() > kTether_m)
    X_WD_wanted_.p = tool.X_WP.p + away.normalized() * kTether_m;
  mouse_->set_target(mapping_.to_device(X_WD_wanted_), 0);
}

void LiveRun::calibrate() {
  if (runtime_) runtime_->calibrate_device();
}

bool LiveRun::by_real_device() const { return is_real(choice_); }

void LiveRun::tell_hand(HandWishes pedals, const Camera& camera) {
  if (!runtime_) return;
  q_WC_ = camera.q_WC;
  pedals.turn_axes = is_real(choice_) && user_.axes == MappingAxes::kView;
  pedals.q_WV = q_WC_;
  runtime_->set_hand_wishes(pedals);
}

void LiveRun::move_pad(const PadAxes& axes_C, const Camera& camera) {
  if (!pad_) return;
  const Quat q_VC = mapping_.X_WV.q.conjugate() * camera.q_WC;
  PadAxes axes_V = axes_C;
  axes_V.move_V = q_VC * axes_C.move_V;
  axes_V.turn_V = q_VC * axes_C.turn_V;
  pad_->set_axes(axes_V);
}

}  // namespace osteon
