// A retractor holds the lips of cut skin apart in a session, and another hand works between them.
#include <algorithm>

#include "count_allocations.h"
#include "osteon/physics/skin_state.h"
#include "osteon/physics/soft_world.h"
#include "osteon/scene/soft_events.h"
#include "recorded_run.h"
#include "tissue/sheet/lip_oracle.h"
#include "wound_fixtures.h"

namespace osteon {
namespace {

using testing::begin_recording;
using testing::kDeep_m;
using testing::kRetractorHalf_m;
using testing::kSkinScope;
using testing::kTrocar_m;
using testing::TwoInSkin;
using testing::wound_run;

SheetCuts cuts_in(const Session& session) {
  return kept_cuts(*wound_run().patch().sheet, session.save().world.softs.skin->patches[0].cuts);
}

TEST(SkinWound, ABladeInACutDrawsALipAsideAndFeelsItWithoutSteps) {
  Session session = wound_run().session();
  TwoInSkin hands(session);
  hands.cut();
  hands.most_n = 0;
  hands.set_in();
  EXPECT_LT(hands.most_n, 0.3);  // it goes in between the lips
  LipOracle oracle(*wound_run().patch().sheet, cuts_in(session));
  hands.steepest_n = hands.most_n = 0;
  const double thick_m = 0.0005;
  for (const double y_m : {0.003, 0.005}) {
    hands.move(0, {0, y_m, -kDeep_m}, 400);
    hands.rest(100);
    const Vec3 force = hands.force(0);
    EXPECT_NEAR(-force.y() / oracle.force_n(y_m + thick_m, kRetractorHalf_m), 1, 0.1) << y_m;
    EXPECT_LT(std::abs(force.x()) + std::abs(force.z()), 0.1 * force.norm());
    EXPECT_NEAR(hands.readout().force_n[0], force.norm(), 0.05 * force.norm());
    EXPECT_GT(hands.readout().open_m, y_m);
  }
  EXPECT_GT(hands.most_n, 2);
  EXPECT_LT(hands.steepest_n, 0.02 * hands.most_n);
  // The picture has the lips where they are held.
  const SoftPushes pushes = session.softs()->pushes();
  EXPECT_GT(pushes.lip_count, 2u);
  EXPECT_EQ(hands.count(kPortalMade, 0), 0u);
  // Taken out, nothing is left of it.
  hands.move(0, {0, 0, -kDeep_m}, 400);
  EXPECT_LT(hands.force(0).norm(), 0.05);
  hands.move(0, {0, 0, 0.020}, 400);
  EXPECT_EQ(session.softs()->pushes().lip_count, 0u);
  EXPECT_EQ(hands.readout().open_m, 0);
}

TEST(SkinWound, DrawnTooFarTheLipsSlipPast) {
  Session session = wound_run().session();
  TwoInSkin hands(session);
  hands.cut();
  hands.set_in();
  hands.most_n = hands.steepest_n = 0;
  hands.move(0, {0, 0.030, -kDeep_m}, 2000);
  EXPECT_GT(hands.most_n, 15);
  EXPECT_LT(hands.most_n, 24);  // what lips hold, and what they rub
  EXPECT_LT(hands.steepest_n, 0.5);
  hands.move(0, {0, 0, -kDeep_m}, 2000);
  EXPECT_LT(hands.force(0).norm(), 0.3);
}

// A shaft of 5.5 mm goes in where a blade holds the lips apart, and not where nothing does.
TEST(SkinWound, AnotherHandWorksBetweenTheLips) {
  double in_wound = 0;
  for (const bool held : {false, true}) {
    Session session = wound_run().session();
    TwoInSkin hands(session);
    hands.cut();
    hands.take(1, kSkinScope);
    if (held) {
      hands.set_in();
      hands.move(0, {0, 0.008, -kDeep_m}, 600);
    }
    hands.move(1, {0, 0.0035, 0.010}, 300);
    double most = 0;
    for (int n = 1; n <= 400; ++n) {
      hands.at[1].z() = 0.010 - 0.0005 * 0.1 * n;
      hands.tick();
      most = std::max(most, hands.force(1).norm());
    }
    if (!held) {
      EXPECT_GT(most, 1);
      continue;
    }
    EXPECT_LT(most, 0.2);
    in_wound = hands.force(1).norm();
    EXPECT_LT(in_wound, 0.1);
    EXPECT_EQ(hands.count(kPortalMade, 1) + hands.count(kSkinEntered, 1), 0u);
    // It swings freely from lip to blade, and meets the other lip.
    hands.move(1, {0, 0.002, -0.010}, 200);
    EXPECT_LT(hands.force(1).norm(), 0.2);
    hands.move(1, {0, -0.006, -0.010}, 600);
    hands.rest(50);
    EXPECT_GT(hands.force(1).y(), 1);
    // The retractor goes: the lips close about the shaft, which is pressed from both sides.
    hands.move(1, {0, 0, -0.010}, 400);
    hands.move(0, {0, 0.008, 0.030}, 600);
    hands.move(0, {0, 0.040, 0.030}, 300);
    EXPECT_LT(hands.force(1).norm(), 0.5);
    hands.move(1, {0, 0.002, -0.010}, 200);
    hands.rest(50);
    const double pressed_n = -hands.force(1).y();
    EXPECT_GT(pressed_n, 1);
    hands.move(1, {0, -0.002, -0.010}, 400);
    hands.rest(50);
    EXPECT_NEAR(hands.force(1).y(), pressed_n, 0.15 * pressed_n);
    hands.move(1, {0, 0, 0.020}, 300);
    hands.rest(50);
    EXPECT_LT(hands.force(1).norm(), 1e-9);
  }
}

TEST(SkinWound, ARetractorOnWholeSkinPressesItAndDoesNotGoIn) {
  Session session = wound_run().session();
  TwoInSkin hands(session);
  hands.cut();
  hands.move(0, {0, 0.008, 0.010}, 100);
  hands.move(0, {0, 0.008, -0.006}, 300);
  EXPECT_GT(hands.force(0).z(), 1);
  EXPECT_EQ(hands.readout().open_m, 0);
}

TEST(SkinWound, WhatIsHeldOpenReplaysFromTheStartAndTheMiddle) {
  Session session = wound_run().session();
  TwoInSkin hands(session);
  Recording recording = begin_recording(wound_run());
  recording.more_hands.resize(1);
  hands.into = &recording;
  hands.cut();
  hands.take(1, kSkinScope);
  hands.set_in();
  hands.move(0, {0.001, 0.007, -kDeep_m}, 600);
  hands.move(1, {0, 0.003, 0.010}, 200);
  hands.move(1, {0, 0.003, -0.010}, 400);
  hands.move(1, {0.002, -0.004, -0.010}, 400);
  hands.move(0, {-0.001, 0.002, -kDeep_m}, 400);
  testing::expect_same_replays(recording, wound_run(), session, {0.0, 1.2, 2.6, 3.3, 3.9});
}

TEST(SkinWound, HoldingALipAllocatesNothing) {
  Session session = wound_run().session();
  TwoInSkin hands(session);
  hands.cut();
  hands.set_in();
  hands.move(0, {0, 0.004, -kDeep_m}, 300);
  hands.events.reserve(10000);
  const auto before = testing::allocations();
  for (int n = 0; n < 300; ++n) {
    hands.at[0].y() = 0.004 + 1e-5 * n;
    hands.tick();
  }
  EXPECT_EQ(testing::allocations() - before, 0u);
}

}  // namespace
}  // namespace osteon
