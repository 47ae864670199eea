// The water in the joint of a session: what bleeds into it, the pump as a recorded input.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "count_allocations.h"
#include "osteon/physics/joint_water.h"
#include "osteon/physics/soft_world.h"
#include "recorded_run.h"
#include "soft_fixtures.h"

namespace osteon {
namespace {

using testing::allocations;
using testing::BandRun;
using testing::begin_recording;
using testing::expect_same_replays;
using testing::kBandRadius_m;
using testing::keep_tick;
using testing::kTouch_m;
using testing::shaft_at;

constexpr std::uint64_t kPumpTick = 301, kOutletTick = 303, kMarkTick = 201;

// A ligament between femur and tibia, and a blade.
BandRun blade_run(bool sharp = true) {
  BandRun run;
  Tool blade = testing::shaft_tool();
  blade.parts = {make_rod(Vec3(0, 0, 0), Vec3(0, 0, 0.025), testing::kShaftRadius_m)};
  blade.use.cuts = sharp;
  run.tray = {std::make_shared<const Tool>(blade)};
  SoftSetup setup = *run.softs;
  if (sharp) add_blades(setup, {0}, 2);
  run.softs = std::make_shared<const SoftSetup>(setup);
  run.settings.soft_hash = setup.hash;
  return run;
}

// Down on the ligament and 6 mm into it within 0.6 s, and away again.
ToolInput blade_at(std::uint64_t n) {
  const double t = static_cast<double>(n) * 1e-3;
  const double down = std::min(1.0, t / 0.6) - std::clamp((t - 1.0) / 0.2, 0.0, 1.0);
  return shaft_at(kTouch_m + 0.003 - 0.009 * down);
}

Command pump_at(std::uint64_t n) {
  if (n == kMarkTick) return {CommandKind::kMark, 1};
  if (n == kPumpTick) return {CommandKind::kPump, 90 * kPa_per_mmHg};
  if (n == kOutletTick) return {CommandKind::kOutlet, 1};
  return {};
}

void run_to(Session& session, std::uint64_t from, std::uint64_t to) {
  for (std::uint64_t n = from; n <= to; ++n) (void)session.tick(blade_at(n), pump_at(n));
}

const WaterState& water_of(const Session& session) { return session.bones().water; }

TEST(Water, ACaseWithoutAJointThatIsFilledIsDry) {
  Session session(testing::two_box_case(), {});
  (void)session.tick(testing::hand_at(1), {CommandKind::kPump, 9000});
  EXPECT_EQ(water_of(session), WaterState{});
}

TEST(Water, ALigamentThatIsCutBleedsAndABluntShaftOpensNothing) {
  for (const bool sharp : {false, true}) {
    const BandRun run = blade_run(sharp);
    Session session = run.session();
    run_to(session, 1, 1500);
    ASSERT_TRUE(water_of(session).on);
    ASSERT_EQ(session.softs()->state().bands[0].torn, sharp);
    double open_m2 = 0;
    for (const Wound& wound : water_of(session).wounds) open_m2 += wound.open_m2;
    EXPECT_EQ(water_of(session).blood > 0, sharp);
    if (!sharp) {
      EXPECT_EQ(open_m2, 0);
      continue;
    }
    // Both ends, and a little where the blade pressed before.
    const double ends_m2 = 2 * std::numbers::pi * kBandRadius_m * kBandRadius_m;
    EXPECT_GT(open_m2, ends_m2);
    EXPECT_LT(open_m2, 1.2 * ends_m2);
    const Wound& wound = water_of(session).wounds[0];
    EXPECT_EQ(run.the_case->softs[wound.soft].name, "acl");
    const Vec3 p_W = session.bones().bones[wound.bone.index].X_WB * wound.p_B;
    EXPECT_LT((p_W - testing::kBandMiddle).norm(), 0.006);
  }
}

TEST(Water, ThePumpIsAnInputThatAReplayRepeatsFromTheStartAndTheMiddle) {
  const BandRun run = blade_run();
  Session session = run.session();
  Recording recording = begin_recording(run);
  for (std::uint64_t n = 1; n <= 1500; ++n) {
    (void)session.tick(blade_at(n), pump_at(n));
    keep_tick(recording, session, 250);
  }
  EXPECT_EQ(water_of(session).pump_pa, 90 * kPa_per_mmHg);
  EXPECT_EQ(water_of(session).outlet_open, 1);
  expect_same_replays(recording, run, session, {0.0, 0.25, 0.5, 1.25});
}

TEST(Water, ARestorePointBringsBackTheWaterAndLeavesThePump) {
  const BandRun run = blade_run();
  Session session = run.session();
  run_to(session, 1, 1500);
  ASSERT_GT(water_of(session).blood, 0);
  (void)session.tick(blade_at(1501), {CommandKind::kRestore, 1});
  (void)session.tick(blade_at(1502));
  EXPECT_EQ(water_of(session).blood, 0);
  EXPECT_EQ(water_of(session).wounds[0], Wound{});
  EXPECT_EQ(water_of(session).pump_pa, 90 * kPa_per_mmHg);
  EXPECT_EQ(water_of(session).outlet_open, 1);
}

TEST(Water, AStateThatHoldsNumbersThatAreNoneIsRefused) {
  const BandRun run = blade_run();
  Session session = run.session();
  run_to(session, 1, 700);
  SessionState state = session.save();
  ASSERT_TRUE(session.restore(state));
  state.world.bones.water.pressure_pa = std::nan("");
  EXPECT_FALSE(session.restore(state));
}

// Recordings of older versions have no word of water: it flows in their replays, but their hashes
// are those that they were recorded with.
TEST(Water, OlderRecordingsKeepTheirHashes) {
  const BandRun run = blade_run();
  nlohmann::json json = nlohmann::json::parse(to_json(run.settings));
  ASSERT_EQ(json.erase("water"), 1u);
  const auto old = parse_settings(json.dump());
  ASSERT_TRUE(old) << old.error().message();
  EXPECT_FALSE(old->water);
  for (const bool hashed : {false, true}) {
    SessionSettings settings = run.settings;
    settings.water = hashed;
    Session a(run.the_case, settings, run.tray, nullptr, run.softs);
    Session b(run.the_case, settings, run.tray, nullptr, run.softs);
    for (std::uint64_t n = 1; n <= 100; ++n) {
      (void)a.tick(blade_at(n));
      (void)b.tick(blade_at(n), n == 2 ? Command{CommandKind::kPump, 1000} : Command{});
    }
    EXPECT_NE(water_of(a).pressure_pa, water_of(b).pressure_pa);
    EXPECT_EQ(a.state_hash() != b.state_hash(), hashed);
  }
}

TEST(Water, AllocatesNothingInTicksAndSteps) {
  const BandRun run = blade_run();
  Session session = run.session();
  for (std::uint64_t n = 1; n <= 1500; ++n) {
    const ToolInput input = blade_at(n);
    const std::uint64_t before = allocations();
    const ToolState& tool = session.haptic_tick(input, session.bones());
    if (n % 2 == 0) (void)session.physics_step(tool, pump_at(n + 1));
    ASSERT_EQ(allocations(), before) << n;
  }
  EXPECT_GT(water_of(session).blood, 0);
}

}  // namespace
}  // namespace osteon
