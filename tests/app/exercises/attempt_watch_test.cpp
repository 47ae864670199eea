#include "exercises/attempt_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string>

#include "cases/open_case.h"
#include "commands/support/headless.h"
#include "exercises/scenario_files.h"
#include "osteon/base/turn.h"

namespace osteon {
namespace {

ProbePath held_still(const std::string& instrument, const Pose& X_WT, double for_s) {
  ProbePath path;
  path.with_instruments = true;
  PathSample at;
  at.X_WD = X_WT;
  at.instrument = instrument;
  path.samples = {at, at};
  path.samples.back().time_s = for_s;
  return path;
}

class BentKnee : public ::testing::Test {
 protected:
  static constexpr double kFor_s = 3;

  static void SetUpTestSuite() {
    auto opened = open_case(
        "builtin:knee:0:left:acl_tear=midsubstance"
        "#femur=field,tibia=field,fibula=hull,patella=hull,flexion=120,near=100");
    ASSERT_TRUE(opened) << opened.error().message();
    knee = *opened;
  }
  static void TearDownTestSuite() { knee.reset(); }

  static Vec3 mark(const char* name) { return knee->landmarks[*find_landmark(*knee, name)].p_W; }

  // Names of the errors of the exercise that count while the knee is stretched out and bent again
  // with the scope's tip `before_m` before the femoral footprint, on the way to its portal.
  static std::set<std::string> errors_with_scope(double before_m) {
    const auto scenario = open_scenario("acl");
    EXPECT_TRUE(scenario);
    const auto plan = plan_scenario(*scenario, *knee);
    EXPECT_TRUE(plan) << plan.error().message();
    const auto hands = plan_hands(*scenario, *knee);
    EXPECT_TRUE(hands) << hands.error().message();
    HeadlessRun run;
    AttemptWatch watch(*plan, *knee, *hands, run.settings.haptic.tick_s);
    const Vec3 at = mark("acl_femur"), back = (mark("portal_al") - at).normalized();
    const Quat q = turn_between(Vec3::UnitZ(), back).normalized();
    run.the_case = knee;
    run.hands = {
        {"scope", held_still("arthroscope_30", {at + before_m * back, q}, kFor_s)},
        {"probe", held_still("hook_probe", {mark("portal_am") + Vec3(0, 0, 0.4), q}, kFor_s)}};
    int step = 0;
    run.beside = [&]() -> std::optional<Command> {
      ++step;
      if (step == 10) return Command{CommandKind::kBend, 5};
      if (step == 700) return Command{CommandKind::kBend, 95};
      return std::nullopt;
    };
    double bent_deg = 120;
    run.on_hands = [&](std::span<const ToolState* const> tools, const BoneSnapshot& bones) {
      if (bones.bend.on) bent_deg = std::min(bent_deg, bones.bend.now_deg);
      watch.add(tools, bones);
    };
    const auto done = simulate_hands(run);
    EXPECT_TRUE(done) << done.error().message();
    EXPECT_LT(bent_deg, 6) << "the knee was not bent";
    EXPECT_TRUE(watch.finish(nullptr));
    std::set<std::string> made;
    for (const MadeError& error : watch.state().errors)
      made.insert(plan->scenario.errors[error.error].name);
    return made;
  }

  static std::shared_ptr<const Case> knee;
};
std::shared_ptr<const Case> BentKnee::knee;

// From 20 mm before the footprint the tibia takes the tip 19 mm along. A tip close to the footprint
// is near the axis of the bend, moves little and is pressed with less than what counts.
TEST_F(BentKnee, AScopeThatIsLeftInTheJointIsPressedAndCounts) {
  EXPECT_TRUE(errors_with_scope(0.020).contains("scuffed"));
}

TEST_F(BentKnee, AScopeThatWasTakenOutIsNot) { EXPECT_TRUE(errors_with_scope(0.3).empty()); }

}  // namespace
}  // namespace osteon
