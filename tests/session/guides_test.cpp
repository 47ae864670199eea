// What leads an instrument into bone: its own hole, a pin that was left, an aimer that was fixed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "drilling.h"
#include "osteon/base/turn.h"
#include "osteon/carve/rbf_force.h"
#include "osteon/carve/removed.h"
#include "osteon/scene/carve_events.h"
#include "recorded_run.h"

namespace osteon {
namespace {

using testing::box_mesh;
using testing::go_on_as;
using testing::keep_tick;

constexpr double kFloor_m = 0.012;  // the block's top
constexpr double kDegree = std::numbers::pi / 180;

// Made once: its field takes a second.
const std::shared_ptr<const Case>& flat_bone() {
  static const std::shared_ptr<const Case> made = [] {
    CaseDef def;
    def.name = "flat bone";
    BoneDef bone;
    bone.name = "flat";
    bone.mesh = box_mesh(Vec3(0.02, 0.016, kFloor_m));
    bone.felt = Felt::kField;
    def.bones.push_back(bone);
    auto built = build_case(std::move(def));
    EXPECT_TRUE(built);
    return std::make_shared<const Case>(std::move(*built));
  }();
  return made;
}

// A flat bone, and instruments that stand slanted on it.
struct SlantedDrilling {
  std::shared_ptr<const Case> the_case = flat_bone();
  SessionSettings settings;
  Tray tray;
  std::shared_ptr<const CarvingSetup> setup;
  Vec3 back_W;
  Quat q_WT;
  std::vector<Event> events;
  Recording recording;

  SlantedDrilling(std::vector<std::string> names, double slant_deg) {
    settings.tray = std::move(names);
    settings.carve.on = true;
    settings.carve.cell_m = 0.0006;
    settings.carve.thrust_scale = 80;
    const auto all = load_instruments();
    EXPECT_TRUE(all);
    for (const std::string& text : settings.tray) {
      const auto name = parse_tool_name(text);
      const Instrument* found = find_instrument(*all, name->name);
      const auto size = name->size_mm ? find_size(*found, *name->size_mm) : found->usual_size;
      tray.push_back(std::make_shared<const Tool>(make_tool(*found, *size)));
    }
    auto made = make_carving(*the_case, settings.tray, settings.carve);
    EXPECT_TRUE(made);
    setup = *made;
    const double a = slant_deg * kDegree;
    back_W = {std::sin(a), 0, std::cos(a)};
    q_WT = turn_between(Vec3::UnitZ(), back_W);
  }
  Session session() const { return Session(the_case, settings, tray, setup); }
  // On the axis through the middle of the top, `height` before it; off it sideways.
  HandInput hand(double height, double aside = 0) const {
    HandInput out;
    out.input.X_WD = {Vec3(0.0003, 0.0002 + aside, kFloor_m) + height * back_W, q_WT};
    return out;
  }
  double height(const Session& session) const {
    return (session.tool_state().X_WP.p - Vec3(0.0003, 0.0002, kFloor_m)).dot(back_W);
  }
  double off_axis(const Session& session) const {
    const Vec3 off = session.tool_state().X_WP.p - Vec3(0.0003, 0.0002, kFloor_m);
    return (off - off.dot(back_W) * back_W).norm();
  }
  void tick(Session& session, const HandInput& input) {
    (void)session.tick(std::span(&input, 1));
    for (const Event& event : session.last_events()) events.push_back(event);
    keep_tick(recording, session);
  }
  void order(Session& session, double at, CommandKind kind, double value) {
    HandInput input = hand(at);
    input.command = {kind, value};
    tick(session, input);
  }
  // Pressed on with the same lead before the tip, until the tip is so deep or time is over.
  void press(Session& session, double deep, int most_ticks, double aside = 0) {
    for (int n = 0; n < most_ticks && height(session) > -deep; ++n)
      tick(session, hand(std::max(height(session) - 0.003, -deep - 0.003), aside));
  }
  bool told(EventKind kind) const {
    return std::any_of(events.begin(), events.end(),
                       [&](const Event& e) { return e.kind == kind; });
  }
};

double gone_mm3(const Session& session) {
  return 1e9 * total(removed_volume(*session.carving()->field(0)));
}

// A pin as if it had been drilled in along the axis and let go.
void put_pin(Session& session, const SlantedDrilling& with, double deep) {
  SessionState state = session.save();
  auto carved = std::make_shared<CarvingState>(*state.world.carved);
  carved->rods[0] = {GuideRod::Kind::kPin,
                     0,
                     {Vec3(0.0003, 0.0002, kFloor_m) - deep * with.back_W, with.q_WT},
                     0.0012,
                     0.2,
                     deep};
  state.world.carved = std::move(carved);
  ASSERT_TRUE(session.restore(state));
}

// What a cylinder with a flat front, its rim cut off at 45 degrees, takes of a half space when its
// middle is `deep` in it along its axis: summed in thin columns.
double cylinder_mm3(double radius, double deep, double slant) {
  constexpr int kSteps = 400;
  const double d = 2 * radius / kSteps, rim = 0.25 * radius;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double x = -radius + (i + 0.5) * d, y = -radius + (j + 0.5) * d;
      const double rho = std::hypot(x, y);
      if (rho > radius) continue;
      const double front = std::max(0.0, rho - (radius - rim));
      sum += std::max(0.0, deep - x * std::tan(slant) - front) * d * d;
    }
  return 1e9 * sum;
}

class OverAPin : public ::testing::TestWithParam<double> {};

// A thick drill goes along its pin into a bone however slanted, and takes what a cylinder does.
TEST_P(OverAPin, AThickDrillGoesInAlongIt) {
  SlantedDrilling with({"cannulated_drill:8"}, GetParam());
  Session session = with.session();
  for (int n = 0; n < 5; ++n) with.tick(session, with.hand(0.012));
  put_pin(session, with, 0.008);
  for (int n = 0; n < 200; ++n) with.tick(session, with.hand(0.012));
  EXPECT_TRUE(with.told(kLed));
  with.order(session, 0.012, CommandKind::kPower, 1);
  for (int n = 0; n < 120; ++n) with.tick(session, with.hand(0.012 - 0.0001 * n));
  with.press(session, 0.004, 5000);
  EXPECT_NEAR(with.height(session), -0.004, 1e-4);
  EXPECT_LT(with.off_axis(session), 5e-5);
  EXPECT_FALSE(with.told(kSkives));
  const double wanted = cylinder_mm3(0.004, -with.height(session), GetParam() * kDegree);
  EXPECT_NEAR(gone_mm3(session), wanted, 0.02 * wanted + 0.5);
}
INSTANTIATE_TEST_SUITE_P(Slants, OverAPin, ::testing::Values(0.0, 30.0, 60.0));

// Pulled aside it bends the pin a little and no more, and the hand feels it.
TEST(Guides, APinHoldsSideways) {
  SlantedDrilling with({"cannulated_drill:8"}, 0);
  Session session = with.session();
  put_pin(session, with, 0.008);
  for (int n = 0; n < 200; ++n) with.tick(session, with.hand(0.03));
  for (int n = 0; n < 200; ++n) with.tick(session, with.hand(0.03, 0.002));
  // k and the pin in a row: L^3 / (3 E I) of 30 mm free.
  const double inertia = std::numbers::pi / 4 * std::pow(0.0012, 4);
  const double give = std::pow(0.03, 3) / (3 * 193e9 * inertia);
  const double force = 0.002 / (1 / with.settings.haptic.stiffness_n_per_m + give);
  EXPECT_NEAR(session.tool_state().force_W.y(), -force, 0.02 * force);
  EXPECT_NEAR(with.off_axis(session), give * force, 3e-5);
}

// With one force for all bone a hand that goes on slowly along the pin feels the sum of piecewise
// linear functions at the drill's depth, in cortex and in cancellous bone.
TEST(Guides, AForceForTheWholeLineIsThatOfTheFormula) {
  SlantedDrilling with({"cannulated_drill:8"}, 0);
  with.settings.carve.guided_n = 3;
  with.setup = *make_carving(*with.the_case, with.settings.tray, with.settings.carve);
  Session session = with.session();
  for (int n = 0; n < 5; ++n) with.tick(session, with.hand(0.012));
  put_pin(session, with, 0.008);
  for (int n = 0; n < 200; ++n) with.tick(session, with.hand(0.012));
  with.order(session, 0.012, CommandKind::kPower, 1);
  for (int n = 0; n < 120; ++n) with.tick(session, with.hand(0.012 - 0.0001 * n));
  const GuidedTunnel tunnel{2 * kFloor_m, 3, 20};
  double before_m = 0;
  for (int n = 0; n < 5000; ++n) {
    with.tick(session, with.hand(-0.002 * 0.001 * n));
    if (n < 1500 || n % 500 != 0) continue;
    const CarvingHand& h = session.save().world.carved->hands[0];
    const double deep = (h.mouth_B - h.X_BC.p).dot(with.back_W);
    RbfDrillState drilled;
    EXPECT_GT(deep, before_m);
    EXPECT_NEAR(session.tool_state().force_W.z(), rbf_drill_force(drilled, tunnel, deep), 0.2) << n;
    before_m = deep;
  }
  EXPECT_GT(before_m, 0.004);
}

// Without anything that leads it, a drill that stands too slanted slides off and cuts nothing.
TEST(Guides, WithoutAStartASlantedDrillSlidesOff) {
  for (const char* name : {"drill:3.2", "cannulated_drill:8"}) {
    SlantedDrilling with({name}, 50);
    Session session = with.session();
    for (int n = 0; n < 5; ++n) with.tick(session, with.hand(0.006));
    with.order(session, 0.006, CommandKind::kPower, 1);
    for (int n = 0; n < 900; ++n) with.tick(session, with.hand(0.006 - 0.00001 * n));
    EXPECT_TRUE(with.told(kSkives)) << name;
    EXPECT_FALSE(with.told(kCutBegin)) << name;
    EXPECT_EQ(gone_mm3(session), 0) << name;
    EXPECT_GT(with.off_axis(session), 0.0005) << name;
  }
}

// A drill that has begun keeps its line: as thick as it may be, pulled aside or not.
TEST(Guides, AHoleKeepsItsLine) {
  for (const char* name : {"drill:3.2", "cannulated_drill:8"}) {
    SlantedDrilling with({name}, 20);
    Session session = with.session();
    for (int n = 0; n < 5; ++n) with.tick(session, with.hand(0.003));
    with.order(session, 0.003, CommandKind::kPower, 1);
    for (int n = 0; n < 300; ++n) with.tick(session, with.hand(0.003 - 0.00001 * n));
    with.press(session, 0.002, 4000);
    EXPECT_NEAR(with.height(session), -0.002, 1e-4) << name;
    const double before = with.off_axis(session);
    with.press(session, 0.003, 3000, 0.002);
    EXPECT_NEAR(with.off_axis(session), before, 5e-5) << name;
    EXPECT_LT(session.tool_state().force_W.y(), -3) << name;
  }
}

// A restore point puts the drill back into its hole while the hand is elsewhere: it is not drawn
// there.
TEST(Guides, ARestorePointDoesNotDrawAHandToADistantHole) {
  SlantedDrilling with({"drill:3.2"}, 0);
  Session session = with.session();
  for (int n = 0; n < 5; ++n) with.tick(session, with.hand(0.002));
  with.order(session, 0.002, CommandKind::kPower, 1);
  for (int n = 0; n < 200; ++n) with.tick(session, with.hand(0.002 - 0.00001 * n));
  with.press(session, 0.005, 6000);
  ASSERT_LT(with.height(session), -0.004);
  with.order(session, -0.005, CommandKind::kPower, 0);
  with.order(session, -0.005, CommandKind::kMark, 0);
  for (int n = 0; n < 100; ++n) with.tick(session, with.hand(-0.005 + 0.0002 * n));
  // Beside the block, and lower than the hole's mouth.
  for (int n = 0; n <= 300; ++n) with.tick(session, with.hand(0.015, 0.0001 * n));
  for (int n = 0; n <= 200; ++n) with.tick(session, with.hand(0.015 - 0.0001 * n, 0.03));
  ASSERT_LT(with.height(session), -0.004);
  ASSERT_GT(with.off_axis(session), 0.029);
  HandInput back = with.hand(-0.005, 0.03);
  back.command = {CommandKind::kRestore, 0};
  with.tick(session, back);
  for (int n = 0; n < 1500; ++n) {
    with.tick(session, with.hand(n < 100 ? -0.005 : -0.003, 0.03));
    ASSERT_LT(session.tool_state().force_W.norm(), 0.2) << n;
  }
  EXPECT_GT(with.off_axis(session), 0.029);
}

// Taken out and put back a little beside its axis, a drill falls into its hole, which leads it to
// the end without a jerk, and it goes on from there. So it does after its state went through bytes.
TEST(Guides, ADrillPutBackIntoItsHoleIsLedByIt) {
  for (const char* name : {"drill:3.2", "cannulated_drill:8"}) {
    SlantedDrilling with({name}, 15);
    Session session = with.session();
    for (int n = 0; n < 5; ++n) with.tick(session, with.hand(0.003));
    with.order(session, 0.003, CommandKind::kPower, 1);
    for (int n = 0; n < 300; ++n) with.tick(session, with.hand(0.003 - 0.00001 * n));
    with.press(session, 0.005, 6000);
    ASSERT_LT(with.height(session), -0.0048) << name;
    const Pose hole = session.save().world.carved->hands[0].X_BC;
    // Its tip may have slid a little on the slanted bone before it cut.
    const Vec3 to_hole = hole.p - with.hand(0).input.X_WD.p;
    const Vec3 slid = to_hole - to_hole.dot(with.back_W) * with.back_W;
    const auto over_hole = [&](double height, double aside) {
      HandInput hand = with.hand(height, aside);
      hand.input.X_WD.p += slid;
      return hand;
    };
    const auto off_line = [&](const Session& of) {
      const Vec3 off = of.tool_state().X_WP.p - hole.p, out = hole.q * Vec3::UnitZ();
      return (off - off.dot(out) * out).norm();
    };
    with.order(session, -0.005, CommandKind::kPower, 0);
    for (int n = 0; n < 200; ++n) with.tick(session, with.hand(-0.005 + 0.0001 * n));
    const auto bytes = state_from_bytes(to_bytes(session.save()));
    ASSERT_TRUE(bytes) << bytes.error().message();
    Session other = with.session();
    ASSERT_TRUE(other.restore(*bytes));
    const double gone = gone_mm3(session);
    for (Session* each : {&session, &other}) {
      double last = 0, most_step = 0, most = 0;
      for (int n = 0; n < 400; ++n) {
        with.tick(*each, over_hole(0.015 - 0.00005 * n, 0.0003));
        const double force = each->tool_state().force_W.norm();
        most_step = std::max(most_step, std::abs(force - last));
        most = std::max(most, with.height(*each) > -0.0046 ? force : 0.0);
        last = force;
      }
      EXPECT_LT(with.height(*each), -0.0046) << name;
      EXPECT_LT(off_line(*each), 5e-5) << name;
      EXPECT_LT(most, 1.2) << name;
      EXPECT_LT(most_step, 0.1) << name;
      EXPECT_EQ(gone_mm3(*each), gone) << name;
      with.order(*each, -0.006, CommandKind::kPower, 1);
      with.press(*each, 0.007, 6000);
      EXPECT_LT(with.height(*each), -0.0068) << name;
      EXPECT_LT(off_line(*each), 5e-5) << name;
    }
    EXPECT_EQ(other.state_hash(), session.state_hash()) << name;
  }
}

// Beside the hole there is bone.
TEST(Guides, AHoleDoesNotDrawADrillThatIsPutBesideIt) {
  SlantedDrilling with({"drill:3.2"}, 0);
  Session session = with.session();
  for (int n = 0; n < 5; ++n) with.tick(session, with.hand(0.003));
  with.order(session, 0.003, CommandKind::kPower, 1);
  for (int n = 0; n < 300; ++n) with.tick(session, with.hand(0.003 - 0.00001 * n));
  with.press(session, 0.005, 6000);
  with.order(session, -0.005, CommandKind::kPower, 0);
  for (int n = 0; n < 200; ++n) with.tick(session, with.hand(-0.005 + 0.0001 * n));
  for (int n = 0; n < 400; ++n) with.tick(session, with.hand(0.015 - 0.00005 * n, 0.004));
  EXPECT_GT(with.height(session), -1e-4);
  EXPECT_NEAR(with.off_axis(session), 0.004, 2e-4);
}

void drill_pin(SlantedDrilling& with, Session& session) {
  for (int n = 0; n < 5; ++n) with.tick(session, with.hand(0.002));
  with.order(session, 0.002, CommandKind::kPower, 1);
  for (int n = 0; n < 200; ++n) with.tick(session, with.hand(0.002 - 0.00001 * n));
  with.press(session, 0.007, 6000);
}

void play_pin(SlantedDrilling& with, Session& session) {
  drill_pin(with, session);
  with.order(session, -0.007, CommandKind::kPower, 0);
  with.order(session, -0.007, CommandKind::kJaw, 1);
  for (int n = 0; n < 10; ++n) with.tick(session, with.hand(-0.007));
}

// Drilled in and let go a pin stays, in the state too; a drill runs over it; a chuck takes it out.
TEST(Guides, APinStaysLeadsAndIsTakenOut) {
  SlantedDrilling with({"guide_pin:2.4", "cannulated_drill:4.5"}, 0);
  Session session = with.session();
  play_pin(with, session);
  ASSERT_TRUE(with.told(kPinLeft));
  const GuideRod pin = session.bones().rods[0];
  EXPECT_EQ(pin.kind, GuideRod::Kind::kPin);
  EXPECT_NEAR(pin.in_bone_m, 0.007, 3e-4);
  Session other = with.session();
  (void)go_on_as(other, session);
  for (Session* each : {&session, &other}) {
    with.events.clear();
    with.order(*each, 0.012, CommandKind::kTake, 1);
    for (int n = 0; n < 200; ++n) with.tick(*each, with.hand(0.012, 0.001));
    EXPECT_TRUE(with.told(kLed));
    EXPECT_LT(with.off_axis(*each), 5e-4);
    EXPECT_LT(each->tool_state().force_W.y(), -0.5);
  }
  EXPECT_EQ(other.state_hash(), session.state_hash());
  // Elsewhere a pin that is taken is another one.
  HandInput beside = with.hand(0.02, 0.02);
  beside.command = {CommandKind::kTake, 0};
  with.tick(session, beside);
  for (int n = 0; n < 40; ++n) with.tick(session, with.hand(0.02, 0.02 - 0.0005 * n));
  EXPECT_FALSE(with.told(kPinTaken));
  with.order(session, 0.001, CommandKind::kJaw, 1);
  for (int n = 0; n < 40; ++n) with.tick(session, with.hand(0.04 - 0.001 * n));
  with.order(session, 0.001, CommandKind::kJaw, 0);
  for (int n = 0; n < 4; ++n) with.tick(session, with.hand(0.001));
  EXPECT_TRUE(with.told(kPinTaken));
  EXPECT_EQ(session.bones().rods[0].kind, GuideRod::Kind::kNone);
}

// Its chuck open, the hand goes back along the pin and is off at once.
TEST(Guides, AnOpenChuckSlidesOffItsPin) {
  SlantedDrilling with({"guide_pin:2.4"}, 0);
  Session session = with.session();
  play_pin(with, session);
  ASSERT_TRUE(with.told(kPinLeft));
  for (int n = 0; n < 250; ++n) {
    with.tick(session, with.hand(-0.007 + 0.0001 * n));
    ASSERT_LT(session.tool_state().force_W.norm(), 0.5) << n;
  }
  EXPECT_NEAR(with.height(session), 0.0179, 5e-4);
  EXPECT_EQ(session.bones().rods[0].kind, GuideRod::Kind::kPin);
}

// Its chuck shut again while it is still in the hole, the pin is held by its hole as before: aside,
// at the hole's end, and when it drills on.
TEST(Guides, AChuckThatShutsInTheHoleHoldsItsPinAsBefore) {
  SlantedDrilling with({"guide_pin:2.4"}, 0);
  Session session = with.session();
  play_pin(with, session);
  ASSERT_TRUE(with.told(kPinLeft));
  with.order(session, -0.007, CommandKind::kJaw, 0);
  for (int n = 0; n < 10; ++n) with.tick(session, with.hand(-0.007));
  ASSERT_TRUE(with.told(kPinTaken));
  EXPECT_EQ(session.bones().rods[0].kind, GuideRod::Kind::kNone);
  for (int n = 0; n < 300; ++n) with.tick(session, with.hand(-0.007, 0.002));
  EXPECT_LT(with.off_axis(session), 5e-4);
  EXPECT_LT(session.tool_state().force_W.y(), -0.5);
  for (int n = 0; n < 300; ++n) with.tick(session, with.hand(-0.011));
  EXPECT_GT(with.height(session), -0.0075);
  EXPECT_GT(session.tool_state().force_W.z(), 1);
  const double before_mm3 = gone_mm3(session);
  with.order(session, -0.009, CommandKind::kPower, 1);
  with.press(session, 0.010, 8000);
  EXPECT_LT(with.height(session), -0.0085);
  EXPECT_LT(with.off_axis(session), 5e-4);
  EXPECT_GT(gone_mm3(session), before_mm3 + 1);
}

// Whatever is taken within bone feels nothing and removes nothing until it has been outside.
TEST(Guides, AToolTakenWithinBoneDoesNothingThere) {
  for (const char* name : {"drill:3.2", "microdrill:4", "kerrison_punch:3", "osteotome:8"}) {
    SlantedDrilling with({"hook_probe", name}, 0);
    Session session = with.session();
    const HandInput within = with.hand(-0.005);
    HandInput take = within;
    // A probe on its way through the bone's side, as a hand may leave it, is outside; the hand is
    // within.
    for (int n = 0; n < 20; ++n) with.tick(session, within);
    take.command = {CommandKind::kTake, 1};
    with.tick(session, take);
    with.order(session, -0.005, CommandKind::kPower, 1);
    with.order(session, -0.005, CommandKind::kJaw, 1);
    for (int n = 0; n < 300; ++n) {
      with.tick(session, within);
      if (n == 150) with.order(session, -0.005, CommandKind::kJaw, 0);
      EXPECT_LT(session.tool_state().force_W.norm(), 0.01) << name << n;
    }
    EXPECT_EQ(gone_mm3(session), 0) << name;
    with.order(session, -0.005, CommandKind::kPower, 0);
    for (int n = 0; n < 400; ++n) with.tick(session, with.hand(-0.005 + 0.00005 * n));
    for (int n = 0; n < 400; ++n) with.tick(session, with.hand(0.015 - 0.00005 * n));
    EXPECT_GT(session.tool_state().force_W.norm(), 1) << name;
  }
}

// A hand that takes another instrument leaves its pin where it is; a replay does the same.
TEST(Guides, APinStaysWhenAnotherInstrumentIsTakenAndReplays) {
  SlantedDrilling with({"guide_pin:2.4", "cannulated_drill:4.5"}, 0);
  Session session = with.session();
  with.recording.header = recording_header(*with.the_case, with.settings, "test", "0", with.tray);
  drill_pin(with, session);
  with.order(session, -0.007, CommandKind::kTake, 1);
  for (int n = 0; n < 4; ++n) with.tick(session, with.hand(0.03));
  EXPECT_TRUE(with.told(kPinLeft));
  EXPECT_EQ(session.bones().rods[0].kind, GuideRod::Kind::kPin);
  for (int n = 0; n < 200; ++n) with.tick(session, with.hand(0.03 - 0.0001 * n, 0.001));
  EXPECT_TRUE(with.told(kLed));
  with.recording.complete = true;
  ReplayOptions options;
  options.tray = with.tray;
  options.carving = with.setup;
  const auto outcome = replay(with.recording, with.the_case, options);
  ASSERT_TRUE(outcome) << outcome.error().message();
  EXPECT_TRUE(outcome->identical) << outcome->first_different_tick;
  EXPECT_EQ(outcome->state_hash, session.state_hash());
}

// Through nothing a pin may go on faster than its hole is looked for. It still stands in the bone
// behind it, from its mouth on, and stays there when it is let go.
TEST(Guides, APinThatHasGoneOnThroughNothingIsInTheSameHole) {
  SlantedDrilling with({"guide_pin:2.4", "cannulated_drill:4.5"}, 0);
  Session session = with.session();
  drill_pin(with, session);
  SessionState state = session.save();
  auto carved = std::make_shared<CarvingState>(*state.world.carved);
  carved->hands[0].X_BC.p += 0.002 * with.back_W;
  state.world.carved = std::move(carved);
  ASSERT_TRUE(session.restore(state));
  with.order(session, -0.012, CommandKind::kPower, 1);
  with.press(session, 0.009, 4000);
  ASSERT_LT(with.height(session), -0.0085);
  with.order(session, -0.009, CommandKind::kTake, 1);
  for (int n = 0; n < 4; ++n) with.tick(session, with.hand(0.03));
  EXPECT_TRUE(with.told(kPinLeft));
  EXPECT_NEAR(session.bones().rods[0].in_bone_m, 0.009, 5e-4);
}

// Through the far side a drill falls on to the hand, which is told.
TEST(Guides, ADrillThatComesOutPlunges) {
  testing::Drilling with("drill:3.2");
  with.with([](CarvingSetup& setup) { setup.thrust_scale = 300; });
  Session session = with.session();
  bool breached = false, out_in_one = false;
  double before = 0.01, fastest = 0;
  for (std::uint64_t n = 1; n <= 5000 && !out_in_one; ++n) {
    HandInput hand = testing::down_at(n, 1, 0.02, 0.0);
    const double z = session.tool_state().X_WP.p.z();
    if (n > 60) hand.input.X_WD.p.z() = z - 0.003;
    (void)session.tick(std::span(&hand, 1));
    for (const Event& event : session.last_events()) breached = breached || event.kind == kBreached;
    if (breached) fastest = std::max(fastest, before - session.tool_state().X_WP.p.z());
    before = session.tool_state().X_WP.p.z();
    out_in_one = breached && before < -testing::kTop_m - 0.004;
  }
  EXPECT_TRUE(breached);
  EXPECT_TRUE(out_in_one);
  EXPECT_GT(fastest, 2e-4) << "nothing holds it back";
  EXPECT_NEAR(session.tool_state().X_WP.p.x(), 0.0003, 1e-4);
}

// An aimer's sleeve leads a pin along its line into a bone on which it would slide off.
TEST(Guides, AnAimerFixesThePinsLine) {
  SlantedDrilling with({"femoral_offset_aimer:6", "guide_pin:2.4"}, 50);
  Session session = with.session();
  for (int n = 0; n < 5; ++n) with.tick(session, with.hand(0.006));
  with.order(session, 0.006, CommandKind::kJaw, 1);
  for (int n = 0; n < 500; ++n) with.tick(session, with.hand(0.006 - 0.00002 * n));
  ASSERT_GT(session.tool_state().contact_count, 0u);
  with.order(session, -0.004, CommandKind::kJaw, 0);
  for (int n = 0; n < 4; ++n) with.tick(session, with.hand(-0.004));
  ASSERT_TRUE(with.told(kAimed));
  const GuideRod sleeve = session.bones().rods[0];
  ASSERT_EQ(sleeve.kind, GuideRod::Kind::kSleeve);
  // Where the aimer stands, the pin goes in.
  const Vec3 at_W = sleeve.X_BR.p;
  const auto hand_at = [&](double height) {
    HandInput out;
    out.input.X_WD = {at_W + height * with.back_W, with.q_WT};
    return out;
  };
  HandInput take = hand_at(0.05);
  take.command = {CommandKind::kTake, 1};
  with.tick(session, take);
  for (int n = 0; n < 200; ++n) with.tick(session, hand_at(0.05));
  EXPECT_TRUE(with.told(kLed));
  HandInput power = hand_at(0.05);
  power.command = {CommandKind::kPower, 1};
  with.tick(session, power);
  const auto deep = [&] { return (session.tool_state().X_WP.p - at_W).dot(with.back_W); };
  for (int n = 0; n < 5000 && deep() > -0.008; ++n)
    with.tick(session, hand_at(std::max(deep() - 0.003, -0.012)));
  EXPECT_LT(deep(), -0.0075);
  EXPECT_FALSE(with.told(kSkives));
  const Vec3 off = session.tool_state().X_WP.p - at_W;
  EXPECT_LT((off - off.dot(with.back_W) * with.back_W).norm(), 5e-5);
}

// The tibial aimer's arm stands at 55 degrees to its shaft. With the shaft leant over by 65 degrees
// its tip rests on the middle of the top, and the line comes from outside and below, through the
// bone's side: along it a pin goes to the tip.
TEST(Guides, ATibialAimersLineComesThroughTheBoneToItsTip) {
  SlantedDrilling with({"tibial_aimer", "guide_pin:2.4"}, 0);
  Session session = with.session();
  const Quat lean(Eigen::AngleAxisd(65 * kDegree, Vec3::UnitY()));
  const auto hand_at = [&](const Vec3& p_W, const Quat& q, CommandKind kind = CommandKind::kNone,
                           double value = 0) {
    HandInput out;
    out.input.X_WD = {p_W, q};
    out.command = {kind, value};
    return out;
  };
  const auto tip_at = [&](double over) { return Vec3(0, 0, kFloor_m + 0.0011 + over); };
  with.tick(session, hand_at(tip_at(0.003), lean, CommandKind::kJaw, 1));
  for (int n = 0; n < 400; ++n) with.tick(session, hand_at(tip_at(0.003 - 0.00001 * n), lean));
  ASSERT_GT(session.tool_state().contact_count, 0u);
  with.tick(session, hand_at(tip_at(-0.001), lean, CommandKind::kJaw, 0));
  for (int n = 0; n < 4; ++n) with.tick(session, hand_at(tip_at(-0.001), lean));
  ASSERT_TRUE(with.told(kAimed));
  const GuideRod sleeve = session.bones().rods[0];
  ASSERT_EQ(sleeve.kind, GuideRod::Kind::kSleeve);
  const Vec3 out = sleeve.X_BR.q * Vec3::UnitZ();
  EXPECT_LT((out - Vec3(std::sin(120 * kDegree), 0, std::cos(120 * kDegree))).norm(), 2e-3);
  EXPECT_LT((sleeve.X_BR.p - session.tool_state().X_WP.p).norm(), 1e-4);
  // The pin is slipped into the sleeve outside of the bone and drilled to 8 mm before the tip.
  const Quat along = turn_between(Vec3::UnitZ(), out);
  const auto on_line = [&](double from_tip) { return Vec3(sleeve.X_BR.p + from_tip * out); };
  with.tick(session, hand_at(on_line(0.05), along, CommandKind::kTake, 1));
  for (int n = 0; n < 200; ++n) with.tick(session, hand_at(on_line(0.05), along));
  EXPECT_TRUE(with.told(kLed));
  with.tick(session, hand_at(on_line(0.05), along, CommandKind::kPower, 1));
  for (int n = 0; n < 200; ++n) with.tick(session, hand_at(on_line(0.05 - 0.0001 * n), along));
  const auto left = [&] { return (session.tool_state().X_WP.p - sleeve.X_BR.p).dot(out); };
  for (int n = 0; n < 6000 && left() > 0.008; ++n)
    with.tick(session, hand_at(on_line(std::max(left() - 0.003, 0.005)), along));
  EXPECT_LT(left(), 0.0085);
  EXPECT_FALSE(with.told(kSkives));
  const Vec3 off = session.tool_state().X_WP.p - on_line(left());
  EXPECT_LT(off.norm(), 5e-5);
  // From the side at x = 20 mm to there, less what its point of 60 degrees leaves.
  const double point = 0.0012 / std::tan(30 * kDegree);
  const double deep = 0.020 / std::sin(120 * kDegree) - left() - 2 * point / 3;
  EXPECT_NEAR(gone_mm3(session), std::numbers::pi * 1.2 * 1.2 * 1000 * deep, 5);
}

}  // namespace
}  // namespace osteon
