// A stand-in for OpenHaptics' library: the same calls, two arms with an emulated hand on each, a
// servo loop that the test steps. Checks that it is used by the rules.
#include "stub_hd.h"

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <mutex>
#include <thread>
#include <vector>

#include "hd_abi.h"
#include "osteon/device/virtual_hand.h"

namespace hd = osteon::hd;
using osteon::Mat3;
using osteon::Pose;
using osteon::Quat;
using osteon::Vec3;

namespace {

constexpr std::array<const char*, 2> kNames{"Left Device", "Right Device"};
constexpr double kWorkspace_mm[6] = {-180, -50, -90, 180, 150, 30};
constexpr double kCentre_mm[3] = {0, 50, -30};

struct Arm {
  StubArm state{};
  osteon::VirtualHand hand;
  Pose told;  // by the last BeginFrame, mm
  Vec3 told_v = Vec3::Zero();
  Vec3 told_w = Vec3::Zero();
  Vec3 frame_force = Vec3::Zero();
  Vec3 frame_torque = Vec3::Zero();  // N mm
  std::int64_t frame_ns = -1;        // time of the pass with the last frame
};

struct Work {
  hd::Callback call;
  void* user;
  hd::ULong handle;
};

// The whole library's state: it is one for the process, as the real one's is.
struct Library {
  std::array<Arm, 2> arms;
  std::vector<hd::ErrorInfo> errors;
  std::vector<Work> work;
  hd::Handle current = hd::kInvalidHandle;
  hd::ULong next_handle = 1;
  std::atomic<std::int64_t> now_ns{0};  // read by any thread
  std::uint64_t misuses = 0;
  bool runs = false;
  // With STUB_HD_THREAD=1 a thread of its own steps it, as the real one's does.
  std::recursive_mutex guard;
  std::thread thread;
  std::atomic<bool> thread_ends{false};
};

Library& lib() {
  static auto* library = new Library;
  return *library;
}

using Lock = std::lock_guard<std::recursive_mutex>;

Arm* arm_of(hd::Handle handle) {
  auto& arms = lib().arms;
  return handle < arms.size() && arms[handle].state.open ? &arms[handle] : nullptr;
}

void push_error(hd::ErrorCode code) { lib().errors.push_back({code, 7, lib().current}); }

Arm* current() {
  Arm* arm = arm_of(lib().current);
  if (!arm) {
    ++lib().misuses;
    push_error(hd::kBadHandle);
  }
  return arm;
}

Vec3 vec(const double* v) { return {v[0], v[1], v[2]}; }

void reset_arm(Arm& arm) {
  arm.~Arm();
  new (&arm) Arm;
  StubArm& s = arm.state;
  s.wanted_q[0] = 1;
  s.hand_mass_kg = 0.15;
  s.grip_n_per_m = 500;
  s.grip_n_s_per_m = 12;
  s.switch_held = s.plugged = true;
  s.calibration = s.after_update = hd::kCalibrationOk;
  s.calibration_style = hd::kStyleInkwell;
  s.model = "Touch X";
  s.output_dof = 3;
  s.max_force_n = 7.9;
  s.max_continuous_n = 1.75;
  s.max_stiffness_n_per_mm = 1.5;
  s.force_off_on_error = true;
}

double in_steps(double x, double step) { return step > 0 ? std::round(x / step) * step : x; }

void tell_state(Arm& arm) {
  if (arm.state.frozen) return;
  const Pose& X = arm.hand.pose();
  for (int i = 0; i < 3; ++i) arm.told.p[i] = in_steps(1000 * X.p[i], arm.state.encoder_mm);
  arm.told.q = X.q;
  arm.told_v = 1000 * arm.hand.velocity();
  arm.told_w = arm.hand.angular_velocity();
  if (arm.state.speed != 0) arm.told_v = Vec3(arm.state.speed, 0, 0);
}

// What the motors do with the frame's force: they need power, a running loop and the library's
// leave.
void put_on_motors(Arm& arm) {
  StubArm& s = arm.state;
  Vec3 f = arm.frame_force;
  if (!f.allFinite()) {
    push_error(hd::kForceError);
    f.setZero();
  }
  if (!s.plugged || !s.force_output || !lib().runs || !s.open) f.setZero();
  if (f.norm() > s.max_force_n) f *= s.max_force_n / f.norm();
  for (int i = 0; i < 3; ++i) s.motor_n[i] = in_steps(f[i], s.dac_n);
  s.peak_motor_n = std::max(s.peak_motor_n, vec(s.motor_n).norm());
  const bool turns = s.plugged && s.force_output && lib().runs && s.open && s.output_dof >= 6;
  for (int i = 0; i < 3; ++i) s.motor_nmm[i] = turns ? arm.frame_torque[i] : 0;
  s.peak_motor_nmm = std::max(s.peak_motor_nmm, vec(s.motor_nmm).norm());
}

Pose wanted_pose(const StubArm& s) {
  return {vec(s.wanted_p_mm) / 1000,
          Quat(s.wanted_q[0], s.wanted_q[1], s.wanted_q[2], s.wanted_q[3])};
}

// A hand takes hold of the arm where it wants to be.
void take_hold(Arm& arm) {
  const StubArm& s = arm.state;
  arm.hand = osteon::VirtualHand({s.hand_mass_kg, s.grip_n_per_m, s.grip_n_s_per_m});
  arm.hand.reset(wanted_pose(s));
}

void move_hand(Arm& arm) {
  StubArm& s = arm.state;
  if (!s.plugged) std::fill_n(s.motor_n, 3, 0.0);
  arm.hand.step(0.001, wanted_pose(s), vec(s.wanted_v_mm_per_s) / 1000, vec(s.motor_n));
  for (int i = 0; i < 3; ++i) s.p_mm[i] = 1000 * arm.hand.pose().p[i];
}

// With STUB_HD_HAND=press nobody steps the hands: they wait 10 mm above the middle of the workspace
// and after a second press to 4 mm below it.
void press_by_itself(StubArm& s) {
  const double t = 1e-9 * static_cast<double>(lib().now_ns.load());
  const double down = std::clamp((t - 1.0) / 0.5, 0.0, 1.0);
  s.wanted_p_mm[0] = kCentre_mm[0];
  s.wanted_p_mm[1] = kCentre_mm[1] + 10 - 14 * down;
  s.wanted_p_mm[2] = kCentre_mm[2];
}

bool wishes(const char* name, const char* value) {
  const char* wish = std::getenv(name);
  return wish && std::strcmp(wish, value) == 0;
}

// With STUB_HD_LOG=<file>: how an arm was left.
void log_end(const char* name, const StubArm& s) {
  const char* file = std::getenv("STUB_HD_LOG");
  if (!file) return;
  std::ofstream out(file, std::ios::app);
  out << name << ": motors " << vec(s.motor_n).norm() << " N, peak " << s.peak_motor_n
      << " N, last frame " << (s.zero_frames > 0 ? "zero" : "not zero") << ", misuses "
      << lib().misuses << "\n";
}

void pass_time() {
  lib().now_ns += 1'000'000;
  static const bool by_itself = wishes("STUB_HD_HAND", "press");
  if (by_itself)
    for (Arm& arm : lib().arms) press_by_itself(arm.state);
  for (Arm& arm : lib().arms) move_hand(arm);
}

void run_work() {
  std::vector<Work> again;
  for (const Work& work : std::vector<Work>(lib().work))
    if (work.call(work.user) == hd::kCallbackContinue) again.push_back(work);
  lib().work = again;
}

void step_once() {
  const Lock lock(lib().guard);
  pass_time();
  if (lib().runs) run_work();
}

// With the priority of the real one's, where this user may have it.
void run_thread() {
  sched_param param{};
  param.sched_priority = 45;
  (void)pthread_setschedparam(pthread_self(), SCHED_FIFO, &param);
  auto next = std::chrono::steady_clock::now();
  while (!lib().thread_ends) {
    step_once();
    next += std::chrono::milliseconds(1);
    std::this_thread::sleep_until(next);
  }
}

bool threaded() { return wishes("STUB_HD_THREAD", "1"); }

struct AtLoad {
  AtLoad() { stub_hd_reset(); }
} at_load;

bool copy(double* to, const Vec3& v) {
  for (int i = 0; i < 3; ++i) to[i] = v[i];
  return true;
}

bool copy_transform(double* to, const Arm& arm) {
  Eigen::Map<Eigen::Matrix4d> X(to);
  X.setIdentity();
  X.topLeftCorner<3, 3>() = arm.told.q.toRotationMatrix();
  X.topRightCorner<3, 1>() = arm.told.p;
  if (arm.state.garbage == 1) X(0, 3) = std::numeric_limits<double>::quiet_NaN();
  if (arm.state.garbage == 2) X.topLeftCorner<3, 3>() *= 3;
  if (arm.state.garbage == 3) X(1, 3) = 1e7;
  return true;
}

bool get_property(const Arm& arm, hd::Enum what, double* to) {
  const StubArm& s = arm.state;
  if (s.quiet) return false;
  switch (what) {
    case hd::kMaxForce:
      return *to = s.max_force_n, true;
    case hd::kMaxContinuousForce:
      return *to = s.max_continuous_n, true;
    case hd::kMaxTorque:
      if (s.output_dof < 6) return false;
      return *to = 515, true;
    case hd::kMaxContinuousTorque:
      if (s.output_dof < 6) return false;
      return *to = 188, true;
    case hd::kMaxStiffness:
      return *to = s.max_stiffness_n_per_mm, true;
    case hd::kUpdateRate:
      return *to = 1000, true;
    case hd::kMotorTemperature:
      return copy(to, Vec3(s.temperature, 0.1, 0.2));
    case hd::kUsableWorkspace:
      return std::memcpy(to, kWorkspace_mm, sizeof kWorkspace_mm), true;
    default:
      return false;
  }
}

}  // namespace

extern "C" {

StubArm* stub_hd_arm(const char* name) {
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (std::strcmp(name, kNames[i]) == 0) return &lib().arms[i].state;
  return nullptr;
}

void stub_hd_reset() {
  const Lock lock(lib().guard);
  reset_arm(lib().arms[0]);
  reset_arm(lib().arms[1]);
  lib().errors.clear();
  lib().work.clear();
  lib().now_ns = 0;
  lib().misuses = 0;
  lib().runs = false;
}

void stub_hd_step(int passes) {
  for (int i = 0; i < passes; ++i) step_once();
}

void stub_hd_stall(int ms) {
  const Lock lock(lib().guard);
  for (int i = 0; i < ms; ++i) pass_time();
}

void stub_hd_want(StubArm* arm, const double* p_mm, const double* q, const double* v_mm_per_s) {
  const Lock lock(lib().guard);
  std::copy_n(p_mm, 3, arm->wanted_p_mm);
  std::copy_n(q, 4, arm->wanted_q);
  std::copy_n(v_mm_per_s, 3, arm->wanted_v_mm_per_s);
}

void stub_hd_plug(StubArm* arm, bool plugged) {
  const Lock lock(lib().guard);
  arm->plugged = plugged;
}

std::int64_t stub_hd_now_ns() { return lib().now_ns; }
bool stub_hd_scheduler_runs() { return lib().runs; }
std::uint64_t stub_hd_misuses() { return lib().misuses; }

hd::Handle hdInitDevice(const char* name) {
  const Lock lock(lib().guard);
  // The default arm is the left one.
  const char* wanted = name ? name : kNames[0];
  if (std::strcmp(wanted, "Default Device") == 0) wanted = kNames[0];
  if (lib().runs) ++lib().misuses;
  for (hd::Handle i = 0; i < kNames.size(); ++i) {
    if (std::strcmp(wanted, kNames[i]) != 0) continue;
    StubArm& s = lib().arms[i].state;
    const hd::ErrorCode refusal = s.open          ? hd::kDeviceAlreadyInitiated
                                  : !s.plugged    ? hd::kCommError
                                  : s.refuse_init ? s.refuse_init
                                                  : hd::kSuccess;
    if (refusal != hd::kSuccess) {
      push_error(refusal);
      return hd::kInvalidHandle;
    }
    s.open = true;
    s.force_output = false;
    lib().arms[i].frame_ns = -1;
    ++s.inits;
    lib().arms[i].frame_force.setZero();
    lib().arms[i].frame_torque.setZero();
    if (wishes("STUB_HD_HAND", "press")) press_by_itself(s);
    take_hold(lib().arms[i]);
    tell_state(lib().arms[i]);
    return lib().current = i;
  }
  push_error(hd::kBadHandle);
  return hd::kInvalidHandle;
}

void hdDisableDevice(hd::Handle handle) {
  const Lock lock(lib().guard);
  Arm* arm = arm_of(handle);
  if (!arm || lib().runs) {
    ++lib().misuses;
    return;
  }
  log_end(kNames[handle], arm->state);
  arm->state.open = false;
  ++arm->state.disables;
  put_on_motors(*arm);
}

void hdMakeCurrentDevice(hd::Handle handle) {
  const Lock lock(lib().guard);
  lib().current = handle;
}

void hdBeginFrame(hd::Handle handle) {
  const Lock lock(lib().guard);
  lib().current = handle;
  Arm* arm = current();
  if (!arm) return;
  StubArm& s = arm->state;
  if (s.in_frame) ++lib().misuses;
  s.in_frame = true;
  ++s.frames;
  // One frame a pass is allowed.
  if (lib().runs && arm->frame_ns == lib().now_ns) {
    ++lib().misuses;
    push_error(hd::kFrameError);
  }
  arm->frame_ns = lib().now_ns;
  if (!s.plugged) push_error(hd::kCommError);
  if (s.raise != hd::kSuccess) {
    push_error(s.raise);
    if (s.force_off_on_error) s.force_output = false;
    s.raise = hd::kSuccess;
  }
  tell_state(*arm);
}

void hdEndFrame(hd::Handle handle) {
  const Lock lock(lib().guard);
  Arm* arm = arm_of(handle);
  if (!arm || !arm->state.in_frame) {
    ++lib().misuses;
    return;
  }
  arm->state.in_frame = false;
  arm->state.zero_frames = arm->frame_force.isZero(0) ? arm->state.zero_frames + 1 : 0;
  put_on_motors(*arm);
}

hd::ErrorInfo hdGetError() {
  const Lock lock(lib().guard);
  if (lib().errors.empty()) return {};
  const hd::ErrorInfo newest = lib().errors.back();
  lib().errors.pop_back();
  return newest;
}

const char* hdGetErrorString(hd::ErrorCode code) {
  return code == hd::kInvalidLicense ? "Invalid license" : "Stub error";
}

void hdEnable(hd::Enum what) {
  const Lock lock(lib().guard);
  if (Arm* arm = current(); arm && what == hd::kForceOutput) arm->state.force_output = true;
}

void hdDisable(hd::Enum what) {
  const Lock lock(lib().guard);
  Arm* arm = current();
  if (!arm || what != hd::kForceOutput) return;
  arm->state.force_output = false;
  put_on_motors(*arm);
}

hd::Boolean hdIsEnabled(hd::Enum what) {
  const Lock lock(lib().guard);
  Arm* arm = current();
  return arm && what == hd::kForceOutput && arm->state.force_output;
}

void hdGetDoublev(hd::Enum what, double* to) {
  const Lock lock(lib().guard);
  Arm* arm = current();
  if (!arm) return;
  bool known = false;
  if (what == hd::kTransform) known = copy_transform(to, *arm);
  if (what == hd::kVelocity) known = copy(to, arm->told_v);
  if (what == hd::kAngularVelocity) known = copy(to, arm->told_w);
  if (!known && !get_property(*arm, what, to)) push_error(hd::kInvalidEnum);
}

void hdSetDoublev(hd::Enum what, const double* from) {
  const Lock lock(lib().guard);
  Arm* arm = current();
  if (!arm || (what != hd::kForce && what != hd::kTorque)) return;
  if (!arm->state.in_frame) ++lib().misuses;
  // An arm without these motors was never to be told of them.
  if (what == hd::kTorque && arm->state.output_dof < 6) {
    ++lib().misuses;
    push_error(hd::kInvalidEnum);
    return;
  }
  (what == hd::kForce ? arm->frame_force : arm->frame_torque) = vec(from);
}

void hdGetIntegerv(hd::Enum what, int* to) {
  const Lock lock(lib().guard);
  const Arm* arm = current();
  if (!arm) return;
  if (what == hd::kButtons) *to = arm->state.buttons;
  if (what == hd::kOutputDof && !arm->state.quiet) *to = arm->state.output_dof;
  if (what == hd::kCalibrationStyle) *to = static_cast<int>(arm->state.calibration_style);
}

void hdGetBooleanv(hd::Enum what, hd::Boolean* to) {
  const Lock lock(lib().guard);
  const Arm* arm = current();
  if (arm && what == hd::kSafetySwitch) *to = arm->state.switch_held;
  if (arm && what == hd::kInkwellSwitch) *to = arm->state.inkwell;
}

const char* hdGetString(hd::Enum what) {
  const Lock lock(lib().guard);
  const Arm* arm = current();
  if (!arm || arm->state.quiet) return nullptr;
  return what == hd::kModel ? arm->state.model : nullptr;
}

hd::Enum hdCheckCalibration() {
  const Lock lock(lib().guard);
  const Arm* arm = current();
  return arm ? arm->state.calibration : 0;
}

void hdUpdateCalibration(hd::Enum style) {
  const Lock lock(lib().guard);
  Arm* arm = current();
  if (!arm) return;
  // Calibrating moves the reading: under force that would be a kick.
  if (vec(arm->state.motor_n).norm() > 0) ++lib().misuses;
  if (!(style & arm->state.calibration_style)) return push_error(hd::kInvalidValue);
  ++arm->state.updates;
  arm->state.calibration = arm->state.after_update;
}

void hdStartScheduler() {
  Library& l = lib();
  {
    const Lock lock(l.guard);
    if (l.runs) ++l.misuses;
    l.runs = true;
  }
  if (!threaded() || l.thread.joinable()) return;
  l.thread_ends = false;
  l.thread = std::thread(run_thread);
}

void hdStopScheduler() {
  Library& l = lib();
  if (l.thread.joinable()) {
    l.thread_ends = true;
    l.thread.join();
  }
  const Lock lock(l.guard);
  l.runs = false;
  for (Arm& arm : l.arms) put_on_motors(arm);
}

void hdSetSchedulerRate(hd::ULong) {}

void hdScheduleSynchronous(hd::Callback call, void* user, std::uint16_t) {
  const Lock lock(lib().guard);
  // Beside the other work of the loop, pass by pass, while the caller waits.
  while (call(user) == hd::kCallbackContinue) step_once();
}

hd::ULong hdScheduleAsynchronous(hd::Callback call, void* user, std::uint16_t) {
  const Lock lock(lib().guard);
  lib().work.push_back({call, user, lib().next_handle});
  return lib().next_handle++;
}

void hdUnschedule(hd::ULong handle) {
  const Lock lock(lib().guard);
  std::erase_if(lib().work, [handle](const Work& work) { return work.handle == handle; });
}

}  // extern "C"
