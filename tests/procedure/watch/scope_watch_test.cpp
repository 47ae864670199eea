#include "osteon/procedure/scope_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "osteon/procedure/judge.h"
#include "osteon/scene/build_case.h"

namespace osteon {
namespace {

constexpr double kRad = std::numbers::pi / 180;

// A plate of 20 x 20 x 2 mm about the origin, and two marks: above it and under it.
Case plate() {
  BoneDef def;
  def.name = "plate";
  def.felt = Felt::kHull;
  for (int i = 0; i < 8; ++i)
    def.mesh.vertices.push_back(
        Vec3((i & 1) ? 0.01 : -0.01, (i & 2) ? 0.01 : -0.01, (i & 4) ? 0.001 : -0.001));
  def.mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                        {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  CaseDef c;
  c.name = "plate";
  c.bones = {def};
  c.landmarks = {{"over", {0, 0, 0.0011}}, {"under", {0, 0, -0.02}}};
  auto made = build_case(std::move(c));
  EXPECT_TRUE(made) << made.error().message();
  return std::move(*made);
}

// A straight scope 30 mm over the plate that looks down, as turned about the shaft.
ToolState held_over(double turned_rad, double off_m = 0) {
  ToolState tool;
  tool.tick = 10;
  tool.X_WP.p = {off_m, 0, 0.03};
  tool.X_WP.q = Quat(Eigen::AngleAxisd(turned_rad, Vec3::UnitZ()));
  return tool;
}

std::vector<Event> seen_by(const ToolState& tool, ScopeOptics optics,
                           std::optional<Vec3> portal = {}) {
  const Case c = plate();
  ScopeWatch watch(c, {optics, {0, 1}, portal, 0, 0.001});
  std::vector<Event> out;
  watch.add(tool, nullptr, rest_snapshot(c), out);
  return out;
}

TEST(ScopeView, LeansByTheAngleOfTheOptic) {
  const ScopeView straight = view_through({0, 0.9}, {});
  EXPECT_NEAR((straight.along_W - Vec3(0, 0, -1)).norm(), 0, 1e-12);
  const ScopeView oblique = view_through({30 * kRad, 0.9}, {});
  EXPECT_NEAR(std::acos(oblique.along_W.dot(Vec3(0, 0, -1))), 30 * kRad, 1e-12);
  EXPECT_GT(oblique.along_W.y(), 0);
  EXPECT_NEAR(oblique.along_W.dot(oblique.up_W), 0, 1e-12);
}

TEST(ScopeView, TurnIsTheAngleFromUpright) {
  ScopeView level{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitZ()};
  EXPECT_NEAR(turn_deg(level), 0, 1e-12);
  for (const double degrees : {-170.0, -30.0, 5.0, 90.0}) {
    ScopeView turned = level;
    turned.up_W = Eigen::AngleAxisd(degrees * kRad, Vec3::UnitX()) * Vec3::UnitZ();
    EXPECT_NEAR(std::abs(turn_deg(turned)), std::abs(degrees), 1e-9);
  }
  EXPECT_EQ(turn_deg({Vec3::Zero(), -Vec3::UnitZ(), Vec3::UnitY()}), 0);  // nothing is upright
}

TEST(Hidden, IsWhatLiesBehindABone) {
  const Case c = plate();
  const BoneSnapshot rest = rest_snapshot(c);
  EXPECT_FALSE(is_hidden(c, rest, {0, 0, 0.03}, {0, 0, 0.0011}));
  EXPECT_TRUE(is_hidden(c, rest, {0, 0, 0.03}, {0, 0, -0.02}));
  EXPECT_FALSE(is_hidden(c, rest, {0.02, 0, 0.03}, {0.02, 0, -0.02}));  // past the rim
  EXPECT_FALSE(is_hidden(c, rest, {0, 0, 0.03}, {0, 0, 0.03}));
  BoneSnapshot moved = rest;
  moved.bones[0].X_WB.p = {0.05, 0, 0};
  EXPECT_FALSE(is_hidden(c, moved, {0, 0, 0.03}, {0, 0, -0.02}));
}

TEST(ScopeWatch, TellsOfMarksThatAreSeenAndOfNoOthers) {
  const auto events = seen_by(held_over(0), {0, 45 * kRad});
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].kind, kMarkSeen);
  EXPECT_EQ(events[0].subject, 0u);
  EXPECT_NEAR(events[0].values[0], 0, 1e-6);
  EXPECT_NEAR(events[0].values[1], 28.9, 1e-9);
  EXPECT_EQ(events[1].kind, kScopeHeld);
  EXPECT_EQ(events[1].values[1], 1);
  // 28.9 mm over it and as far aside: 45 degrees off, half of a half field of 90.
  const auto aside = seen_by(held_over(0, 0.0289), {0, 90 * kRad});
  EXPECT_NEAR(aside[0].values[0], 0.5, 1e-9);
  // In half a field of 44 the mark above is out of the picture; the one below shows past the rim.
  const auto narrow = seen_by(held_over(0, 0.0289), {0, 44 * kRad});
  ASSERT_EQ(narrow.size(), 2u);
  EXPECT_EQ(narrow[0].kind, kMarkSeen);
  EXPECT_EQ(narrow[0].subject, 1u);
  EXPECT_EQ(narrow[1].values[1], 1);
}

TEST(ScopeWatch, MeasuresHowFarTheShaftPassesItsPortal) {
  const auto through = seen_by(held_over(0), {0, 0.8}, Vec3(0, 0, 0.09));
  EXPECT_EQ(through[0].kind, kShaftHeld);
  EXPECT_NEAR(through[0].values[0], 0, 1e-9);
  EXPECT_NEAR(seen_by(held_over(0), {0, 0.8}, Vec3(0, 0.006, 0.09))[0].values[0], 6, 1e-9);
  // Not inside yet: nothing to lever on.
  EXPECT_NEAR(seen_by(held_over(0), {0, 0.8}, Vec3(0, 0.006, 0.01))[0].values[0], 0, 1e-9);
}

TEST(ScopeWatch, SaysNothingOfAPoseThatIsNone) {
  ToolState tool = held_over(0);
  tool.X_WP.p.x() = std::nan("");
  EXPECT_TRUE(seen_by(tool, {0, 0.8}).empty());
}

// One goal over the mark above the plate, and the errors of the hand itself.
Scenario look(const std::string& goal) {
  const std::string text =
      "format = 1\nname = \"look\"\ntitle = \"L\"\ntext = \"L\"\nversion = 1\n"
      "anatomy = \"fast_box\"\n[[stages]]\nname = \"s\"\ntitle = \"S\"\ninstruction = \"I\"\n"
      "[[stages.goals]]\n" +
      goal +
      "\n[[errors]]\nname = \"tilt\"\ntitle = \"T\"\nseverity = \"major\"\nconsequence = \"c\"\n"
      "source = \"D\"\nrule = \"tilted\"\nlevel_deg = 15\nfor_s = 0.5\n"
      "[[errors]]\nname = \"lost\"\ntitle = \"T\"\nseverity = \"major\"\nconsequence = \"c\"\n"
      "source = \"D\"\nrule = \"nothing_seen\"\nfor_s = 0.5\n";
  auto scenario = parse_scenario(text, "look.toml");
  EXPECT_TRUE(scenario) << scenario.error().message();
  return std::move(*scenario);
}

struct Looker {
  explicit Looker(const std::string& goal) : c(plate()), plan(*plan_scenario(look(goal), c)) {
    state = begin_scenario(plan);
  }
  void see(double from_s, double to_s, double share, double mm, double turned) {
    for (double t = from_s; t < to_s; t += 0.01) {
      send(t, kMarkSeen, SubjectKind::kLandmark, {share, mm, turned});
      send(t, kScopeHeld, SubjectKind::kNothing, {turned, 1, 0});
    }
  }
  void blind(double from_s, double to_s) {
    for (double t = from_s; t < to_s; t += 0.01)
      send(t, kScopeHeld, SubjectKind::kNothing, {0, 0, 0});
  }
  void send(double t, EventKind kind, SubjectKind about, std::array<double, 3> values) {
    Event event;
    event.tick = static_cast<std::uint64_t>(t * 1000 + 0.5);
    event.kind = kind;
    event.subject_kind = about;
    event.subject = 0;
    event.values = values;
    judge(plan, event, 0.001, state);
  }
  Case c;
  ScenarioPlan plan;
  ScenarioState state;
};

const char* const kSeen =
    "rule = \"seen\"\nmarks = [\"over\"]\nfor_s = 1\ncentral = 0.3\nnear_mm = 5\nfar_mm = 40\n"
    "level_deg = 20";

TEST(SeenRule, WantsTheMiddleTheDistanceTheUprightAndTheTime) {
  for (const auto& [share, mm, turned] :
       {std::array{0.4, 20.0, 0.0}, {0.1, 4.0, 0.0}, {0.1, 41.0, 0.0}, {0.1, 20.0, 21.0}}) {
    Looker looker(kSeen);
    looker.see(0, 3, share, mm, turned);
    EXPECT_LT(looker.state.completed_s[0], 0) << share << " " << mm << " " << turned;
  }
  Looker looker(kSeen);
  looker.see(0, 0.9, 0.1, 20, 0);
  EXPECT_LT(looker.state.completed_s[0], 0);
  looker.see(0.9, 1.2, 0.1, 20, 0);
  EXPECT_NEAR(looker.state.completed_s[0], 1, 0.02);
}

TEST(SeenRule, ABreakBeginsAnew) {
  Looker looker(kSeen);
  looker.see(0, 0.8, 0.1, 20, 0);
  looker.see(1.0, 1.8, 0.1, 20, 0);
  EXPECT_LT(looker.state.completed_s[0], 0);
}

TEST(SeenRule, ASpanIsGoneThroughWithoutABreak) {
  const std::string span = std::string(kSeen) + "\nspan_mm = 20";
  Looker still(span);
  still.see(0, 5, 0.1, 20, 0);
  EXPECT_LT(still.state.completed_s[0], 0);
  Looker moves(span);
  moves.see(0, 1, 0.1, 10, 0);
  moves.see(1, 1.1, 0.1, 31, 0);
  EXPECT_GE(moves.state.completed_s[0], 1);
}

TEST(HandRules, TiltAndLossLastBeforeTheyCountAndCountOnce) {
  Looker looker(kSeen);
  looker.blind(0, 2);  // nothing has been seen yet: nothing is lost
  EXPECT_TRUE(looker.state.errors.empty());
  looker.see(2, 2.4, 0.9, 20, 30);
  EXPECT_TRUE(looker.state.errors.empty());
  looker.see(2.4, 4, 0.9, 20, 30);
  ASSERT_EQ(looker.state.errors.size(), 1u);
  EXPECT_NEAR(looker.state.errors[0].at_s, 2, 0.02);
  EXPECT_EQ(looker.state.errors[0].bone, kNoSubject);
  looker.blind(4, 6);
  EXPECT_EQ(looker.state.errors.size(), 2u);
}

TEST(ScopeWatch, NamesThePortalThatTheShaftPasses) {
  const Case c = plate();
  ScopeWatch::Settings settings;
  settings.portal_marks = {1, 0};
  ScopeWatch watch(c, settings);
  ToolState tool = held_over(0);
  std::vector<Event> out;
  watch.add(tool, nullptr, rest_snapshot(c), out);  // it passes none
  EXPECT_TRUE(out.empty());
  tool.portal = 1;
  watch.add(tool, nullptr, rest_snapshot(c), out);
  ASSERT_EQ(out.size(), 1u);
  EXPECT_EQ(out[0].kind, kThroughPortal);
  EXPECT_EQ(out[0].subject_kind, SubjectKind::kLandmark);
  EXPECT_EQ(out[0].subject, 0u);
}

TEST(ThroughRule, WantsTheTimeWithoutABreakAndNoSight) {
  const char* const goal = "rule = \"through\"\nmarks = [\"over\"]\nfor_s = 0.5";
  Looker looks(goal);
  looks.see(0, 3, 0.1, 20, 0);
  EXPECT_LT(looks.state.completed_s[0], 0);
  Looker broken(goal);
  for (int i = 0; i < 100; ++i)
    if (i % 45 >= 5) broken.send(0.01 * i, kThroughPortal, SubjectKind::kLandmark, {0, 0, 0});
  EXPECT_LT(broken.state.completed_s[0], 0);
  Looker whole(goal);
  for (int i = 0; i < 60; ++i)
    whole.send(0.01 * i, kThroughPortal, SubjectKind::kLandmark, {0, 0, 0});
  EXPECT_NEAR(whole.state.completed_s[0], 0.5, 0.011);
}

TEST(SeenRule, NeedsMarksThatAreThere) {
  EXPECT_FALSE(parse_scenario("format = 1\n", "x"));
  Scenario scenario = look("rule = \"seen\"\nmarks = [\"nowhere\"]");
  const Case c = plate();
  EXPECT_FALSE(plan_scenario(scenario, c));
  ASSERT_FALSE(check_scenario(scenario, c).empty());
  EXPECT_NE(check_scenario(scenario, c)[0].find("no landmark 'nowhere'"), std::string::npos);
  EXPECT_TRUE(check_scenario(look(kSeen), c).empty());
  const auto narrow =
      check_scenario(look("rule = \"seen\"\nmarks = [\"over\"]\nnear_mm = 20\nfar_mm = 10"), c);
  ASSERT_EQ(narrow.size(), 1u);
  EXPECT_NE(narrow[0].find("can never be met"), std::string::npos);
}

}  // namespace
}  // namespace osteon
