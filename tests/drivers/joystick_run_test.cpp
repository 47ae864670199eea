#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drivers/run_loop.h"
#include "emulated/emulated_pid_joystick.h"
#include "emulated/virtual_usb.h"

namespace osteon {
namespace {

using testing::ForceGap;
using testing::press_and_slide_path;
using testing::RunLoop;

JoystickProfile profile_of(JoystickDialectKind dialect) {
  const bool pid = dialect == JoystickDialectKind::kPid;
  auto profile = load_joystick_profile(std::filesystem::path(OSTEON_SOURCE_DIR) / "assets/devices" /
                                       (pid ? "joystick_pid.toml" : "joystick_vector.toml"));
  EXPECT_TRUE(profile) << profile.error().message();
  return *profile;
}

// Steps of position and force that the reports can tell.
struct Resolution {
  double position_m;
  double force_n;
};
Resolution resolution_of(JoystickDialectKind dialect) {
  if (dialect == JoystickDialectKind::kPid) return {0.080 / 32767, 10.0 / 10000};
  return {1e-7, 1e-3};
}

// One step of position through the coupling's spring, one through its damper (a velocity is told
// to a step a tick), and one of force on each axis.
double force_resolution(const Resolution& r) {
  const HapticParams haptic;
  return haptic.stiffness_n_per_m * r.position_m +
         haptic.damping_n_s_per_m * r.position_m / haptic.tick_s + std::sqrt(3.0) * r.force_n;
}

// The whole simulator with the path felt through the bytes; the forces at the motors.
std::vector<Vec3> felt_through_bytes(JoystickDialectKind dialect, const ProbePath& path,
                                     double friction, UsbSpeed pid_speed = UsbSpeed::kHigh) {
  auto joystick = VirtualUsbJoystick::open(profile_of(dialect), {}, pid_speed);
  EXPECT_TRUE(joystick) << joystick.error().message();
  const auto lead = [&](double t) {
    const testing::WantedInV wanted = testing::wanted_in_V(path, t);
    (*joystick)->set_target(wanted.X_VD, wanted.v_V, 0);
  };
  lead(0);
  for (int i = 0; i < 500; ++i) (*joystick)->read();
  RunLoop loop(test::blocks_case(), **joystick, testing::turned_mapping(), friction);
  std::vector<Vec3> at_motors_V;
  for (double t = 0; t < path.duration_s(); t += 0.001) {
    lead(t);
    loop.tick();
    if (t > 0) at_motors_V.push_back((*joystick)->mechanics().motors());
  }
  EXPECT_EQ(loop.status().cause, ForceOff::kNone) << describe(loop.status().cause);
  EXPECT_EQ((*joystick)->health().bad_reports, 0u);
  return at_motors_V;
}

ForceGap gap(JoystickDialectKind dialect, double friction) {
  const ProbePath path = press_and_slide_path();
  const auto wanted = testing::felt_by_the_virtual_hand(path, profile_of(dialect).info, friction);
  const ForceGap g = testing::compare(wanted, felt_through_bytes(dialect, path, friction));
  std::printf("%s, friction %g: peak %.3f N, rms gap %.5f N, worst %.5f N; resolution %.5f N\n",
              dialect == JoystickDialectKind::kPid ? "PID" : "vector", friction, g.peak_n, g.rms_n,
              g.worst_n, force_resolution(resolution_of(dialect)));
  return g;
}

class JoystickRun : public ::testing::TestWithParam<JoystickDialectKind> {};

TEST_P(JoystickRun, FeelsWhatTheVirtualHandFeelsWithinItsResolution) {
  const ForceGap g = gap(GetParam(), 0);
  EXPECT_GT(g.peak_n, 1.0);
  EXPECT_LT(g.worst_n, force_resolution(resolution_of(GetParam())));
}

// Where the stylus sticks and slips depends on the path before it: a single tick may differ by what
// friction holds, on the whole it does not.
TEST_P(JoystickRun, WithFrictionTooOnTheWhole) {
  const ForceGap g = gap(GetParam(), 1);
  EXPECT_GT(g.peak_n, 1.0);
  EXPECT_LT(g.rms_n, force_resolution(resolution_of(GetParam())));
}

// Frames of 1 ms after which each of three axes can have been told anew, one a frame.
constexpr std::size_t kRefreshTicks = 3;

// By how much the force that is wanted changes, at most, within the frames that the bus needs to
// tell it: before, since an axis may be told late, and after, since a hand that feels it late is
// elsewhere by as much and may meet what comes next so much earlier.
double change_in_a_refresh(const std::vector<Vec3>& wanted, std::size_t n) {
  const std::size_t first = n - std::min(n, kRefreshTicks);
  const std::size_t last = std::min(n + kRefreshTicks, wanted.size() - 1);
  double most = 0;
  for (std::size_t k = first; k <= last; ++k) most = std::max(most, (wanted[n] - wanted[k]).norm());
  return most;
}

// At full speed the bus takes one axis a frame, the one that is farthest off. So at each tick the
// force is right to the resolution and to what the path itself changes it by while three frames
// pass; where the path asks for a steady force, to the resolution alone.
TEST(PidJoystickRun, AtFullSpeedItIsRightToTheResolutionAndTheBussOwnRefresh) {
  const auto dialect = JoystickDialectKind::kPid;
  const ProbePath path = press_and_slide_path();
  const auto wanted = testing::felt_by_the_virtual_hand(path, profile_of(dialect).info, 0);
  const auto felt = felt_through_bytes(dialect, path, 0, UsbSpeed::kFull);
  const ForceGap g = testing::compare(wanted, felt);
  const double resolution = force_resolution(resolution_of(dialect));
  double worst_beyond = 0, worst_change = 0;
  for (std::size_t n = 0; n < felt.size(); ++n) {
    const double change = change_in_a_refresh(wanted, n);
    worst_change = std::max(worst_change, change);
    worst_beyond = std::max(worst_beyond, (felt[n] - wanted[n]).norm() - change);
  }
  std::printf(
      "PID at full speed: peak %.3f N, rms gap %.5f N, worst %.5f N; resolution %.5f N, change "
      "within three frames %.5f N at most; worst gap beyond that change %.5f N\n",
      g.peak_n, g.rms_n, g.worst_n, resolution, worst_change, worst_beyond);
  EXPECT_GT(g.peak_n, 1.0);
  EXPECT_LT(worst_beyond, resolution);
  EXPECT_LT(g.rms_n, resolution);
}

INSTANTIATE_TEST_SUITE_P(, JoystickRun,
                         ::testing::Values(JoystickDialectKind::kPid, JoystickDialectKind::kVector),
                         [](const auto& instance) {
                           return instance.param == JoystickDialectKind::kPid ? "Pid" : "Vector";
                         });

}  // namespace
}  // namespace osteon
