#pragma once

#include <vector>

#include "app/loops/fake_device.h"
#include "loops/haptic_stage.h"
#include "loops/physics_stage.h"
#include "loops/record_feed.h"
#include "osteon/device/virtual_device.h"
#include "osteon/scene/path.h"

namespace osteon::testing {

/// The simulator's two loops around one device, in one thread and without a clock. Without the
/// passivity stage, which answers each device's own steps with a damping of its own, what a driver
/// does to the force stands alone.
struct RunLoop {
  RunLoop(std::shared_ptr<const Case> the_case, HapticDevice& device, const DeviceMapping& mapping,
          double friction_scale = 1, bool passivity = true, RecordFeed* feed = nullptr)
      : session(the_case, settings(friction_scale)),
        exchange(session.bones()),
        haptic(session, device, options(mapping, passivity), exchange, feed),
        physics(session, exchange, feed) {
    exchange.to_gate.push(GateWish::kEnable);
  }

  /// One haptic tick and the physics step when it is due.
  void tick() {
    haptic.step();
    if (++ticks_ % ticks_a_step() == 0) physics.step();
  }
  const DeviceStatus& status() { return exchange.device_status.read(); }

  static HapticStageOptions options(const DeviceMapping& mapping, bool passivity) {
    HapticStageOptions o;
    o.safety.passivity.on = passivity;
    o.mapping = mapping;
    o.tick_s = settings().haptic.tick_s;
    return o;
  }
  static SessionSettings settings(double friction_scale = 1) {
    SessionSettings s;
    s.haptic.friction_scale = friction_scale;
    return s;
  }
  static std::uint64_t ticks_a_step() {
    return static_cast<std::uint64_t>(
        std::llround(settings().physics.step_s / settings().haptic.tick_s));
  }

  Session session;
  LoopExchange exchange;
  HapticStage haptic;
  PhysicsStage physics;

 private:
  std::uint64_t ticks_ = 0;
};

/// A device that passes everything on and keeps the forces that it was given.
class Recorder : public HapticDevice {
 public:
  explicit Recorder(HapticDevice& device) : device_(device) {}
  const DeviceInfo& info() const override { return device_.info(); }
  DeviceSample read() override { return device_.read(); }
  void write_force(const Vec3& force_V) override {
    forces_V.push_back(force_V);
    device_.write_force(force_V);
  }
  void close() override { device_.close(); }

  std::vector<Vec3> forces_V;

 private:
  HapticDevice& device_;
};

/// A hand that waits above the block for the force's ramp, comes down onto it, presses 2 mm, slides
/// 12 mm and leaves: like what a user recorded.
inline ProbePath press_and_slide_path() {
  const std::vector<std::pair<double, Vec3>> way_mm = {
      {0.0, {-6, 0, 4}},  {0.8, {-6, 0, 4}}, {1.2, {-6, 0, -2}}, {1.6, {-6, 1, -2}},
      {2.4, {6, -1, -2}}, {2.8, {6, 0, -2}}, {3.2, {6, 0, 4}},   {3.5, {6, 0, 4}}};
  ProbePath path;
  for (const auto& [time_s, p_mm] : way_mm) path.samples.push_back({time_s, {p_mm / 1000}, false});
  return path;
}

/// World is z up, a device y up: a plain turn and a shift, so that every axis counts.
inline DeviceMapping turned_mapping() {
  DeviceMapping m;
  m.X_WV.q = Quat(std::sqrt(0.5), std::sqrt(0.5), 0, 0);
  m.X_WV.p = Vec3(0.001, 0.002, 0.003);
  return m;
}

/// Where a path wants the stylus at a time and how fast it moves there, in V.
struct WantedInV {
  Pose X_VD;
  Vec3 v_V;
};
inline WantedInV wanted_in_V(const ProbePath& path, double time_s) {
  const Pose now = turned_mapping().to_device(path.at(time_s).X_WD);
  const Pose next = turned_mapping().to_device(path.at(time_s + 0.001).X_WD);
  return {now, (next.p - now.p) / 0.001};
}

/// Forces in V that the virtual hand feels on the path, tick by tick: what every driver is held to.
inline std::vector<Vec3> felt_by_the_virtual_hand(const ProbePath& path, const DeviceInfo& info,
                                                  double friction_scale = 1,
                                                  bool passivity = true) {
  VirtualDevice hand(info);
  Recorder device(hand);
  RunLoop loop(test::blocks_case(), device, turned_mapping(), friction_scale, passivity);
  for (double t = 0; t < path.duration_s(); t += 0.001) {
    const WantedInV wanted = wanted_in_V(path, t);
    hand.set_target(wanted.X_VD, wanted.v_V, 0);
    loop.tick();
  }
  return device.forces_V;
}

/// How two series of forces differ.
struct ForceGap {
  double worst_n = 0;
  double rms_n = 0;
  double peak_n = 0;  ///< of the first
};

inline ForceGap compare(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  ForceGap gap;
  double sum = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const double d = (a[i] - b[i]).norm();
    gap.worst_n = std::max(gap.worst_n, d);
    gap.peak_n = std::max(gap.peak_n, a[i].norm());
    sum += d * d;
  }
  gap.rms_n = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, a.size())));
  return gap;
}

}  // namespace osteon::testing
