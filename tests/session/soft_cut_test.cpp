// A meniscus that is cut in a session: a block on a bone, with the shipped punch and blades.
#include <gtest/gtest.h>

#include "driven_hand.h"
#include "osteon/base/random.h"
#include "osteon/carve/carved_surface.h"
#include "osteon/mesh/measure.h"
#include "osteon/physics/soft_cut_state.h"
#include "osteon/physics/soft_shape.h"
#include "osteon/physics/soft_world.h"
#include "osteon/scene/instrument.h"
#include "osteon/scene/soft_events.h"
#include "recorded_run.h"
#include "soft_solid_fixtures.h"

namespace osteon {
namespace {

using testing::begin_recording;
using testing::DrivenHand;
using testing::expect_same_replays;
using testing::go_on_as;
using testing::keep_state;
using testing::kMeniscus_n_per_m;
using testing::kMeniscusHalf;
using testing::posed;

enum : std::uint32_t { kBall, kRound, kBasket, kBlade };

struct CutRun : testing::MeniscusRun {
  CutRun() {
    settings.tray = {"ball", "scalpel_15", "basket_punch", "scalpel_11"};
    const auto instruments = load_instruments();
    EXPECT_TRUE(instruments);
    for (std::size_t i = 1; i < settings.tray.size(); ++i) {
      const Instrument* found = find_instrument(*instruments, settings.tray[i]);
      tray.push_back(std::make_shared<const Tool>(make_tool(*found, found->usual_size)));
    }
    SoftSetup setup = *softs;
    auto cutters = make_solid_cutters(settings.tray);
    EXPECT_TRUE(cutters) << cutters.error().message();
    if (cutters) add_cutters(setup, std::move(*cutters), 6);
    settings.soft_hash = setup.hash;
    softs = std::make_shared<const SoftSetup>(std::move(setup));
  }
};

const CutRun& cut_run() {
  static const CutRun run;
  return run;
}

// The first lies along x. The punch comes from +x, its jaw above.
const Quat kLying = posed({0, 0, -1}, {1, 0, 0}), kFromEnd = posed({0, 0, 1}, {1, 0, 0});
// The blade stands upright and is drawn along y.
const Quat kUpright = posed({-1, 0, 0}, {0, 0, 1});

struct Hand : DrivenHand {
  explicit Hand(Session& s) : DrivenHand(s, {0.022, 0, 0.012}) {}

  void take(std::uint32_t instrument, const Quat& pose, const Vec3& from) {
    at = from;
    q = pose;
    DrivenHand::take(instrument);
  }
  // The upright blade from above the block straight down, so deep into it.
  void set_blade(double x, double y, double deep_m, int ticks) {
    take(kBlade, kUpright, {x, y, kMeniscusHalf.z() + 0.002});
    move({x, y, kMeniscusHalf.z() - deep_m}, ticks);
  }
};

double removed_mm3(const Session& session) { return 1e9 * session.softs()->removed_m3(0); }

void bite(Hand& hand) {
  hand.take(kBasket, kFromEnd, {0.022, 0, -0.0033});
  hand.tick({CommandKind::kJaw, 1});
  hand.move({0.007, 0, -0.0033}, 200);
  hand.tick({CommandKind::kJaw, 0});
  hand.rest(10);
}

// What is left, as it is drawn.
TriMesh drawn(const CutRun& run, const Session& session) {
  SoftShapes shapes(*run.the_case, run.softs);
  SoftPushes pushes = session.softs()->pushes();
  pushes.count = 0;
  auto changed = shapes.changes(pushes);
  return changed.empty() ? run.the_case->softs[0].mesh_W : std::move(changed[0].mesh_W);
}

TEST(SoftCut, APunchTakesWhatIsBetweenItsJaws) {
  Session session = cut_run().session();
  Hand hand(session);
  bite(hand);
  // As wide as the narrower jaw, 5 mm from the end, through the whole height.
  const double closed_mm3 = 2 * 0.38 * 3.4 * 5 * 6;
  EXPECT_NEAR(removed_mm3(session), closed_mm3, 0.01 * closed_mm3);
  ASSERT_EQ(hand.count(kSoftCut), 1u);
  const auto told = std::find_if(hand.events.begin(), hand.events.end(),
                                 [](const Event& event) { return event.kind == kSoftCut; });
  EXPECT_EQ(told->subject, 0u);
  EXPECT_NEAR(told->values[2], closed_mm3, 0.05 * closed_mm3);
  hand.move({0.022, 0, -0.0033}, 100);
  const TriMesh mesh = drawn(cut_run(), session);
  EXPECT_TRUE(topology(mesh).closed());
  EXPECT_NEAR(1e9 * volume(mesh), 24 * 16 * 6 - closed_mm3, 0.01 * closed_mm3 + 2);
  // A ball goes through the gap, and is not felt there.
  hand.take(kBall, Quat::Identity(), {0.010, 0, 0.008});
  hand.move({0.010, 0, -0.001}, 300);
  EXPECT_EQ(session.tool_state().force_W, Vec3(0, 0, 0));
}

// For those who judge: what is gone of it, and who presses what.
TEST(SoftCut, TheSnapshotTellsWhatIsGoneAndWhoPresses) {
  Session session = cut_run().session();
  Hand hand(session);
  hand.tick({CommandKind::kMark, 1});
  hand.rest(10);
  EXPECT_EQ(session.bones().softs.loss_count, 0u);
  EXPECT_EQ(session.bones().softs.touches[0].force_n, 0);
  bite(hand);
  hand.rest(60);
  ASSERT_EQ(session.bones().softs.loss_count, 1u);
  const SoftLoss loss = session.bones().softs.losses[0];
  EXPECT_EQ(loss.soft, 0u);
  EXPECT_EQ(loss.mm3, removed_mm3(session));
  EXPECT_EQ(loss.percent, 0);
  Session other = cut_run().session();
  (void)go_on_as(other, session);
  Hand second(other);
  second.at = hand.at;
  second.q = hand.q;
  second.rest(4);
  EXPECT_EQ(other.bones().softs.losses[0].mm3, loss.mm3);
  hand.take(kBall, Quat::Identity(), {-0.004, 0, 0.008});
  hand.move({-0.004, 0, 0.003}, 200);
  hand.rest(50);
  const SoftTouch touch = session.bones().softs.touches[0];
  EXPECT_EQ(touch.soft, 0u);
  EXPECT_NEAR(touch.force_n, session.tool_state().force_W.norm(), 0.02 * touch.force_n);
  EXPECT_GT(touch.force_n, 0.2);
  EXPECT_EQ(session.bones().softs.touches[1].force_n, 0);
  hand.tick({CommandKind::kRestore, 1});
  hand.rest(4);
  EXPECT_EQ(session.bones().softs.loss_count, 0u);
}

TEST(SoftCut, AJawThatStaysShutOrOpenTakesNothing) {
  Session session = cut_run().session();
  Hand hand(session);
  for (const double jaw : {1.0, 0.0}) {
    const double z = jaw > 0 ? -0.0033 : -0.006;
    hand.take(kBasket, kFromEnd, {0.022, 0, z});
    hand.tick({CommandKind::kJaw, jaw});
    hand.move({0.010, 0, z}, 100);
    hand.move({0.022, 0, z}, 100);
  }
  EXPECT_EQ(removed_mm3(session), 0);
}

// Pressed by 5 mm the edge goes in until the push is a third of the table's force, and a stroke
// opens a slit as wide as the blade.
TEST(SoftCut, ABladeGoesInAtItsForceAndSlitsAlongItsStroke) {
  Session session = cut_run().session();
  Hand hand(session);
  const double top = kMeniscusHalf.z();
  hand.set_blade(0, -0.003, 0.005, 400);
  EXPECT_LT(std::abs(session.tool_state().force_W.z()), 3);
  EXPECT_GT(std::abs(session.tool_state().force_W.z()), 1);
  hand.move({0, 0.003, top - 0.005}, 400);
  const double slit = removed_mm3(session);
  EXPECT_GT(slit, 0.45 * 6 * 1);
  EXPECT_LT(slit, 0.6 * 9 * 6);
  EXPECT_GE(hand.count(kSoftCut), 1u);
  EXPECT_TRUE(topology(drawn(cut_run(), session)).closed());
}

// Pressed with half of the force that pushes it straight in, an edge cuts nothing until it is drawn
// along itself; then it goes in as deep as that push reaches.
TEST(SoftCut, ADrawnEdgeNeedsLessForce) {
  Session session = cut_run().session();
  Hand hand(session);
  const double top = kMeniscusHalf.z();
  hand.set_blade(0, -0.003, 0.002, 400);
  hand.rest(200);
  const double pushed = std::abs(session.tool_state().force_W.z());
  EXPECT_GT(pushed, 0.6);
  EXPECT_LT(pushed, 1.6);
  EXPECT_EQ(removed_mm3(session), 0);
  hand.move({0, 0.003, top - 0.002}, 600);
  EXPECT_GT(removed_mm3(session), 0.45 * 6 * 0.5);
  EXPECT_LT(std::abs(session.tool_state().force_W.z()), 0.8 * pushed);
}

// The stiffness follows: beside a bite the block gives way more than it did.
TEST(SoftCut, ItIsSofterBesideACut) {
  const auto felt = [](bool cut) {
    Session session = cut_run().session();
    Hand hand(session);
    if (cut) bite(hand);
    if (cut) hand.move({0.022, 0, -0.0033}, 100);
    const double z = testing::kBlockTop_m;
    hand.take(kBall, Quat::Identity(), {0.009, 0.003, z + 0.004});
    hand.move({0.009, 0.003, z - 0.001}, 1500);
    return session.tool_state().force_W.z();
  };
  const double whole = felt(false), beside = felt(true);
  EXPECT_NEAR(whole, 0.9, 0.15);
  EXPECT_LT(beside, 0.93 * whole);
  EXPECT_GT(beside, 0.1 * whole);
}

TEST(SoftCut, WhatIsCutOffIsGoneAndTold) {
  Session session = cut_run().session();
  Hand hand(session);
  const double top = kMeniscusHalf.z();
  // Down beside the end, then across the whole block.
  hand.set_blade(0.009, -0.012, 0.009, 300);
  hand.move({0.009, 0.012, top - 0.009}, 2000);
  hand.rest(100);
  const double lost = removed_mm3(session);
  if (hand.count(kSoftPiece) == 0) GTEST_FAIL() << "no piece; removed " << lost;
  // The end and half of the slit; the blade sways in what gives way, and its slit stays narrow.
  EXPECT_GT(lost, (12 - 9) * 16 * 6);
  EXPECT_LT(lost, (12 - 9 + 0.4) * 16 * 6);
  EXPECT_EQ(session.softs()->pieces(0), 1u);
}

// Pictures follow a stroke block by block: what they show is what a new picture shows, bit by bit,
// during the stroke, after undo and after another.
TEST(SoftCut, WhatIsDrawnDoesNotDependOnWhatWasDrawnBefore) {
  const CutRun& run = cut_run();
  Session session = run.session();
  Hand hand(session);
  SoftShapes shapes(*run.the_case, run.softs);
  TriMesh shown;
  std::size_t compared = 0;
  const auto compare = [&] {
    const SoftPushes pushes = session.softs()->pushes();
    if (auto changed = shapes.changes(pushes); !changed.empty())
      shown = std::move(changed[0].mesh_W);
    SoftShapes anew(*run.the_case, run.softs);
    const auto first = anew.changes(pushes);
    if (first.empty()) return;
    EXPECT_EQ(first[0].mesh_W.triangles, shown.triangles);
    EXPECT_TRUE(topology(shown).closed());
    ASSERT_EQ(first[0].mesh_W.vertices.size(), shown.vertices.size());
    // A push is drawn again once it has changed by more than can be seen.
    for (std::size_t v = 0; v < shown.vertices.size(); ++v)
      ASSERT_LT((first[0].mesh_W.vertices[v] - shown.vertices[v]).norm(), 2e-5);
    ++compared;
  };
  const auto stroke = [&](double x) {
    const double top = kMeniscusHalf.z();
    hand.set_blade(x, -0.009, 0.004, 200);
    for (int k = -8; k <= 8; ++k) {
      hand.move({x, 0.001 * k, top - 0.004}, 60);
      compare();
    }
    hand.move({x, 0.008, top + 0.006}, 100);
    hand.rest(100);
    compare();
  };
  hand.tick({CommandKind::kMark, 0});
  stroke(0);
  hand.tick({CommandKind::kRestore, 0});
  hand.rest(100);
  EXPECT_EQ(session.softs()->pushes().cuts[0], nullptr);
  (void)shapes.changes(session.softs()->pushes());
  stroke(0.005);
  EXPECT_GT(compared, 20u);
}

TEST(SoftCut, UndoPutsItBackAndAStateGoesOnTheSame) {
  const CutRun& run = cut_run();
  Session session = run.session();
  Hand hand(session);
  hand.rest(10);
  hand.tick({CommandKind::kMark, 0});
  hand.rest(10);
  bite(hand);
  Session other = run.session();
  (void)go_on_as(other, session);
  Hand second(other);
  second.at = hand.at;
  second.q = hand.q;
  for (Hand* h : {&hand, &second}) h->move({0.012, 0.001, -0.002}, 900);
  EXPECT_EQ(other.state_hash(), session.state_hash());
  EXPECT_GT(removed_mm3(other), 10);
  hand.tick({CommandKind::kRestore, 0});
  hand.rest(10);
  EXPECT_EQ(removed_mm3(session), 0);
  EXPECT_EQ(session.softs()->pushes().cuts[0], nullptr);
}

// Wild hands with every instrument: the force is finite, what is drawn is closed, nothing is lost
// but what was removed, and a replay is the same from the start and from the middle.
TEST(SoftCut, RandomCutsKeepItSoundAndReplayTheSame) {
  const CutRun& run = cut_run();
  Session session = run.session();
  Recording recording = begin_recording(run);
  Hand hand(session);
  hand.into = &recording;
  Random random(11);
  const Quat poses[] = {kLying, kFromEnd, kUpright, Quat::Identity()};
  const auto place = [&] {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1), z = random.uniform(-1, 1);
    return Vec3(0.016 * x, 0.012 * y, 0.010 * z);
  };
  double last = 0;
  for (int bout = 0; bout < 16; ++bout) {
    hand.take(static_cast<std::uint32_t>(random.next() % 4), poses[random.next() % 4], hand.at);
    hand.tick({CommandKind::kPower, 1});
    hand.tick({CommandKind::kJaw, 1});
    hand.move(place(), 60);
    hand.tick({CommandKind::kJaw, 0});
    hand.move(place(), 60);
    ASSERT_TRUE(is_finite(session.tool_state().force_W));
    ASSERT_LE(session.tool_state().force_W.norm(), run.settings.haptic.max_force_n + 1e-9);
    if (bout % 5 == 4) {
      hand.rest(60);
      const double removed = removed_mm3(session);
      ASSERT_GE(removed, last - 1e-6);
      last = removed;
      const TriMesh mesh = drawn(run, session);
      ASSERT_TRUE(topology(mesh).closed()) << bout;
      ASSERT_NEAR(1e9 * volume(mesh) + removed, 24 * 16 * 6, 0.02 * removed + 3) << bout;
    }
    if (bout != 8) continue;
    keep_state(recording, session);
  }
  EXPECT_GT(last, 10);
  expect_same_replays(recording, run, session, {0.0, 0.9});
}

}  // namespace
}  // namespace osteon
