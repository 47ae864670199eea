// Skin in a session: pressed, cut and pierced, against the balance of a sheet solved at once.
#include <algorithm>
#include <numbers>

#include "count_allocations.h"
#include "osteon/base/random.h"
#include "osteon/base/turn.h"
#include "osteon/physics/skin_state.h"
#include "osteon/physics/soft_world.h"
#include "osteon/scene/soft_events.h"
#include "osteon/tissue/sheet_balance.h"
#include "recorded_run.h"
#include "skin_fixtures.h"

namespace osteon {
namespace {

using testing::begin_recording;
using testing::expect_same_replays;
using testing::go_on_as;
using testing::kBallTip_m;
using testing::kSkinBall;
using testing::kSkinBlade;
using testing::kSkinScope;
using testing::kSkinTrocar;
using testing::kTrocar_m;
using testing::skin_run;
using testing::SkinHandAt;
using testing::SkinRun;

double edge_m() { return skin_run().patch().sheet->edge_m(); }

// What the sheet is pressed with by a ball so deep, by the balance that is solved at once.
double solved_n(const SheetCuts& cuts, const SheetPoint& p, double radius_m, double deep_m) {
  const SkinSheet& sheet = *skin_run().patch().sheet;
  const SheetBalance balance(sheet, split(sheet, cuts));
  return balance.pressed_by(load_on(balance.split(), {p, radius_m}), deep_m).force_n;
}

SheetCuts cuts_of(const Session& session) {
  const SkinSheet& sheet = *skin_run().patch().sheet;
  return kept_cuts(sheet, session.save().world.softs.skin->patches[0].cuts);
}

// The blade goes 8 mm deep at one place and is drawn to another.
void cut_along(SkinHandAt& hand, const Vec3& from, const Vec3& to, double deep_m = 0.008) {
  hand.take(kSkinBlade, {from.x(), from.y(), 0.010});
  hand.move({from.x(), from.y(), -deep_m}, 300);
  hand.move({to.x(), to.y(), -deep_m}, 400);
  hand.move({to.x(), to.y(), 0.010}, 200);
}

TEST(Skin, AskedForWhereThereIsNoneItSaysWhatThereIs) {
  const auto the_case = testing::skin_case();
  const auto ask = [&](const Case& of, const std::string& name) {
    return make_skin_patches(of, std::vector<std::string>{name}, {Vec3::UnitY()}, {});
  };
  const auto wrong = ask(*the_case, "skin:nowhere");
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().message().find("skin:portal_al"), std::string::npos);
  EXPECT_FALSE(ask(*testing::two_box_case(), "skin"));
  const std::vector<std::string> both{"skin:portal_al", "skin:beside"};
  const auto over = make_skin_patches(*the_case, both, {Vec3::UnitY()}, {});
  ASSERT_FALSE(over);
  EXPECT_NE(over.error().message().find("overlap"), std::string::npos);
  EXPECT_FALSE(make_skin_patches(*the_case, std::vector<std::string>{"skin"}, {Vec3::UnitZ()}, {}));
  EXPECT_FALSE(
      make_skin_patches(*the_case, std::vector<std::string>{"skin"}, {Vec3::UnitY()}, {0, 25}));
  EXPECT_TRUE(names_skin("skin:portal_al"));
  EXPECT_FALSE(names_skin("menisci"));
}

// On a small knee the portals are nearer to each other than a patch is wide: each gets as much as
// does not reach the other.
TEST(Skin, PatchesNearEachOtherAreSmaller) {
  const auto the_case = testing::skin_case();
  const auto made = [&](const std::vector<std::string>& names) {
    const auto patches = make_skin_patches(*the_case, names, {Vec3::UnitY()}, {});
    EXPECT_TRUE(patches) << (patches ? "" : patches.error().message());
    std::vector<double> widths;
    if (patches)
      for (const SkinPatch& patch : *patches) widths.push_back(patch.width_m);
    return widths;
  };
  EXPECT_EQ(made({"skin:portal_al"}), (std::vector<double>{0.030}));
  const auto both = made({"skin:portal_al", "skin:aside"});
  ASSERT_EQ(both.size(), 2u);
  EXPECT_NEAR(both[0], 0.018, 1e-12);
  EXPECT_NEAR(both[1], 0.018, 1e-12);
}

TEST(Skin, PalpatedItIsAsStiffAsTheTissueTableSays) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.take(kSkinBall, {0, 0, 0.010});
  const double one = hand.felt_at({0, 0, -0.0005}), two = hand.felt_at({0, 0, -0.0015});
  EXPECT_NEAR((two - one) / 0.001, 400, 0.15 * 400);
}

TEST(Skin, PressedAnywhereItIsTheSheetSolvedAtOnce) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.take(kSkinBall, {0, 0, 0.010});
  const SheetCuts whole = whole_sheet(*skin_run().patch().sheet);
  for (const SheetPoint& p :
       {SheetPoint(0, 0), SheetPoint(0.004, -0.006), SheetPoint(-0.006, 0.007)})
    for (const double deep : {0.002, 0.005, 0.007})
      EXPECT_NEAR(hand.felt_at({p.x(), p.y(), -deep}) / solved_n(whole, p, kBallTip_m, deep), 1,
                  0.05)
          << p.transpose() << " " << deep;
  // Between the border of the patch and skin that is not felt the force fades.
  EXPECT_LT(hand.felt_at({0.0145, 0, -0.002}), 0.2);
  EXPECT_EQ(hand.felt_at({0.0165, 0, -0.002}), 0);
  EXPECT_EQ(hand.count(kSkinCut) + hand.count(kSkinPierced), 0u);
  EXPECT_GT(hand.count(kSoftBegin), 5u);
}

TEST(Skin, ASlowPressHasNoSteps) {
  const SkinRun run(0.060);
  for (const double slide_m : {0.0, 0.008}) {
    Session session = run.session();
    SkinHandAt hand(session);
    hand.take(kSkinBall, {0, 0, 0.010});
    hand.force_z.clear();
    for (int n = 0; n < 2000; ++n) {
      const double t = 0.001 * n, w = 2 * std::numbers::pi;
      hand.at = {slide_m * std::sin(0.5 * w * t), 0.002, 0.002 - 0.005 * (1 - std::cos(w * t))};
      hand.tick();
    }
    const double peak = *std::max_element(hand.force_z.begin(), hand.force_z.end());
    EXPECT_GT(peak, 3);
    for (std::size_t n = 1; n < hand.force_z.size(); ++n)
      ASSERT_LT(std::abs(hand.force_z[n] - hand.force_z[n - 1]), 0.02 * peak) << n;
  }
}

TEST(Skin, ABladeThatIsPressedOpensASlitAlongItsStroke) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.take(kSkinBall, {0, 0, 0.010});
  const double before = hand.felt_at({0.001, 0.0015, -0.003});
  hand.most_n = 0;
  cut_along(hand, {-0.006, -0.002, 0}, {0.006, 0.002, 0});
  // The edge bears what cuts, and no more.
  EXPECT_NEAR(hand.most_n, skin_run().patch().edge_n, 1e-6);
  ASSERT_EQ(hand.count(kSkinCut), 1u);
  ASSERT_EQ(hand.count(kSkinCutEnd), 1u);
  const double way_mm = 1e3 * std::hypot(0.012, 0.004);
  EXPECT_NEAR(hand.first(kSkinCutEnd)->values[0], way_mm, 1e3 * edge_m());
  EXPECT_GT(hand.first(kSkinCutEnd)->values[1], 2);
  EXPECT_LT(hand.first(kSkinCutEnd)->values[1], 8);
  EXPECT_EQ(hand.first(kSkinCut)->subject, 0u);
  EXPECT_NEAR(hand.first(kSkinCut)->p_W.x(), -0.006, 0.0005);
  EXPECT_NEAR(1e3 * session.softs()->skin_readout(0).cut_m, way_mm, 1e3 * edge_m());
  // Every vertex of the slit lies on the stroke.
  const SheetCuts cuts = cuts_of(session);
  const SkinSheet& sheet = *skin_run().patch().sheet;
  const SheetPoint way = SheetPoint(0.012, 0.004).normalized();
  std::size_t open = 0;
  for (std::size_t e = 0; e < cuts.depth_m.size(); ++e) {
    if (!(cuts.depth_m[e] > 0)) continue;
    ++open;
    for (const std::uint32_t v : {sheet.edges()[e].a, sheet.edges()[e].b}) {
      const SheetPoint off = cuts.points[v] - SheetPoint(-0.006, -0.002);
      EXPECT_LT(std::abs(off.x() * way.y() - off.y() * way.x()), 0.0003);
    }
  }
  EXPECT_GT(open, 8u);
  // Beside it the skin is as soft as the cut sheet solved at once.
  hand.take(kSkinBall, {0, 0, 0.010});
  const double after = hand.felt_at({0.001, 0.0015, -0.003});
  EXPECT_LT(after, 0.9 * before);
  EXPECT_NEAR(after / solved_n(cuts, {0.001, 0.0015}, kBallTip_m, 0.003), 1, 0.06);
}

// What is open adds up over strokes; how far aside and how deep is the blade's own. Under negative
// x a tendon lies 4 mm deep, under the rest nothing near.
TEST(Skin, SkinThatIsThereForNoPortalTellsHowMuchOfItIsOpen) {
  const SkinRun run(0, false, 0.004, {"skin:beside"});
  Session session = run.session();
  SkinHandAt hand(session);
  const auto cut = [&](double x, double from, double to, double deep_m) {
    hand.take(kSkinBlade, {x, from, 0.010});
    hand.q = turn_between(Vec3::UnitX(), Vec3::UnitY());
    hand.move({x, from, -deep_m}, 200);
    hand.move({x, to, -deep_m}, 400);
    const SkinBlade blade = session.bones().softs.skin.blades[0];
    hand.move({x, to, 0.010}, 200);
    EXPECT_FALSE(session.bones().softs.skin.blades[0].in);
    return blade;
  };
  const SkinBlade shallow = cut(0.013, -0.010, 0.002, 0.008);
  const double first_m = session.bones().softs.skin.open_m;
  EXPECT_TRUE(shallow.in);
  EXPECT_NEAR(first_m, 0.012, 0.0013);
  EXPECT_NEAR(shallow.aside_m, 0.003, 0.0007);
  EXPECT_EQ(shallow.past_m, 0);
  const SkinBlade deep = cut(-0.005, -0.004, 0.004, 0.010);
  EXPECT_NEAR(session.bones().softs.skin.open_m, first_m + 0.008, 0.0013);
  EXPECT_NEAR(deep.aside_m, 0.015, 0.0007);
  EXPECT_GT(deep.past_m, 0.001);
  EXPECT_LT(deep.past_m, 0.006);
}

TEST(Skin, APortalsSkinTellsNoOpening) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  cut_along(hand, {-0.006, -0.002, 0}, {0.006, 0.002, 0});
  EXPECT_EQ(hand.count(kSkinCutEnd), 1u);
  EXPECT_EQ(session.bones().softs.skin.open_m, 0);
}

TEST(Skin, ATouchThatIsTooLightAndABladeThatLiesFlatCutNothing) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  cut_along(hand, {-0.006, 0, 0}, {0.006, 0, 0}, 0.002);
  EXPECT_EQ(hand.count(kSkinCut), 0u);
  EXPECT_GT(hand.count(kSoftBegin), 0u);
  hand.take(kSkinBlade, {0, 0, 0.020});
  hand.q = Quat(std::sqrt(0.5), std::sqrt(0.5), 0, 0);  // its flat side down
  hand.move({-0.004, 0, -0.006}, 300);
  hand.move({0.004, 0, -0.006}, 300);
  EXPECT_EQ(hand.count(kSkinCut), 0u);
  EXPECT_EQ(session.softs()->skin_readout(0).cut_m, 0);
}

// Rise, peak, drop; after that a portal holds it, and the second time nothing has to break.
TEST(Skin, ATrocarBreaksThroughAtItsPeak) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.take(kSkinTrocar, {0, 0, 0.010});
  hand.force_z.clear();
  hand.move({0, 0, -0.030}, 2000);
  const SheetMaterial& m = skin_run().patch().sheet->material();
  const double peak_n = m.pierce_pa * std::numbers::pi * kTrocar_m * kTrocar_m;
  const auto peak = std::max_element(hand.force_z.begin(), hand.force_z.end());
  EXPECT_NEAR(*peak, peak_n, 0.02 * peak_n);
  for (auto n = hand.force_z.begin() + 1; n < peak; ++n) ASSERT_GT(*n, n[-1] - 1e-9);
  const PortalSkin& rim = session.portals()[0].skin;
  EXPECT_NEAR(hand.force_z.back(), rim.dynamic_friction * rim.squeeze_n, 0.05);
  ASSERT_EQ(hand.count(kSkinPierced), 1u);
  EXPECT_NEAR(hand.first(kSkinPierced)->values[0], peak_n, 0.03 * peak_n);
  EXPECT_NEAR(hand.first(kSkinPierced)->values[2], 2e3 * 0.8 * kTrocar_m, 1e-9);
  // Sideways the hole holds the shaft.
  hand.move({0.002, 0, -0.030}, 200);
  EXPECT_LT(session.tool_state().force_W.x(), -0.3);
  hand.move({0, 0, -0.030}, 200);
  hand.force_z.clear();
  hand.move({0, 0, 0.010}, 2000);
  EXPECT_NEAR(*std::min_element(hand.force_z.begin(), hand.force_z.end()),
              -rim.static_friction * rim.squeeze_n, 0.1);
  ASSERT_EQ(hand.count(kSkinLeft), 1u);
  EXPECT_NEAR(hand.first(kSkinLeft)->values[1], 30, 0.5);
  EXPECT_EQ(session.tool_state().force_W, Vec3(0, 0, 0));
  EXPECT_EQ(session.softs()->skin_readout(0).holes, 1u);
  hand.force_z.clear();
  hand.move({0, 0, -0.030}, 2000);
  EXPECT_LT(*std::max_element(hand.force_z.begin(), hand.force_z.end()), 0.15 * peak_n);
}

TEST(Skin, AScopeGoesInThroughACutAndNotThroughWholeSkin) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.take(kSkinScope, {0, 0, 0.010});
  hand.move({0, 0, -0.020}, 1000);
  EXPECT_EQ(hand.count(kSkinPierced) + hand.count(kSkinEntered), 0u);
  EXPECT_GT(session.tool_state().force_W.z(), 10);
  cut_along(hand, {-0.006, 0, 0}, {0.006, 0, 0});
  hand.take(kSkinScope, {0, 0, 0.010});
  hand.force_z.clear();
  hand.move({0, 0, -0.020}, 1000);
  ASSERT_EQ(hand.count(kSkinEntered), 1u);
  EXPECT_NEAR(hand.first(kSkinEntered)->values[0], 12, 1e3 * edge_m());
  EXPECT_LT(*std::max_element(hand.force_z.begin(), hand.force_z.end()), 4);
}

TEST(Skin, AToolInAPortalDoesNotPressTheSkinAboutIt) {
  const SkinRun run(0, true);
  Session session = run.session();
  SkinHandAt hand(session);
  ASSERT_EQ(session.portals().size(), 1 + kMadePerPatch);
  hand.take(kSkinScope, {0, 0, 0.010});
  hand.move({0, 0, -0.020}, 1000);
  EXPECT_NE(session.tool_state().portal, kNoPortal);
  EXPECT_LT(std::abs(session.tool_state().force_W.z()), 2);
  EXPECT_EQ(session.softs()->skin_readout(0).force_n[0], 0);
}

TEST(Skin, WhatBeginsUnderTheSkinIsNotFeltBeforeItHasBeenOut) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.at = {0, 0, -0.010};
  hand.take(kSkinBall, {0, 0, -0.010});
  hand.rest(50);
  EXPECT_EQ(session.tool_state().force_W, Vec3(0, 0, 0));
  EXPECT_GT(hand.felt_at({0, 0, -0.003}), 0.5);
}

void wander(SkinHandAt& hand, Random& random, int turns) {
  for (int n = 0; n < turns; ++n) {
    if (random.uniform(0, 1) < 0.25)
      hand.take(static_cast<std::uint32_t>(random.uniform(0, 3.999)), {0, 0, 0.020});
    const Vec3 to(random.uniform(-0.017, 0.017), random.uniform(-0.020, 0.020),
                  random.uniform(-0.035, 0.006));
    hand.move(to, 80);
  }
}

TEST(Skin, RandomWorkKeepsItSoundAndAReplayIsTheSameFromTheStartAndFromTheMiddle) {
  const SkinRun& run = skin_run();
  Session session = run.session();
  Recording recording = begin_recording(run);
  SkinHandAt hand(session);
  hand.into = &recording;
  Random random(5);
  hand.tick();
  hand.tick({CommandKind::kMark, 0});
  hand.take(kSkinTrocar, {0.005, 0.004, 0.010});
  hand.move({0.005, 0.004, -0.030}, 300);
  hand.move({0.005, 0.004, 0.010}, 200);
  wander(hand, random, 60);
  hand.tick({CommandKind::kRestore, 0});
  wander(hand, random, 20);
  EXPECT_GT(hand.count(kSkinCut), 3u);
  EXPECT_GT(hand.count(kSkinPierced), 0u);
  EXPECT_GT(hand.count(kSkinEntered), 0u);
  for (const double f : hand.force_z) ASSERT_TRUE(std::isfinite(f));
  ASSERT_GT(recording.states.size(), 8u);
  expect_same_replays(recording, run, session, {0.0, 0.8, 2.1, 3.6});
}

TEST(Skin, ARestorePointMakesItWholeAgain) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.take(kSkinBall, {0, 0, 0.010});
  const double before = hand.felt_at({0.001, 0.0015, -0.003});
  hand.move({0, 0, 0.010}, 50);
  hand.tick({CommandKind::kMark, 0});
  cut_along(hand, {-0.006, -0.002, 0}, {0.006, 0.002, 0});
  EXPECT_GT(session.softs()->skin_readout(0).cut_m, 0.010);
  hand.at = {0, 0, 0.020};
  hand.tick({CommandKind::kRestore, 0});
  hand.rest(300);
  EXPECT_EQ(session.softs()->skin_readout(0).cut_m, 0);
  EXPECT_EQ(hand.felt_at({0.001, 0.0015, -0.003}), before);
}

TEST(Skin, AStateInTheMiddleOfACutGoesOnTheSameAndAWrongOneIsRefused) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.take(kSkinBlade, {-0.0063, 0.0004, 0.010});
  hand.move({-0.0063, 0.0004, -0.008}, 300);
  hand.move({0, 0, -0.008}, 203);
  ASSERT_FALSE(session.save().world.softs.skin->patches[0].cuts.moved.empty());
  Session other = skin_run().session();
  const SessionState back = go_on_as(other, session);
  SkinHandAt again(other);
  again.at = hand.at;
  for (SkinHandAt* one : {&hand, &again}) {
    one->force_z.clear();
    one->move({0.004, 0.002, -0.008}, 201);
    one->move({0.004, 0.002, 0.010}, 101);
  }
  EXPECT_EQ(other.state_hash(), session.state_hash());
  EXPECT_EQ(again.force_z, hand.force_z);
  EXPECT_EQ(again.count(kSkinCutEnd), 1u);
  for (const int wrong : {0, 1, 2, 3}) {
    SessionState odd = back;
    SkinState skin = *odd.world.softs.skin;
    if (wrong == 0) skin.patches[0].cuts.cut[0].edge = 1u << 30;
    if (wrong == 1) skin.patches[0].cuts.moved[0].p.x() = std::nan("");
    if (wrong == 2) skin.hands[0][0].contact.part = 9;
    if (wrong == 3) skin.patches.clear();
    odd.world.softs.skin = std::make_shared<const SkinState>(skin);
    EXPECT_FALSE(other.restore(odd)) << wrong;
  }
}

TEST(Skin, PressingItAllocatesNothing) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.take(kSkinBall, {0, 0, 0.010});
  hand.events.reserve(1000);
  hand.force_z.reserve(10000);
  hand.move({0, 0, -0.003}, 100);
  const std::uint64_t before = testing::allocations();
  hand.move({0.005, 0.003, -0.004}, 300);
  EXPECT_EQ(testing::allocations(), before);
  EXPECT_GT(session.tool_state().force_W.z(), 1);
}

}  // namespace
}  // namespace osteon
