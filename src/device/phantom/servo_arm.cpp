#include "servo_arm.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "hd_errors.h"
#include "link_times.h"
#include "osteon/device/inkwell.h"
#include "osteon/device/safety_limits.h"

namespace osteon {
namespace {

constexpr int kFewestBad = 3;
constexpr std::uint64_t kSlowChecks = 10;  // passes between looks at heat and calibration
constexpr double kHot = 1.0;               // of the library's scale from 0 to 1
constexpr double kCooledDown = 0.8;
constexpr double kArmReach_m = 2.0;  // longer than any arm of this class
constexpr double kFastest_m_per_s = 20.0;
constexpr int kErrorsAPass = 16;  // that a broken library cannot hold the loop
constexpr double kMmPerMetre = 1000;

hd::Enum preferred_style(hd::Enum styles) {
  for (const hd::Enum style : {hd::kStyleInkwell, hd::kStyleAuto, hd::kStyleEncoderReset})
    if (styles & style) return style;
  return hd::kStyleAuto;
}

const char* calibration_advice(hd::Enum styles) {
  switch (preferred_style(styles)) {
    case hd::kStyleInkwell:
      return "Put the stylus into the inkwell";
    case hd::kStyleEncoderReset:
      return "Hold the arm in its reset position, all angles square, and press Calibrate";
    default:
      return "Move the stylus slowly through its whole reach";
  }
}

bool is_rotation(const Mat3& R) {
  return ((R.transpose() * R - Mat3::Identity()).cwiseAbs().maxCoeff() < 1e-2) &&
         R.determinant() > 0;
}

}  // namespace

struct ServoArm::Raw {
  std::array<double, 16> transform{};
  Vec3 v_mm_per_s = Vec3::Zero();
  Vec3 w_rad_per_s = Vec3::Zero();
  int buttons = 0;
  bool switch_held = true;
  bool inkwell = false;  ///< the state of its switch
};

ServoArm::ServoArm(const HdApi& api, const ArmSetup& setup, Clock now_ns)
    : api_(api), setup_(setup), now_ns_(now_ns), last_good_ns_(now_ns()) {
  state_.sample.calibrated = false;  // until the library says so
  state_.health.calibration = Calibration::kNeeded;
  to_user_.publish(state_);
}

void ServoArm::order(const DeviceWrench& wrench) {
  const bool finite = is_finite(wrench.force_V) && is_finite(wrench.torque_V);
  to_servo_.publish({finite ? wrench : DeviceWrench{}, now_ns_(), ++orders_});
}

void ServoArm::tick() {
  const bool ending = ended_;
  if (state_.sample.refusal == ForceOff::kDisconnect) {
    at_rest_ = true;
    return;
  }
  const std::int64_t now = now_ns_();
  const ForceOrder& order = to_servo_.read();
  api_.begin_frame(setup_.handle);
  const Raw raw = read_raw();
  take_errors(now);
  watch_readings(accept(raw, now), now);
  watch_orders(order, now);
  if (passes_++ % kSlowChecks == 0) {
    watch_heat(now);
    watch_calibration();
  }
  settle(order, now);
  put_out(wrench_for(order));
  api_.end_frame(setup_.handle);
  take_errors(now);
  state_.health.advice = *fault_words_ ? fault_words_ : calibration_words_;
  to_user_.publish(state_);
  at_rest_ = ending;
}

ServoArm::Raw ServoArm::read_raw() const {
  Raw raw;
  // Room for libraries that write more than one byte.
  std::array<hd::Boolean, 8> held{1};
  api_.get_doublev(hd::kTransform, raw.transform.data());
  api_.get_doublev(hd::kVelocity, raw.v_mm_per_s.data());
  api_.get_doublev(hd::kAngularVelocity, raw.w_rad_per_s.data());
  api_.get_integerv(hd::kButtons, &raw.buttons);
  if (setup_.has_dead_man) api_.get_booleanv(hd::kSafetySwitch, held.data());
  raw.switch_held = held[0] != 0;
  std::array<hd::Boolean, 8> inkwell{0};
  if (setup_.calibration_styles & hd::kStyleInkwell)
    api_.get_booleanv(hd::kInkwellSwitch, inkwell.data());
  raw.inkwell = inkwell[0] != 0;
  return raw;
}

// The reading in V and SI; one that no arm can give is refused, and the last one stays.
bool ServoArm::accept(const Raw& raw, std::int64_t now) {
  const Eigen::Map<const Eigen::Matrix4d> X(raw.transform.data());
  const Mat3 R = X.topLeftCorner<3, 3>();
  const Vec3 p = X.topRightCorner<3, 1>() / kMmPerMetre - setup_.centre_m;
  const Vec3 v = raw.v_mm_per_s / kMmPerMetre;
  const bool finite = X.array().isFinite().all() && is_finite(v) && is_finite(raw.w_rad_per_s);
  if (!finite || !is_rotation(R) || p.norm() > kArmReach_m || v.norm() > kFastest_m_per_s)
    return false;
  DeviceSample& s = state_.sample;
  s.time_ns = now;
  s.X_VD = {p, Quat(R).normalized()};
  s.v_V = v;
  s.w_V = raw.w_rad_per_s;
  s.buttons = static_cast<std::uint32_t>(raw.buttons);
  if (raw.inkwell) s.buttons |= 1u << kInkwellButton;
  s.dead_man_held = raw.switch_held;
  return true;
}

void ServoArm::take_errors(std::int64_t now) {
  for (int i = 0; i < kErrorsAPass; ++i) {
    const hd::ErrorInfo error = api_.get_error();
    if (error.code == hd::kSuccess) return;
    const ForceOff cause = force_off_for(error.code);
    if (cause != ForceOff::kNone) raise(cause, describe_hd_error(error.code), now);
  }
}

void ServoArm::watch_readings(bool good, std::int64_t now) {
  if (good) {
    last_good_ns_ = now;
    bad_in_a_row_ = 0;
    ++state_.health.reports_in;
    return;
  }
  ++state_.health.bad_reports;
  // A single one after a loop that was late is the lateness' matter.
  if (++bad_in_a_row_ >= kFewestBad && now - last_good_ns_ > link_times::kSilence_ns)
    raise(ForceOff::kDeviceFault, "The arm's readings make no sense: switch it off and on", now);
}

void ServoArm::watch_orders(const ForceOrder& order, std::int64_t now) {
  if (order.number == 0) return;
  if (order.number != last_order_) {
    state_.health.replaced += order.number - last_order_ - 1;
    last_order_ = order.number;
  }
  // Zero may stay for as long as nobody orders anything.
  if (now - order.time_ns > link_times::kOrderLife_ns && !order.is_zero())
    raise(ForceOff::kWatchdog, "Osteon was too late with its force", now);
}

void ServoArm::watch_heat(std::int64_t now) {
  std::array<double, 16> heat;
  heat.fill(-1);
  api_.get_doublev(hd::kMotorTemperature, heat.data());
  const double warmest = *std::max_element(heat.begin(), heat.end());
  state_.health.motor_heat = std::isfinite(warmest) ? warmest : -1;
  const bool still_hot =
      state_.sample.refusal == ForceOff::kTemperature && state_.health.motor_heat >= kCooledDown;
  if (state_.health.motor_heat >= kHot || still_hot)
    raise(ForceOff::kTemperature, describe_hd_error(hd::kWarmMotors), now);
}

// The library may move the reading when it calibrates, so that happens under zero force alone: the
// arm counts as not calibrated from the pass before until the library is content.
void ServoArm::watch_calibration() {
  hd::Enum status = api_.check_calibration();
  const bool wished = calibration_wished_.load();
  const bool update = wished || status == hd::kCalibrationNeedsUpdate;
  if (update && state_.sample.calibrated) {
    status = hd::kCalibrationNeedsUpdate;
  } else if (update) {
    calibration_wished_ = false;
    api_.update_calibration(preferred_style(setup_.calibration_styles));
    status = api_.check_calibration();
  }
  tell_calibration(status);
}

void ServoArm::tell_calibration(hd::Enum status) {
  state_.sample.calibrated = status == hd::kCalibrationOk;
  if (state_.sample.calibrated) {
    state_.health.calibration = Calibration::kDone;
    calibration_words_ = "";
    return;
  }
  const bool running = status == hd::kCalibrationNeedsUpdate;
  state_.health.calibration = running ? Calibration::kRunning : Calibration::kNeeded;
  calibration_words_ = calibration_advice(setup_.calibration_styles);
}

// The first cause is kept: what follows it is mostly its consequence. Only a lost arm outranks it.
void ServoArm::raise(ForceOff cause, const char* words, std::int64_t now) {
  DeviceSample& s = state_.sample;
  const bool lost = cause == ForceOff::kDisconnect;
  if (s.refusal == ForceOff::kNone || lost) {
    s.refusal = cause;
    fault_words_ = words;
  }
  if (lost) s.connected = false;
  fault_seen_ns_ = now;
}

void ServoArm::settle(const ForceOrder& order, std::int64_t now) {
  DeviceSample& s = state_.sample;
  if (s.refusal == ForceOff::kNone || s.refusal == ForceOff::kDisconnect) return;
  if (now - fault_seen_ns_ < link_times::kFaultHold_ns || !order.is_zero()) return;
  s.refusal = ForceOff::kNone;
  fault_words_ = "";
  // The library itself may have switched its force off.
  if (!api_.is_enabled(hd::kForceOutput)) api_.enable(hd::kForceOutput);
}

DeviceWrench ServoArm::wrench_for(const ForceOrder& order) const {
  const DeviceSample& s = state_.sample;
  const bool allowed = s.refusal == ForceOff::kNone && s.calibrated && s.dead_man_held && !ended_;
  if (!allowed || order.number == 0) return {};
  return {clamped_norm(order.wrench.force_V, setup_.peak_force_n),
          clamped_norm(order.wrench.torque_V, setup_.peak_torque_nm)};
}

// An arm without driven rotations would take the call for a mistake.
void ServoArm::put_out(const DeviceWrench& wrench) {
  api_.set_doublev(hd::kForce, wrench.force_V.data());
  if (setup_.peak_torque_nm > 0) {
    const Vec3 torque_nmm = kMmPerMetre * wrench.torque_V;
    api_.set_doublev(hd::kTorque, torque_nmm.data());
  }
  ++state_.health.reports_out;
}

}  // namespace osteon
