// What parts of tools that press one solid do to each other.
#include "soft/solid_presses.h"

#include <gtest/gtest.h>

#include <numbers>

#include "osteon/base/turn.h"
#include "osteon/physics/soft_solid_setup.h"
#include "osteon/scene/case.h"
#include "physics/disc_fixtures.h"

namespace osteon {
namespace {

constexpr double kBlock_n_per_m = 900, kCoupling_n_per_m = 2000, kBall_m = 0.001;
const Vec3 kBlockHalf(0.012, 0.008, 0.003);

// A block on a bone.
std::shared_ptr<const Case> block_case() {
  CaseDef def;
  def.name = "a block on a bone";
  BoneDef bone;
  bone.name = "tibia";
  bone.mesh = testing::disc_block({-0.02, -0.02, -0.02}, {0.02, 0.02, 0.02});
  bone.X_WB.p = {0, 0, -0.04};
  def.bones.push_back(bone);
  SoftDef soft;
  soft.name = "medial_meniscus";
  soft.tissue = soft.kind = "meniscus";
  soft.mesh_W = testing::disc_block(-kBlockHalf, kBlockHalf);
  soft.bones = {"tibia"};
  def.softs.push_back(soft);
  auto built = build_case(std::move(def));
  return built ? std::make_shared<const Case>(std::move(*built)) : nullptr;
}

/// Two hands with a ball each, one from above and one from below, over the block's free end.
struct Pinched {
  std::shared_ptr<const Case> the_case = block_case();
  SoftSetup setup;
  BoneSnapshot bones;
  SoftState state;
  std::array<SolidHand, 2> hands;
  std::array<ToolState, 2> tools;
  std::vector<RoundBox> ball;

  explicit Pinched(double deep_m) {
    auto solids = make_soft_solids(*the_case, std::vector<std::string>{"menisci"}, kBlock_n_per_m);
    EXPECT_TRUE(solids);
    if (solids) add_solids(setup, std::move(*solids));
    bones = rest_snapshot(*the_case);
    RoundBox part;
    part.rod = {Vec3::Zero(), Vec3::Zero(), kBall_m};
    ball.push_back(part);
    for (std::size_t h = 0; h < 2; ++h) {
      const double side = h == 0 ? 1 : -1;
      tools[h].X_WP.p = {0.008, 0, side * (kBlockHalf.z() + kBall_m + 0.001)};
      hands[h].tool = &tools[h];
      hands[h].parts = ball;
    }
    for (const double gap_m : {0.001, -deep_m}) step_to(gap_m);
  }
  void step_to(double gap_m) {
    SolidPresses presses(setup, kCoupling_n_per_m);
    ASSERT_TRUE(presses.place(0, bones));
    for (std::size_t h = 0; h < 2; ++h) {
      tools[h].X_WP.p.z() = (h == 0 ? 1 : -1) * (kBlockHalf.z() + kBall_m + gap_m);
      presses.follow(state.solid_hands[h], hands[h], state);
    }
  }
  double press_first() {
    SolidPresses presses(setup, kCoupling_n_per_m);
    EXPECT_TRUE(presses.place(0, bones));
    presses.press(state.solid_hands[0], hands[0], state);
    return state.solid_hands[0].near[0].force_n;
  }
};

// However hard the other hand pressed in the last step, this one meets no more than the block is,
// brought nearer by as much as the other is deep in it; so their forces cannot raise each other
// without end. Before that was so, they could.
TEST(SolidPresses, AnotherHandBringsAPlaceNoNearerThanItIsDeep) {
  const double deep_m = 0.001;
  Pinched pinched(deep_m);
  ASSERT_EQ(pinched.state.solid_hands[0].count, 1u);
  ASSERT_EQ(pinched.state.solid_hands[1].count, 1u);
  const double alone_n = pinched.press_first();
  EXPECT_GT(alone_n, 0.2 * kBlock_n_per_m * deep_m);
  SolidNear& other = pinched.state.solid_hands[1].near[0];
  other.force_n = 1e6;
  EXPECT_GT(pinched.press_first(), 100 * alone_n);
  let_presses_be_bounded(pinched.setup);
  EXPECT_NEAR(pinched.press_first(), 2 * alone_n, 0.02 * alone_n);
  // A gentle one counts as it did.
  other.force_n = 1e-3;
  const double gentle_n = pinched.press_first();
  pinched.setup.presses_are_bounded = false;
  EXPECT_EQ(pinched.press_first(), gentle_n);
}

TEST(SolidPresses, ABoundChangesNothingWhereNothingIsASolid) {
  SoftSetup setup;
  let_presses_be_bounded(setup);
  EXPECT_FALSE(setup.presses_are_bounded);
  EXPECT_EQ(setup.hash, SoftSetup().hash);
}

// What jaws pull comes no nearer than they have gone with it.
TEST(SolidPresses, APullBringsAPlaceNoNearerThanTheJawsHaveGone) {
  Pinched pinched(0.001);
  pinched.state.solid_hands[1].count = 0;
  const double alone_n = pinched.press_first();
  SoftGrip& grip = pinched.state.grips[1];
  grip.hold.of = SoftHold::Of::kSolid;
  grip.hold.p_B = Vec3(0.008, 0, -kBlockHalf.z()) - Vec3(0, 0, -0.04);
  grip.against_B = -Vec3::UnitZ();
  grip.force_n = 1e6;
  grip.most_m = 0.0005;
  EXPECT_GT(pinched.press_first(), 100 * alone_n);
  let_presses_be_bounded(pinched.setup);
  EXPECT_NEAR(pinched.press_first(), 1.5 * alone_n, 0.02 * alone_n);
}

// A drill: a head and the smooth shaft behind it, which is hardly thinner.
struct DrillOverBlock {
  std::shared_ptr<const Case> the_case = block_case();
  SoftSetup setup;
  BoneSnapshot bones;
  SoftState state;
  SolidHand hand;
  ToolState tool;
  std::vector<RoundBox> parts;

  explicit DrillOverBlock(bool wait) {
    auto solids = make_soft_solids(*the_case, std::vector<std::string>{"menisci"}, kBlock_n_per_m);
    EXPECT_TRUE(solids);
    if (solids) add_solids(setup, std::move(*solids));
    if (wait) let_covered_parts_wait(setup);
    bones = rest_snapshot(*the_case);
    parts.push_back(round_box(Capsule{{0, 0, 0.022}, {0, 0, 0.2}, kShaft_m}));
    parts.push_back(round_box(Capsule{{0, 0, 0.0022}, {0, 0, 0.022}, kHead_m}));
    // Its shaft towards +y, which is across the block, over the block's free end.
    tool.X_WP.q = Quat(Eigen::AngleAxisd(-kTurn / 4, Vec3::UnitX()));
    tool.X_WP.p = {0.008, -0.012, kBlockHalf.z() + kHead_m + 0.002};
    hand.tool = &tool;
    hand.parts = parts;
  }
  void move(const Vec3& by, int steps) {
    SolidPresses presses(setup, kCoupling_n_per_m);
    ASSERT_TRUE(presses.place(0, bones));
    for (int n = 0; n < steps; ++n) {
      tool.X_WP.p += by / steps;
      presses.follow(state.solid_hands[0], hand, state);
      presses.press(state.solid_hands[0], hand, state);
      for (std::uint32_t i = 0; i < state.solid_hands[0].count; ++i) {
        const SolidNear& near = state.solid_hands[0].near[i];
        along_n = std::max(along_n, std::abs(near.contact.nhat_B.y()) * near.force_n);
        barred = barred || near.barred;
      }
    }
  }
  double up_n() const {
    double sum = 0;
    for (std::uint32_t i = 0; i < state.solid_hands[0].count; ++i)
      sum += state.solid_hands[0].near[i].contact.nhat_B.z() * state.solid_hands[0].near[i].force_n;
    return sum;
  }
  double along_n = 0;   ///< most that it was held along itself
  bool barred = false;  ///< something went in that is not felt

  static constexpr double kTurn = 2 * std::numbers::pi, kHead_m = 0.00215, kShaft_m = 0.002125;
};

// The head of a drill presses the block's surface aside; the shaft behind it goes on over what the
// head has pressed down, and is not stopped by the block's side as if the block still stood there.
TEST(SolidPresses, AShaftIsNotStoppedByWhatItsHeadHasPressedAside) {
  for (const bool wait : {false, true}) {
    SCOPED_TRACE(wait);
    DrillOverBlock drill(wait);
    drill.move({0, 0, -0.005}, 100);
    const double head_n = drill.up_n();
    ASSERT_GT(head_n, 1);
    EXPECT_LT(drill.along_n, 0.05 * head_n);
    drill.move({0, -0.016, 0}, 800);
    EXPECT_EQ(drill.barred, wait);
    if (!wait) {
      EXPECT_GT(drill.along_n, 2 * head_n);  // recordings from before it was so
      continue;
    }
    EXPECT_LT(drill.along_n, 0.05 * head_n);
    EXPECT_NEAR(drill.up_n(), head_n, 0.2 * head_n);
    // Once it has been out of the block, it is felt.
    drill.move({0, 0, 0.009}, 200);
    EXPECT_EQ(drill.up_n(), 0);
    drill.barred = false;
    drill.move({0, 0, -0.009}, 200);
    EXPECT_FALSE(drill.barred);
    EXPECT_GT(drill.up_n(), 1);
  }
}

TEST(SolidPresses, CoveredPartsWaitOnlyWhereThereAreSolids) {
  SoftSetup setup;
  let_covered_parts_wait(setup);
  EXPECT_FALSE(setup.covered_parts_wait);
  EXPECT_EQ(setup.hash, SoftSetup().hash);
}

}  // namespace
}  // namespace osteon
