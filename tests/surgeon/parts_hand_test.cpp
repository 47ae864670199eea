#include "osteon/surgeon/parts_hand.h"

#include <gtest/gtest.h>

#include "osteon/surgeon/acl_driller.h"
#include "osteon/surgeon/placing_surgeon.h"
#include "placing_case.h"

namespace osteon {
namespace {

std::unique_ptr<AclDriller> one_move() {
  std::vector<AclMove> moves;
  moves.push_back({AclMove::Kind::kGo, {Vec3(0.01, 0, 0), Quat::Identity()}, 1});
  return std::make_unique<AclDriller>(std::move(moves), expert_skill());
}

HandPart part_from(const Pose& from) {
  HandPart part;
  part.path.with_instruments = true;
  part.path.samples = {PathSample(0, from, false), PathSample(0.1, from, false),
                       PathSample(0.2, {Vec3(0.02, 0, 0), Quat::Identity()}, false)};
  for (PathSample& sample : part.path.samples) sample.instrument = "pin";
  part.path.samples[1].instrument = part.path.samples[2].instrument = "clamp";
  part.path.samples[2].jaw = 1;
  part.orders = {{0.05, {CommandKind::kTension, 90}}, {0.3, {CommandKind::kBend, 30}}};
  return part;
}

std::vector<Command> played(PartsHand& hand, double seconds) {
  std::vector<Command> said;
  for (double t = 0; t < seconds && !hand.done(); t += 0.001) {
    (void)hand.step(0.001);
    if (hand.command().kind != CommandKind::kNone) said.push_back(hand.command());
  }
  return said;
}

TEST(PartsHand, WithoutPartsItEndsWithTheFirst) {
  PartsHand hand(one_move(), {});
  (void)played(hand, 1);
  EXPECT_TRUE(hand.done());
}

TEST(PartsHand, WaitsForAPartAndPlaysItFromWhereItIs) {
  int asked = 0;
  PartsHand hand(one_move(), {[&](const Pose& from) {
                   return ++asked < 100 ? std::nullopt : std::optional(part_from(from));
                 }});
  hand.set_tray({"pin", "clamp"});
  const auto said = played(hand, 2);
  EXPECT_TRUE(hand.done());
  EXPECT_EQ(asked, 100);
  ASSERT_EQ(said.size(), 4u);
  EXPECT_EQ(said[0].kind, CommandKind::kTension);
  EXPECT_EQ(said[1].kind, CommandKind::kTake);
  EXPECT_EQ(said[1].value, 1);
  EXPECT_EQ(said[2].kind, CommandKind::kJaw);
  EXPECT_EQ(said[3].kind, CommandKind::kBend);
  EXPECT_NEAR(hand.tip_W().x(), 0.02, 1e-9);
}

TEST(PartsHand, GivesUpWhatCannotBePlanned) {
  int later = 0;
  PartsHand hand(one_move(), {[](const Pose&) { return std::optional<HandPart>(); },
                              [&](const Pose& from) {
                                ++later;
                                return std::optional(part_from(from));
                              }});
  (void)played(hand, 10);
  EXPECT_TRUE(hand.done());
  EXPECT_EQ(later, 0);
}

TEST(PartsHand, PlaysTheFirstOnesOneAfterTheOther) {
  std::vector<std::unique_ptr<HandPlayer>> first;
  auto path = std::make_unique<ScriptedHand>(part_from({Vec3(0.01, 0, 0), Quat::Identity()}));
  path->set_tray({"pin", "clamp"});
  first.push_back(std::move(path));
  first.push_back(one_move());
  PartsHand hand(std::move(first), {});
  EXPECT_EQ(hand.start().p.x(), 0.01);
  const auto said = played(hand, 2);
  EXPECT_TRUE(hand.done());
  EXPECT_EQ(said.size(), 4u);
  EXPECT_NEAR(hand.tip_W().x(), 0.01, 1e-4);  // the second one trembles
}

// A knee of two blocks whose tibia turns a little.
std::shared_ptr<const Case> bending_blocks() {
  CaseDef def = testing::placing_def();
  JointDef knee;
  knee.name = "flexion";
  knee.fixed = "femur";
  knee.at_deg = 90;
  PoseTrack track;
  track.step = 30;
  const Pose rest = def.bones[0].X_WB.inverse() * def.bones[1].X_WB;
  for (int n = 0; n <= 4; ++n)
    track.poses.push_back(
        Pose{Vec3::Zero(), Quat(Eigen::AngleAxisd(0.01 * (3 - n), Vec3::UnitY()))} * rest);
  knee.bones.push_back({"tibia", track});
  def.joints.push_back(knee);
  auto built = build_case(std::move(def));
  EXPECT_TRUE(built);
  return std::make_shared<const Case>(std::move(*built));
}

struct Fixing {
  int cycles = 0;
  double last_n = 0, last_deg = 0, deepest_m = 0, aside_rad = 0;
};
Fixing fixing_by(const std::string& name) {
  const auto knee = bending_blocks();
  const PlacingPlan plan = *find_placing(*knee);
  Skill skill = expert_skill();
  skill.name = name;
  skill.tremor_m = 0;
  const auto part = plan_graft_fixing(*knee, plan, skill, {Vec3(0.3, 0, 0), Quat::Identity()},
                                      "clamp", "interference_screw:9");
  Fixing out;
  EXPECT_TRUE(part);
  if (!part) return out;
  for (const TimedCommand& order : part->orders) {
    if (order.command.kind == CommandKind::kTension) out.last_n = order.command.value;
    if (order.command.kind != CommandKind::kBend) continue;
    out.last_deg = order.command.value;
    if (order.command.value > 80) ++out.cycles;
  }
  const BoneSnapshot bent = bent_snapshot(*knee, knee->joints[0], out.last_deg);
  const Pose& X_WT = bent.bones[plan.tibia.bone].X_WB;
  const Vec3 mouth = X_WT * plan.tibia.outer_B;
  const Vec3 straight = (mouth - X_WT * plan.tibia.mouth_B).normalized();
  for (const PathSample& s : part->path.samples)
    if (s.instrument == "interference_screw:9" && s.power > 0) {
      const Vec3 axis = s.X_WD.q * Vec3::UnitZ();
      out.deepest_m = std::max(out.deepest_m, axis.dot(mouth - s.X_WD.p));
      out.aside_rad = std::acos(std::clamp(axis.dot(straight), -1.0, 1.0));
    }
  return out;
}

TEST(FixingWay, TheExpertBendsPullsAndTurnsTheScrewInAlongTheTunnel) {
  const Fixing good = fixing_by("expert");
  EXPECT_GE(good.cycles, 20);
  EXPECT_LE(good.cycles, 30);
  EXPECT_EQ(good.last_deg, 30);
  EXPECT_GE(good.last_n, 60);
  EXPECT_NEAR(good.deepest_m, 0.0265, 0.002);
  EXPECT_NEAR(good.aside_rad, 0, 1e-6);
}

TEST(FixingWay, EachFaultChangesOneThing) {
  EXPECT_LT(fixing_by("bad:few_cycles").cycles, 20);
  EXPECT_LT(fixing_by("bad:slack_tension").last_n, 40);
  EXPECT_LT(fixing_by("bad:shallow_screw").deepest_m, 0.015);
  EXPECT_GT(fixing_by("bad:diverging_screw").aside_rad, 0.3);
  const auto knee = testing::placing_knee();
  EXPECT_FALSE(plan_graft_fixing(*knee, *find_placing(*knee), expert_skill(), Pose{}, "clamp",
                                 "interference_screw:9"));
}

}  // namespace
}  // namespace osteon
