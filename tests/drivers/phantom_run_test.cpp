#include <gtest/gtest.h>

#include "device/phantom/stub_library.h"
#include "drivers/run_loop.h"

namespace osteon {
namespace {

using testing::ForceGap;
using testing::motor_force;
using testing::press_and_slide_path;
using testing::RunLoop;
using testing::StubLibrary;

const Vec3 kCentre_mm(0, 50, -30);  // of the stub's usable workspace

void lead(StubArm& arm, const ProbePath& path, double t) {
  const testing::WantedInV wanted = testing::wanted_in_V(path, t);
  testing::want(arm, 1000 * wanted.X_VD.p + kCentre_mm, 1000 * wanted.v_V);
  const Quat& q = wanted.X_VD.q;
  const double turn[4] = {q.w(), q.x(), q.y(), q.z()};
  std::copy_n(turn, 4, arm.wanted_q);
}

// One arm in the whole simulator: its own session, device and loops.
struct ArmRun {
  ArmRun(StubArm& the_arm, const std::shared_ptr<HdSession>& session, const char* name,
         double the_friction, bool with_passivity)
      : arm(the_arm),
        friction(the_friction),
        passivity(with_passivity),
        device(PhantomDevice::open(session, name).value()),
        loop(test::blocks_case(), *device, testing::turned_mapping(), friction, passivity) {}
  StubArm& arm;
  double friction;
  bool passivity;
  std::unique_ptr<HapticDevice> device;
  RunLoop loop;
  std::vector<Vec3> at_motors_V;
};

// All of them along the path at once; the first servo pass is the one that answers no order.
void run(StubLibrary& stub, const std::vector<ArmRun*>& runs, const ProbePath& path) {
  for (double t = 0; t < path.duration_s(); t += 0.001) {
    for (ArmRun* run : runs) lead(run->arm, path, t);
    stub.step(1);
    for (ArmRun* run : runs) {
      if (t > 0) run->at_motors_V.push_back(motor_force(run->arm));
      run->loop.tick();
    }
  }
}

ForceGap gap_of(const ArmRun& run, const ProbePath& path, const char* what) {
  const auto wanted =
      testing::felt_by_the_virtual_hand(path, run.device->info(), run.friction, run.passivity);
  const ForceGap gap = testing::compare(wanted, run.at_motors_V);
  std::printf("%s, friction %g: peak %.3f N, rms gap %.4f N, worst %.4f N\n", what, run.friction,
              gap.peak_n, gap.rms_n, gap.worst_n);
  return gap;
}

// One step of the encoders through the coupling and one step of the motors' current.
double force_resolution(const StubArm& arm) {
  return HapticParams{}.stiffness_n_per_m * arm.encoder_mm / 1000 + arm.dac_n;
}

void make_real(StubLibrary& stub) {
  stub.left->encoder_mm = 0.023;  // Touch X
  stub.left->dac_n = 2 * 7.9 / 4096;
  stub.right->encoder_mm = 0.055;  // Touch
  stub.right->dac_n = 2 * 7.9 / 4096;
}

// The path through both arms at once; what each felt against the virtual hand.
std::vector<std::pair<ForceGap, double>> run_both(StubLibrary& stub, double friction,
                                                  bool passivity) {
  const ProbePath path = press_and_slide_path();
  lead(*stub.left, path, 0);
  lead(*stub.right, path, 0);
  const auto session = stub.session();
  ArmRun left(*stub.left, session, "Left Device", friction, passivity);
  ArmRun right(*stub.right, session, "Right Device", friction, passivity);
  run(stub, {&left, &right}, path);
  EXPECT_EQ(left.loop.status().cause, ForceOff::kNone);
  EXPECT_EQ(right.loop.status().cause, ForceOff::kNone);
  return {{gap_of(left, path, "left arm"), force_resolution(*stub.left)},
          {gap_of(right, path, "right arm"), force_resolution(*stub.right)}};
}

// An arm without steps feels the same but for its servo pass of delay.
TEST(PhantomRun, TwoExactArmsAtOnceFeelWhatTheVirtualHandFeels) {
  StubLibrary stub;
  for (const auto& [gap, resolution] : run_both(stub, 1, true)) {
    EXPECT_GT(gap.peak_n, 1.0);
    EXPECT_LT(gap.worst_n, 0.05);
    EXPECT_LT(gap.rms_n, 0.005);
  }
  EXPECT_EQ(stub.misuses(), 0u);
}

TEST(PhantomRun, RealArmsFeelItWithinTheirResolution) {
  StubLibrary stub;
  make_real(stub);
  for (const auto& [gap, resolution] : run_both(stub, 0, false)) {
    EXPECT_GT(gap.peak_n, 1.0);
    EXPECT_LT(gap.worst_n, resolution);
  }
}

// Where the stylus sticks and slips depends on the path before it: there the force of a single tick
// may differ by what friction holds, on the whole it does not.
TEST(PhantomRun, WithFrictionTooOnTheWhole) {
  StubLibrary stub;
  make_real(stub);
  for (const auto& [gap, resolution] : run_both(stub, 1, true)) {
    EXPECT_GT(gap.peak_n, 1.0);
    EXPECT_LT(gap.rms_n, resolution);
    EXPECT_LT(gap.worst_n, 3 * resolution);
  }
}

}  // namespace
}  // namespace osteon
