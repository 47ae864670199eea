#include "falcon_device.h"

#include <algorithm>
#include <utility>

#include "falcon_kinematics.h"
#include "link_times.h"

namespace osteon {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kShortestPeriod_ns = kMs / 2;
constexpr std::int64_t kTalk_ns = 4 * kMs;
constexpr std::int64_t kBetweenRestarts_ns = 20 * kMs;
constexpr double kPulledOut_m = 0.170;
constexpr double kLegReach_m = 0.120;  // from the middle
constexpr int kZerosAtEnd = 5;
constexpr int kBusyWrites = 50;

std::uint8_t lights_for(const DeviceSample& sample, bool homing) {
  if (homing) return kFalconRed;
  return sample.calibrated ? kFalconGreen : kFalconBlue;
}

}  // namespace

FalconDevice::FalconDevice(std::unique_ptr<UsbLink> link, DeviceInfo info)
    : link_(std::move(link)),
      info_(std::move(info)),
      velocity_(falcon::kResolution_m),
      p_F_(falcon::kCentre_F) {
  sample_.calibrated = false;
  last_good_ns_ = link_->now_ns();
  restarted_ns_ = last_good_ns_ - kBetweenRestarts_ns;
  calibrate();
  send(Vec3::Zero());
}

FalconDevice::~FalconDevice() { FalconDevice::close(); }

DeviceSample FalconDevice::read() {
  if (!link_) return sample_;
  link_->poll();
  listen(link_->now_ns());
  UsbPacket packet;
  while (link_->next_in(packet)) take(packet);
  watch(link_->now_ns());
  keep_talking(link_->now_ns());
  return sample_;
}

// A reading comes for a command alone: who only looks (while homing, say) must be heard too.
void FalconDevice::keep_talking(std::int64_t now) {
  if (unanswered_ns_ >= 0 || now - last_sent_ns_ < kTalk_ns) return;
  const bool ordered = last_write_ns_ >= 0 && now - last_write_ns_ <= link_times::kOrderLife_ns;
  send(ordered ? allowed(ordered_V_) : Vec3::Zero());
}

void FalconDevice::take(const UsbPacket& packet) {
  if (packet.bytes.size() < kFalconStatusBytes) {
    ++health_.bad_reports;
    return;
  }
  for (const std::uint8_t byte : packet.bytes.subspan(kFalconStatusBytes)) {
    const std::uint64_t broken = reader_.broken();
    if (reader_.feed(byte)) accept(decode_report(reader_.packet()), packet.time_ns);
    health_.bad_reports += reader_.broken() - broken;
  }
}

void FalconDevice::accept(const FalconReport& report, std::int64_t time_ns) {
  unanswered_ns_ = -1;
  follow_homing(report);
  // Before homing the encoders count from anywhere.
  if (!report.all_homed()) {
    ++health_.reports_in;
    last_good_ns_ = sample_.time_ns = time_ns;
    sample_.v_V.setZero();
    velocity_.reset();
    return;
  }
  const auto p = falcon::grip_position(falcon::angles_of(report.encoders), p_F_);
  if (!p || (*p - falcon::kCentre_F).norm() > kLegReach_m) {
    ++health_.bad_reports;
    return;
  }
  ++health_.reports_in;
  last_good_ns_ = sample_.time_ns = time_ns;
  p_F_ = *p;
  sample_.X_VD.p = p_F_ - falcon::kCentre_F;
  // Two readings that waited together are told apart by no clock, but came one after the other.
  velocity_time_ns_ = std::max(time_ns, velocity_time_ns_ + kShortestPeriod_ns);
  sample_.v_V = velocity_.add(velocity_time_ns_, p_F_);
  sample_.buttons = report.grip;
  pulled_out_ = pulled_out_ || p_F_.z() > kPulledOut_m;
  sample_.calibrated = pulled_out_;
}

void FalconDevice::follow_homing(const FalconReport& report) {
  homing_ = !report.all_homed();
  if (homing_) {
    pulled_out_ = sample_.calibrated = false;
    p_F_ = falcon::kCentre_F;
  }
  health_.calibration = sample_.calibrated ? Calibration::kDone
                        : homing_          ? Calibration::kNeeded
                                           : Calibration::kRunning;
}

// Silence counts while somebody listens: what came in a pause of the program may be lost.
void FalconDevice::listen(std::int64_t now) {
  const bool paused = now - last_listened_ns_ > link_times::kSilence_ns / 2;
  if (paused && unanswered_ns_ >= 0) unanswered_ns_ = now;
  if (paused) last_good_ns_ = std::max(last_good_ns_, now - link_times::kSilence_ns / 2);
  last_listened_ns_ = now;
}

void FalconDevice::watch(std::int64_t now) {
  watch_link(now);
  if (unanswered_ns_ >= 0 && now - unanswered_ns_ > link_times::kSilence_ns)
    raise(ForceOff::kDisconnect, "The Falcon does not answer: check its power and its cable", now);
  else if (unanswered_ns_ < 0 && now - last_good_ns_ > link_times::kSilence_ns &&
           last_write_ns_ > last_good_ns_)
    raise(ForceOff::kDeviceFault, "The Falcon's readings make no sense: switch it off and on", now);
  // An order that came too late has left the motors with the one before; zero may stay.
  if (last_write_ns_ >= 0 && now - last_write_ns_ > link_times::kOrderLife_ns &&
      !ordered_V_.isZero(0))
    raise(ForceOff::kWatchdog, "Osteon was too late with its force", now);
  settle(now);
}

// An endpoint that failed must be cleared before zero can reach the motors, which is worth a wait.
void FalconDevice::watch_link(std::int64_t now) {
  if (link_->gone()) {
    sample_.connected = false;
    raise(ForceOff::kDisconnect, "The Falcon was unplugged", now);
    return;
  }
  const bool failed = link_->in_error() != UsbError::kNone || link_->out_error() != UsbError::kNone;
  if (!failed) return;
  raise(ForceOff::kDeviceFault, "The Falcon's USB connection failed: plug it in again", now);
  if (now - restarted_ns_ < kBetweenRestarts_ns) return;
  restarted_ns_ = now;
  reader_.reset();
  link_->restart();
  send(Vec3::Zero());
}

void FalconDevice::raise(ForceOff cause, const char* words, std::int64_t now) {
  const bool first = sample_.refusal == ForceOff::kNone;
  if (first) {
    sample_.refusal = cause;
    fault_words_ = words;
  }
  fault_seen_ns_ = now;
  if (first) send(Vec3::Zero());
}

void FalconDevice::settle(std::int64_t now) {
  if (sample_.refusal == ForceOff::kNone || !sample_.connected) return;
  if (now - fault_seen_ns_ < link_times::kFaultHold_ns || !ordered_V_.isZero(0)) return;
  sample_.refusal = ForceOff::kNone;
  fault_words_ = "";
}

Vec3 FalconDevice::allowed(const Vec3& force_V) const {
  if (sample_.refusal != ForceOff::kNone || !sample_.calibrated) return Vec3::Zero();
  const double size = force_V.norm();
  return size > info_.peak_force_n ? Vec3(force_V * (info_.peak_force_n / size)) : force_V;
}

void FalconDevice::write_force(const Vec3& force_V) {
  if (!link_) return;
  // Time that passed since the last order counts before this one hides it.
  watch(link_->now_ns());
  ordered_V_ = is_finite(force_V) ? force_V : Vec3::Zero();
  last_write_ns_ = link_->now_ns();
  const Vec3 force = allowed(ordered_V_);
  if (!yields_its_turn(force)) send(force);
}

// A command that once came while another was on its way keeps all later ones a frame behind: when
// that has lasted, one of them is left out. Never zero.
bool FalconDevice::yields_its_turn(const Vec3& force_V) {
  busy_writes_ = link_->out_idle() ? 0 : busy_writes_ + 1;
  if (busy_writes_ < kBusyWrites || force_V.isZero(0)) return false;
  busy_writes_ = 0;
  return true;
}

void FalconDevice::send(const Vec3& force_V) {
  FalconCommand command;
  command.motors = falcon::motor_counts(force_V, p_F_);
  command.homing = homing_;
  command.lights = lights_for(sample_, homing_);
  const FalconPacket packet = encode(command);
  last_sent_ns_ = link_->now_ns();
  if (link_->write(0, packet) && unanswered_ns_ < 0) unanswered_ns_ = last_sent_ns_;
  link_->poll();
}

void FalconDevice::close() {
  if (!link_) return;
  homing_ = false;
  sample_.calibrated = false;
  FalconCommand last;  // no force, no light
  const FalconPacket packet = encode(last);
  if (link_->out_error() != UsbError::kNone) link_->restart();
  for (int i = 0; i < kZerosAtEnd && !link_->gone(); ++i) {
    (void)link_->write(0, packet);
    for (int k = 0; k < 20 && !link_->out_idle() && !link_->gone(); ++k) {
      link_->wait(0.001);
      link_->poll();
    }
  }
  link_.reset();
  sample_.connected = false;
}

DeviceHealth FalconDevice::health() const {
  DeviceHealth health = health_;
  if (link_) {
    const UsbCounters counters = link_->counters();
    health.reports_out = counters.out;
    health.replaced = counters.replaced;
  }
  if (*fault_words_)
    health.advice = fault_words_;
  else if (health.calibration == Calibration::kNeeded)
    health.advice = "Move the grip in and out until its light turns blue";
  else if (health.calibration == Calibration::kRunning)
    health.advice = "Pull the grip towards you until its light turns green";
  return health;
}

// The marks are kept by the firmware: all that can be asked again is the look at the whole reach.
void FalconDevice::calibrate() {
  pulled_out_ = false;
  sample_.calibrated = false;
  health_.calibration = homing_ ? Calibration::kNeeded : Calibration::kRunning;
}

}  // namespace osteon
