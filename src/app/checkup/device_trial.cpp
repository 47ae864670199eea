#include <algorithm>
#include <cmath>

#include "checkup/device_findings.h"
#include "checkup/printed.h"
#include "loops/realtime.h"
#include "loops/stop_signal.h"
#include "osteon/base/clock.h"
#include "osteon/base/percentiles.h"
#include "osteon/device/safety.h"

namespace osteon {
namespace {

constexpr std::int64_t kTick_ns = 1'000'000;
constexpr double kTick_s = 1e-3;

// The device at 1 kHz, behind the gate. Leaves it at zero force.
class TrialLoop {
 public:
  TrialLoop(HapticDevice& device, const DeviceTrial& trial)
      : device_(device),
        trial_(trial),
        gate_(device.info()),
        next_ns_(steady_now_ns()),
        last_ns_(next_ns_) {}
  ~TrialLoop() { device_.write_force(Vec3::Zero()); }
  TrialLoop(const TrialLoop&) = delete;
  TrialLoop& operator=(const TrialLoop&) = delete;

  DeviceSample tick(const Vec3& force_V) {
    next_ns_ = std::max(next_ns_ + kTick_ns, steady_now_ns() - 5 * kTick_ns);
    sleep_until_ns(next_ns_);
    const std::int64_t now_ns = steady_now_ns();
    const DeviceSample sample = device_.read();
    const double dt_s = static_cast<double>(now_ns - last_ns_) * 1e-9;
    const Vec3 wished_V = ended() ? Vec3::Zero() : force_V;
    if (ended()) gate_.disable(ForceOff::kSoftware);
    device_.write_force(gate_.filter(wished_V, sample, 0, dt_s));
    last_ns_ = now_ns;
    return sample;
  }
  /// By the user, or with the program.
  bool ended() const { return stop_requested() || (trial_.cancelled && trial_.cancelled()); }
  SafetyGate& gate() { return gate_; }

 private:
  HapticDevice& device_;
  const DeviceTrial& trial_;
  SafetyGate gate_;
  std::int64_t next_ns_;  ///< when the last tick was due
  std::int64_t last_ns_;  ///< when it was
};

Finding reading_finding(TrialLoop& loop, const DeviceInfo& info, double seconds) {
  Percentiles gaps;
  std::int64_t last_ns = 0;
  const int ticks = static_cast<int>(seconds / kTick_s);
  int readings = 0;
  bool connected = true;
  for (int i = 0; i < ticks && connected && !loop.ended(); ++i) {
    const DeviceSample sample = loop.tick(Vec3::Zero());
    connected = sample.connected;
    if (sample.time_ns == last_ns) continue;
    if (last_ns != 0) gaps.add_ns(sample.time_ns - last_ns);
    last_ns = sample.time_ns;
    ++readings;
  }
  Finding out{FindingLevel::kGood, "Readings", {}, {}};
  const double rate_hz = readings / seconds;
  out.text = printed("%.0f a second (%.0f expected), interval: p50 %.2f ms, p99 %.2f ms", rate_hz,
                     info.rate_hz, gaps.quantile_ns(0.5) * 1e-6, gaps.quantile_ns(0.99) * 1e-6);
  if (!connected || readings < 2) {
    out.level = FindingLevel::kBad;
    out.todo = "Unplug it and plug it into a port of the computer itself";
  } else if (rate_hz < 0.8 * std::min(info.rate_hz, 1000.0)) {
    out.level = FindingLevel::kNote;
    out.todo = "Close other programs, and unplug other devices from the port's hub";
  }
  return out;
}

Finding calibration_finding(const HapticDevice& device, const DeviceSample& sample) {
  const DeviceHealth health = device.health();
  Finding out{FindingLevel::kGood, "Calibration", "not needed", health.advice};
  if (health.calibration == Calibration::kDone) out.text = "done";
  if (health.calibration == Calibration::kRunning) out.text = "running";
  if (health.calibration == Calibration::kNeeded) out.text = "needed";
  if (!sample.calibrated) {
    out.level = FindingLevel::kBad;
    if (out.todo.empty()) out.todo = "Follow the device's page in docs/devices.md";
  }
  return out;
}

Findings health_findings(const HapticDevice& device, const DeviceSample& sample) {
  Findings out;
  const DeviceHealth health = device.health();
  if (health.motor_heat >= 0)
    out.push_back({health.motor_heat < 0.8 ? FindingLevel::kGood : FindingLevel::kNote,
                   "Motors",
                   printed("at %.0f %% of their thermal limit", 100 * health.motor_heat),
                   {}});
  if (health.bad_reports > 0)
    out.push_back(
        {FindingLevel::kNote, "Reports",
         printed("%llu of %llu were garbled", static_cast<unsigned long long>(health.bad_reports),
                 static_cast<unsigned long long>(health.reports_in)),
         "Try another cable or port"});
  if (sample.refusal != ForceOff::kNone)
    out.push_back({FindingLevel::kBad, "Device", describe(sample.refusal), {}});
  return out;
}

// A force that rises and falls on one axis; how far the device went along it, m.
double answer_to_push(TrialLoop& loop, int axis, const DeviceTrial& trial, double newtons) {
  const Vec3 start_V = loop.tick(Vec3::Zero()).X_VD.p;
  double farthest_m = 0;
  const int ticks = static_cast<int>(trial.push_s / kTick_s);
  for (int i = 0; i < 2 * ticks && !loop.ended(); ++i) {
    const double share = 1 - std::abs(i - ticks) / static_cast<double>(ticks);
    const DeviceSample sample = loop.tick(share * newtons * Vec3::Unit(axis));
    farthest_m = std::max(farthest_m, (sample.X_VD.p - start_V)[axis]);
  }
  return farthest_m;
}

Findings push_findings(TrialLoop& loop, const DeviceInfo& info, const DeviceTrial& trial) {
  Findings out;
  loop.gate().enable();
  for (int i = 0; i < 600 && !loop.ended(); ++i) loop.tick(Vec3::Zero());  // the ramp-in
  const double newtons = std::min(trial.push_n, 0.5 * info.peak_force_n);
  for (int axis = 0; axis < 3; ++axis) {
    if (!info.force_axes[static_cast<std::size_t>(axis)]) continue;
    const double way_m = answer_to_push(loop, axis, trial, newtons);
    if (loop.ended()) break;
    Finding f{FindingLevel::kGood,
              "Force",
              printed("%c: %.2f N moved the hand by %.2f mm", "XYZ"[axis], newtons, way_m * 1e3),
              {}};
    if (way_m < 1e-4) {
      f.level = FindingLevel::kNote;
      f.todo = "Hold it loosely; if it still does not move, the axis gives no force";
    }
    out.push_back(std::move(f));
    if (loop.gate().enabled()) continue;
    out.push_back({FindingLevel::kBad, "Force", describe(loop.gate().cause()), {}});
    break;
  }
  return out;
}

}  // namespace

Findings try_device(HapticDevice& device, const DeviceTrial& trial) {
  const DeviceInfo& info = device.info();
  Findings out;
  TrialLoop loop(device, trial);
  out.push_back(reading_finding(loop, info, trial.read_s));
  const DeviceSample sample = loop.tick(Vec3::Zero());
  out.push_back(calibration_finding(device, sample));
  for (Finding& f : health_findings(device, sample)) out.push_back(std::move(f));
  if (trial.push && info.peak_force_n > 0 && worst(out) != FindingLevel::kBad && !loop.ended())
    for (Finding& f : push_findings(loop, info, trial)) out.push_back(std::move(f));
  return out;
}

Findings try_device(const Driver& driver, const DeviceInfo& info, const DeviceTrial& trial) {
  auto device = driver.open(info);
  if (!device)
    return {{FindingLevel::kBad, driver.name, device.error().message(), device.error().todo}};
  Findings out = try_device(**device, trial);
  (*device)->close();
  return out;
}

}  // namespace osteon
