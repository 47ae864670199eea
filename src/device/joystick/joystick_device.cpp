#include "joystick_device.h"

#include <cmath>

#include "angles.h"
#include "pid_dialect.h"
#include "vector_dialect.h"

namespace osteon {
namespace {

std::unique_ptr<JoystickDialect> make_dialect(const JoystickProfile& profile) {
  if (profile.dialect == JoystickDialectKind::kPid) return std::make_unique<PidDialect>(profile);
  return std::make_unique<VectorDialect>(profile.info.drives_rotation());
}

}  // namespace

JoystickDevice::JoystickDevice(const JoystickProfile& profile, std::unique_ptr<UsbLink> link)
    : profile_(profile),
      link_(std::move(link)),
      dialect_(make_dialect(profile)),
      velocity_(0),
      turn_rate_(0) {}

Result<std::unique_ptr<JoystickDevice>> JoystickDevice::start(const JoystickProfile& profile,
                                                              std::unique_ptr<UsbLink> link) {
  std::unique_ptr<JoystickDevice> device(new JoystickDevice(profile, std::move(link)));
  if (auto ok = device->dialect_->open(*device->link_); !ok) return tl::unexpected(ok.error());
  device->velocity_ = VelocityEstimator(device->dialect_->resolution_m());
  device->turn_rate_ = VelocityEstimator(device->dialect_->resolution_rad());
  device->dialect_->start();
  if (auto ok = device->wait_until_ready(); !ok) return tl::unexpected(ok.error());
  return device;
}

Result<void> JoystickDevice::wait_until_ready() {
  constexpr std::int64_t kLimit_ns = 1'000'000'000;
  const std::int64_t end_ns = link_->now_ns() + kLimit_ns;
  const auto ready = [&] { return dialect_->bring_up() == BringUp::kReady && has_reading_; };
  while (!ready() && link_->now_ns() < end_ns && !link_->gone()) {
    link_->wait(0.001);
    take_packets();
    dialect_->step(*link_);
    if (dialect_->bring_up() == BringUp::kFailed)
      return fail(dialect_->failure(), profile_.info.name, "Plug it in again");
  }
  if (ready()) return {};
  return fail(link_->gone() ? "the joystick was unplugged" : "the joystick sends no valid report",
              profile_.info.name, "Plug it in again, and check that this is its profile");
}

void JoystickDevice::take_packets() {
  link_->poll();
  UsbPacket packet;
  while (link_->next_in(packet)) {
    JoystickReading reading;
    const ReportKind kind = dialect_->read(packet, reading);
    if (kind == ReportKind::kStatus) continue;
    if (kind == ReportKind::kBad || leaps(reading)) {
      ++bad_reports_;
      ++bad_in_a_row_;
      continue;
    }
    accept(reading, packet.time_ns);
  }
}

// After a silence the hand may be anywhere.
bool JoystickDevice::leaps(const JoystickReading& reading) const {
  const double dt_s = static_cast<double>(reading.time_ns - newest_.time_ns) * 1e-9;
  const double silence_s = static_cast<double>(kSilence_ns) * 1e-9;
  if (!has_reading_ || dt_s <= 0 || dt_s > silence_s) return false;
  return (reading.p_V - newest_.p_V).norm() > kImpossible_m_per_s * dt_s;
}

void JoystickDevice::accept(const JoystickReading& reading, std::int64_t arrival_ns) {
  if (arrival_ns - sample_.time_ns > kSilence_ns) {
    velocity_.reset();
    turn_rate_.reset();
  }
  has_reading_ = true;
  bad_in_a_row_ = 0;
  newest_ = reading;
  sample_.time_ns = arrival_ns;
  sample_.X_VD.p = reading.p_V;
  sample_.X_VD.q = Quat(Eigen::AngleAxisd(reading.turn_rad, profile_.rotation_axis_V));
  sample_.v_V = velocity_.add(reading.time_ns, reading.p_V);
  // Past half a turn the reading starts again from the other side.
  turn_rad_ += std::remainder(reading.turn_rad - turn_rad_, kTurn_rad);
  const Vec3 turn(turn_rad_, 0, 0);
  sample_.w_V = turn_rate_.add(reading.time_ns, turn).x() * profile_.rotation_axis_V;
  sample_.buttons = reading.buttons;
  sample_.instrument_code = reading.instrument;
}

bool JoystickDevice::dead_man_held() const {
  const bool pressed =
      profile_.dead_man_button < 0 || ((newest_.buttons >> profile_.dead_man_button) & 1u) != 0;
  return pressed && dialect_->status().dead_man_held;
}

// The program stalled while its force acted. Zero may stay as long as it likes.
bool JoystickDevice::too_late() const {
  return force_given_ && link_->now_ns() - ordered_ns_ > kOrderLife_ns;
}

ForceOff JoystickDevice::judge() const {
  if (link_->gone()) return ForceOff::kDisconnect;
  if (link_->in_error() != UsbError::kNone || link_->out_error() != UsbError::kNone)
    return ForceOff::kDeviceFault;
  if (dialect_->bring_up() == BringUp::kFailed) return ForceOff::kDeviceFault;
  if (too_late()) return ForceOff::kWatchdog;
  if (link_->now_ns() - sample_.time_ns > kSilence_ns)
    return bad_in_a_row_ > 0 ? ForceOff::kDeviceFault : ForceOff::kDisconnect;
  return dialect_->status().refusal;
}

DeviceSample JoystickDevice::read() {
  if (!link_) {
    sample_.connected = false;
    return sample_;
  }
  take_packets();
  dialect_->step(*link_);
  sample_.connected = !link_->gone();
  sample_.calibrated = dialect_->bring_up() == BringUp::kReady && dialect_->status().homed;
  sample_.dead_man_held = dead_man_held();
  sample_.refusal = judge();
  // The next force may be a tick away, or never come: what is known to be wrong ends it here.
  const bool safe = sample_.refusal == ForceOff::kNone && sample_.calibrated;
  if (!safe && force_given_) write_force(Vec3::Zero());
  return sample_;
}

// Of driven axes alone; nothing while something is wrong.
DeviceWrench JoystickDevice::given(const DeviceWrench& wanted) const {
  const bool safe = sample_.refusal == ForceOff::kNone && sample_.calibrated &&
                    sample_.dead_man_held && sample_.connected;
  if (!safe || !is_finite(wanted.force_V) || !is_finite(wanted.torque_V)) return {};
  DeviceWrench out = wanted;
  for (int i = 0; i < 3; ++i) {
    if (!profile_.info.force_axes[static_cast<std::size_t>(i)]) out.force_V[i] = 0;
    if (!profile_.info.torque_axes[static_cast<std::size_t>(i)]) out.torque_V[i] = 0;
  }
  return out;
}

void JoystickDevice::write_force(const Vec3& force_V) {
  if (!link_ || link_->gone()) return;
  const DeviceWrench out = given({force_V, torque_V_});
  torque_V_.setZero();
  force_given_ = !out.force_V.isZero(0) || !out.torque_V.isZero(0);
  ordered_ns_ = link_->now_ns();
  dialect_->send(*link_, out);
}

void JoystickDevice::close() {
  if (!link_) return;
  if (!link_->gone()) dialect_->shut_down(*link_);
  last_counters_ = link_->counters();
  link_.reset();
}

void JoystickDevice::calibrate() {
  if (!link_ || link_->gone()) return;
  link_->restart();
  dialect_->home();
}

DeviceHealth JoystickDevice::health() const {
  DeviceHealth health;
  const UsbCounters counters = link_ ? link_->counters() : last_counters_;
  health.calibration = sample_.calibrated ? Calibration::kDone : Calibration::kRunning;
  if (dialect_->bring_up() == BringUp::kFailed) health.calibration = Calibration::kNeeded;
  health.advice = dialect_->failure();
  if (!link_ || link_->gone())
    health.advice = "Plug the joystick in and choose it again";
  else if (!dialect_->status().homed)
    health.advice = "Calibrate the joystick: it does not know its position";
  health.motor_heat = dialect_->status().motor_heat;
  health.reports_in = counters.in;
  health.reports_out = counters.out;
  health.replaced = counters.replaced;
  health.bad_reports = bad_reports_;
  return health;
}

}  // namespace osteon
