// Holes in a patch of skin that hold shafts as portals do: made by a trocar or through a cut.
#include <algorithm>
#include <numbers>

#include "count_allocations.h"
#include "osteon/base/turn.h"
#include "osteon/physics/skin_state.h"
#include "osteon/physics/soft_world.h"
#include "osteon/scene/soft_events.h"
#include "recorded_run.h"
#include "skin_fixtures.h"

namespace osteon {
namespace {

using testing::expect_same_replays;
using testing::go_on_as;
using testing::kSkinBlade;
using testing::kSkinScope;
using testing::kSkinTrocar;
using testing::kTrocar_m;
using testing::skin_run;
using testing::SkinHandAt;
using testing::SkinRun;

// The blade goes 8 mm deep at one place and is drawn to another, as deep.
void slit(SkinHandAt& hand, const Vec3& from, const Vec3& to, double deep_m = 0.008) {
  hand.take(kSkinBlade, {from.x(), from.y(), 0.010});
  hand.move({from.x(), from.y(), -deep_m}, 300);
  hand.move({to.x(), to.y(), -deep_m}, 400);
  hand.move({to.x(), to.y(), 0.010}, 200);
}

void pierce(SkinHandAt& hand, double x, double y) {
  hand.take(kSkinTrocar, {x, y, 0.010});
  hand.move({x, y, -0.030}, 1000);
  hand.rest(100);
}

// How far the shaft's axis passes from the place where the skin holds it.
double off_m(const ToolState& tool) {
  const Vec3 along = tool.X_WP.rotate(Vec3::UnitZ());
  const Vec3 to = tool.p_portal_W - tool.X_WP.p;
  return (to - to.dot(along) * along).norm();
}

std::uint32_t portals_in(const Session& session) {
  return session.softs()->skin_readout(0).portals;
}

TEST(MadePortal, AScratchMakesNone) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  slit(hand, {-0.006, 0, 0}, {0.006, 0, 0}, 0.005);
  ASSERT_GT(hand.count(kSkinCut), 0u);
  hand.take(kSkinScope, {0, 0, 0.010});
  hand.move({0, 0, -0.010}, 600);
  EXPECT_EQ(session.softs()->skin_readout(0).cut_m, 0);
  EXPECT_EQ(hand.count(kPortalMade) + hand.count(kSkinEntered), 0u);
  EXPECT_EQ(portals_in(session), 0u);
  EXPECT_EQ(session.tool_state().portal, kNoPortal);
}

// Of 6.9 mm that go around a shaft of 5.5 mm.
TEST(MadePortal, ASlitThatIsTooShortForTheShaftMakesNone) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  slit(hand, {-0.002, 0, 0}, {0.002, 0, 0});
  ASSERT_GT(session.softs()->skin_readout(0).cut_m, 0.002);
  hand.take(kSkinScope, {0, 0, 0.010});
  hand.move({0, 0, -0.015}, 800);
  EXPECT_EQ(hand.count(kPortalMade) + hand.count(kSkinEntered), 0u);
  EXPECT_EQ(session.tool_state().portal, kNoPortal);
  EXPECT_GT(session.tool_state().force_W.z(), 5);
}

TEST(MadePortal, WholeSkinAndABallThatPressesItMakeNone) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.take(testing::kSkinBall, {0, 0, 0.010});
  hand.move({0, 0, -0.010}, 600);
  hand.take(kSkinScope, {0, 0, 0.010});
  hand.move({0, 0, -0.010}, 600);
  EXPECT_EQ(portals_in(session), 0u);
  EXPECT_EQ(hand.count(EventKind::kPortalEntered), 0u);
}

TEST(MadePortal, WhereATrocarHasPiercedTheShaftPivots) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  pierce(hand, 0.003, 0.004);
  ASSERT_EQ(hand.count(kPortalMade), 1u);
  const Event& made = *hand.first(kPortalMade);
  EXPECT_EQ(made.subject_kind, SubjectKind::kPortal);
  ASSERT_LT(made.subject, session.portals().size());
  EXPECT_EQ(session.portals()[made.subject].name, "portal_al_made_1");
  EXPECT_EQ(session.portals()[made.subject].title, "AL made 1");
  EXPECT_EQ(session.portals()[made.subject].landmark, 0u);
  EXPECT_NEAR(made.values[0], 5, 0.1);
  EXPECT_EQ(made.values[1], 1);
  EXPECT_NEAR(made.values[2], 2e3 * kTrocar_m, 1e-9);
  EXPECT_LT((made.p_W - Vec3(0.003, 0.004, 0)).norm(), 1e-4);
  ASSERT_EQ(hand.count(EventKind::kPortalEntered), 1u);
  EXPECT_EQ(hand.first(EventKind::kPortalEntered)->subject, made.subject);
  EXPECT_EQ(session.tool_state().portal, made.subject);
  EXPECT_LT((session.tool_state().p_portal_W - made.p_W).norm(), 1e-4);
  // The tip goes aside, the hole does not: it cannot leave sideways.
  for (const Vec3& to : {Vec3(0.030, 0.004, -0.025), Vec3(0.003, -0.035, -0.030)}) {
    hand.move(to, 600);
    hand.rest(300);
    EXPECT_EQ(session.tool_state().portal, made.subject);
    EXPECT_LT(off_m(session.tool_state()), 0.0009);
    const Vec3 along = session.tool_state().X_WP.rotate(Vec3::UnitZ());
    EXPECT_LT(along.z(), 0.9);
    EXPECT_GT(session.tool_state().force_W.norm(), 0.2);
    EXPECT_EQ(session.softs()->skin_readout(0).force_n[0], 0);
  }
}

TEST(MadePortal, ItLetsTheShaftOutAndAnyThatFitsInAgain) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  pierce(hand, 0, 0);
  hand.move({0, 0, 0.010}, 800);
  hand.rest(100);
  EXPECT_EQ(session.tool_state().portal, kNoPortal);
  EXPECT_EQ(hand.count(EventKind::kPortalLeft), 1u);
  EXPECT_EQ(hand.count(kSkinLeft), 1u);
  EXPECT_NEAR(hand.first(kSkinLeft)->values[1], 30, 0.5);
  EXPECT_EQ(session.tool_state().force_W, Vec3(0, 0, 0));
  for (const std::uint32_t instrument : {kSkinTrocar, kSkinScope}) {
    hand.take(instrument, {0.001, 0, 0.010});
    hand.force_z.clear();
    hand.move({0.001, 0, -0.030}, 1000);
    hand.rest(100);
    EXPECT_NE(session.tool_state().portal, kNoPortal) << instrument;
    EXPECT_LT(*std::max_element(hand.force_z.begin(), hand.force_z.end()), 4) << instrument;
    hand.move({0.001, 0, 0.010}, 800);
    hand.rest(100);
    EXPECT_EQ(session.tool_state().portal, kNoPortal) << instrument;
  }
  EXPECT_EQ(hand.count(kPortalMade), 1u);
  EXPECT_EQ(hand.count(kSkinPierced), 1u);
  EXPECT_EQ(hand.count(EventKind::kPortalEntered), 3u);
}

// 3 mm out and in again, before the skin has let it go.
TEST(MadePortal, AShaftThatIsAlmostOutIsInAgainWhenItGoesBack) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  pierce(hand, 0, 0);
  for (int n = 0; n < 3; ++n) {
    hand.move({0, 0, -0.0005}, 500);
    hand.rest(150);
    hand.move({0, 0, -0.020}, 500);
    EXPECT_NE(session.tool_state().portal, kNoPortal) << n;
    EXPECT_LT(std::abs(session.tool_state().force_W.z()), 2) << n;
  }
}

TEST(MadePortal, ThroughACutItIsWhereTheShaftWentInAndGoesAlongTheSlit) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  slit(hand, {-0.006, 0, 0}, {0.006, 0, 0});
  EXPECT_EQ(hand.count(kPortalMade), 0u);  // no shaft has been in it
  hand.take(kSkinScope, {-0.002, 0, 0.010});
  hand.move({-0.002, 0, -0.020}, 800);
  ASSERT_EQ(hand.count(kPortalMade), 1u);
  EXPECT_NEAR(hand.first(kPortalMade)->values[0], 2, 0.1);
  EXPECT_EQ(hand.first(kPortalMade)->values[1], 0);
  EXPECT_NEAR(session.tool_state().p_portal_W.x(), -0.002, 1e-4);
  hand.move({-0.002, 0, 0.010}, 800);
  hand.rest(100);
  hand.move({0.0025, 0, 0.010}, 100);
  hand.move({0.0025, 0, -0.020}, 800);
  EXPECT_NE(session.tool_state().portal, kNoPortal);
  EXPECT_NEAR(session.tool_state().p_portal_W.x(), 0.0025, 1e-4);
  EXPECT_EQ(portals_in(session), 1u);
}

TEST(MadePortal, AFourthHoleIsHeldByThePatchAlone) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  for (const double x : {-0.008, 0.0, 0.008}) {
    pierce(hand, x, 0.008);
    hand.move({x, 0.008, 0.010}, 500);
    hand.rest(100);
  }
  EXPECT_EQ(hand.count(kPortalMade), 3u);
  pierce(hand, 0, -0.008);
  EXPECT_EQ(hand.count(kPortalMade), 3u);
  EXPECT_EQ(hand.count(kSkinPierced), 4u);
  EXPECT_EQ(session.tool_state().portal, kNoPortal);
  EXPECT_GT(session.softs()->skin_readout(0).force_n[0], 1);
}

// The same hand in the case's own portal and in one that was made at its place.
TEST(MadePortal, ItIsFeltAsAPortalOfTheCaseAndNothingTwice) {
  const SkinRun with(0, true);
  Session made = skin_run().session(), fixed = with.session();
  SkinHandAt a(made), b(fixed);
  pierce(a, 0, 0);
  pierce(b, 0, 0);
  ASSERT_EQ(a.count(kSkinPierced), 1u);
  ASSERT_EQ(b.count(kSkinPierced), 0u);
  for (const Vec3& to : {Vec3(0.003, 0, -0.030), Vec3(0.012, -0.010, -0.028)}) {
    for (SkinHandAt* hand : {&a, &b}) {
      hand->move(to, 300);
      hand->rest(200);
    }
    const Vec3 f = made.tool_state().force_W, g = fixed.tool_state().force_W;
    EXPECT_GT(g.head<2>().norm(), 0.1);
    EXPECT_LT((f - g).norm(), 0.02 * g.norm() + 0.02) << f.transpose() << " " << g.transpose();
  }
}

TEST(MadePortal, TheForceHasNoStepWhileTheHoleIsMade) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.take(kSkinTrocar, {0, 0, 0.010});
  hand.force_z.clear();
  hand.move({0.002, 0, -0.030}, 1500);
  hand.move({0.002, 0, 0.010}, 1500);
  const double peak = *std::max_element(hand.force_z.begin(), hand.force_z.end());
  EXPECT_GT(peak, 25);
  for (std::size_t n = 1; n < hand.force_z.size(); ++n)
    ASSERT_LT(std::abs(hand.force_z[n] - hand.force_z[n - 1]), 0.15 * peak) << n;
}

TEST(MadePortal, ARestorePointShutsItAndOneSetLaterKeepsIt) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.tick();
  hand.tick({CommandKind::kMark, 0});
  pierce(hand, 0, 0);
  hand.tick({CommandKind::kMark, 1});
  hand.move({0.004, 0, -0.025}, 200);
  hand.tick({CommandKind::kRestore, 1});
  hand.rest(100);
  EXPECT_NE(session.tool_state().portal, kNoPortal);
  EXPECT_LT(off_m(session.tool_state()), 0.0009);
  hand.tick({CommandKind::kRestore, 0});
  hand.rest(100);
  EXPECT_EQ(session.tool_state().portal, kNoPortal);
  EXPECT_EQ(portals_in(session), 0u);
  EXPECT_EQ(session.tool_state().force_W, Vec3(0, 0, 0));
  hand.take(kSkinScope, {0, 0, 0.010});
  hand.move({0, 0, -0.010}, 500);
  EXPECT_EQ(session.tool_state().portal, kNoPortal);
  EXPECT_GT(session.tool_state().force_W.z(), 2);
}

TEST(MadePortal, AStateWhileTheHoleClosesAboutTheShaftGoesOnTheSame) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.take(kSkinTrocar, {0, 0, 0.010});
  for (int n = 0; n < 1000 && hand.count(kPortalMade) == 0; ++n)
    hand.move({0, 0, hand.at.z() - 0.00005}, 1);
  hand.rest(21);
  ASSERT_NE(session.tool_state().portal, kNoPortal);
  Session other = skin_run().session();
  const SessionState back = go_on_as(other, session);
  SkinHandAt again(other);
  again.at = hand.at;
  for (SkinHandAt* one : {&hand, &again}) {
    one->force_z.clear();
    one->move({0.008, 0.002, -0.028}, 300);
    one->move({0, 0, 0.010}, 300);
  }
  EXPECT_EQ(other.state_hash(), session.state_hash());
  EXPECT_EQ(again.force_z, hand.force_z);
  for (const int wrong : {0, 1, 2}) {
    SessionState odd = back;
    SkinState skin = *odd.world.softs.skin;
    ASSERT_EQ(skin.patches[0].made_count, 1u);
    if (wrong == 0) skin.patches[0].made_count = 9;
    if (wrong == 1) skin.patches[0].made[0].at.x() = std::nan("");
    if (wrong == 2) skin.hands[0][0].contact.made = 2;
    odd.world.softs.skin = std::make_shared<const SkinState>(skin);
    EXPECT_FALSE(other.restore(odd)) << wrong;
  }
}

TEST(MadePortal, InItTheHandsTickAllocatesNothing) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.events.reserve(1000);
  hand.force_z.reserve(10000);
  pierce(hand, 0, 0);
  hand.rest(400);  // what was cut is solved by then
  const std::uint64_t before = testing::allocations();
  hand.move({0.010, 0.003, -0.025}, 300);
  EXPECT_EQ(testing::allocations(), before);
  EXPECT_GT(session.tool_state().force_W.norm(), 0.2);
}

TEST(MadePortal, UnderAPatchThePortalOfTheCaseIsShutUnlessItIsNamed) {
  const SkinRun& run = skin_run();
  SessionSettings settings = run.settings;
  settings.portals = {"all"};
  const auto all = open_portals(*run.the_case, settings);
  ASSERT_TRUE(all);
  ASSERT_EQ(all->size(), kMadePerPatch);
  for (const Portal& portal : *all) EXPECT_FALSE(portal.open);
  settings.portals = {"AL"};
  EXPECT_EQ(open_portals(*run.the_case, settings)->size(), 1 + kMadePerPatch);
  settings.soft = {};
  settings.portals = {"all"};
  ASSERT_EQ(open_portals(*run.the_case, settings)->size(), 1u);
}

// Two hands: one makes the portal with a trocar and leaves it, the other goes in with a scope; then
// both are in a long slit at a time, and the world goes back.
struct TwoHands {
  SkinRun run;
  std::array<Vec3, 2> at{Vec3(0.003, 0, 0.020), Vec3(-0.030, 0, 0.020)};
  Recording recording;
  std::unique_ptr<Session> session;
  std::vector<Event> events;

  TwoHands() {
    run.settings.hands = {{"left", kSkinTrocar}, {"right", kSkinScope}};
    session = std::make_unique<Session>(run.session());
    recording.header = recording_header(*run.the_case, run.settings, "test", "0", run.tray);
    recording.more_hands.resize(1);
  }
  void tick(const Command& left = {}, const Command& right = {}) {
    std::array<HandInput, 2> hands;
    for (std::size_t h = 0; h < 2; ++h) hands[h].input.X_WD.p = at[h];
    hands[0].command = left;
    hands[1].command = right;
    (void)session->tick(hands);
    for (std::size_t h = 0; h < 2; ++h) {
      recording.ticks_of(h).push_back(session->last_tick_record(h));
      for (const Event& event : session->last_events(h)) events.push_back(event);
    }
    if (session->last_steps() > 0) recording.steps.push_back(session->last_step_record());
    const std::uint64_t n = session->tool_state().tick;
    if (n % 250 == 0)
      recording.states.push_back({{n, n, 0, 0}, session->bones().step, to_bytes(session->save())});
  }
  void move(std::size_t hand, const Vec3& to, int ticks) {
    const Vec3 from = at[hand];
    for (int n = 1; n <= ticks; ++n) {
      at[hand] = from + n / static_cast<double>(ticks) * (to - from);
      tick();
    }
  }
};

TEST(MadePortal, AnotherHandGoesInThereAndAReplayIsTheSameFromTheStartAndFromTheMiddle) {
  TwoHands two;
  two.tick();
  two.tick({CommandKind::kMark, 0}, {CommandKind::kMark, 0});
  two.move(0, {0.003, 0, -0.030}, 700);
  ASSERT_NE(two.session->tool_state(0).portal, kNoPortal);
  two.move(0, {0.003, 0, 0.020}, 400);
  two.move(0, {0.040, 0, 0.020}, 100);
  two.move(1, {0.003, 0, 0.020}, 200);
  two.move(1, {0.003, 0, -0.030}, 600);
  EXPECT_EQ(two.session->tool_state(0).portal, kNoPortal);
  EXPECT_EQ(two.session->tool_state(1).portal, 0u);
  two.move(1, {0.015, 0.004, -0.028}, 200);
  EXPECT_LT(off_m(two.session->tool_state(1)), 0.0009);
  // The other hand makes one of its own beside it meanwhile.
  two.move(0, {-0.009, -0.008, 0.020}, 200);
  two.move(0, {-0.009, -0.008, -0.025}, 700);
  EXPECT_EQ(two.session->tool_state(0).portal, 1u);
  EXPECT_EQ(two.session->tool_state(1).portal, 0u);
  two.tick({CommandKind::kRestore, 0}, {CommandKind::kRestore, 0});
  two.move(0, {-0.009, -0.008, 0.020}, 300);
  EXPECT_EQ(two.session->tool_state(0).portal, kNoPortal);
  EXPECT_EQ(two.session->tool_state(1).portal, kNoPortal);
  std::size_t made = 0;
  for (const Event& event : two.events) made += event.kind == kPortalMade ? 1 : 0;
  EXPECT_EQ(made, 2u);
  expect_same_replays(two.recording, two.run, *two.session, {0.0, 0.55, 1.1, 2.0, 2.8});
}

}  // namespace
}  // namespace osteon
