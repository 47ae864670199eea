// What the tip of an instrument goes into and comes out of is an event.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "count_allocations.h"
#include "drilling.h"
#include "mesh/shapes.h"
#include "osteon/physics/structure_watch.h"
#include "recorded_run.h"
#include "session_fixtures.h"
#include "soft_fixtures.h"

namespace osteon {
namespace {

using testing::keep_tick;

constexpr double kStructureTick_s = 0.001,
                 kStructureLook_s = 2 * StructureWatch::kEvery * kStructureTick_s;
const Vec3 kFatHalf(0.006, 0.005, 0.004);
const Vec3 kFatMiddle(0, 0, 0.03);
constexpr double kBallRadius = 0.005;
const Vec3 kBallMiddle(0, 0.03, 0.03);

SoftDef soft(const std::string& name, const std::string& kind, TriMesh mesh,
             std::vector<std::string> bones = {}) {
  SoftDef def;
  def.name = name;
  def.kind = kind;
  def.tissue = kind == "cartilage" ? "articular_cartilage" : "fat";
  def.mesh_W = std::move(mesh);
  def.bones = std::move(bones);
  return def;
}

// A box of fat and a ball of it over a box of bone, which are not felt.
std::shared_ptr<const Case> fat_case(const std::string& kind = "fat", bool open = false) {
  CaseDef def;
  def.name = "fat";
  BoneDef bone;
  bone.name = "bone";
  bone.mesh = testing::box_mesh(testing::kBoxHalf);
  def.bones.push_back(bone);
  TriMesh box = testing::box_mesh(kFatHalf);
  for (Vec3& p : box.vertices) p += kFatMiddle;
  if (open) box.triangles.pop_back();
  def.softs.push_back(soft("box", kind, box, {"bone"}));
  def.softs.push_back(soft("ball", kind, test::sphere(kBallRadius, 40, kBallMiddle)));
  auto built = build_case(std::move(def));
  if (!built) return nullptr;
  return std::make_shared<const Case>(std::move(*built));
}

ToolInput tip_at(const Vec3& p_W) {
  ToolInput input;
  input.X_WD.p = p_W;
  return input;
}

bool is_told(const Event& event) {
  return event.kind == EventKind::kStructureEntered || event.kind == EventKind::kStructureLeft;
}

// Goes from one place to another in so many ticks; what is entered and left.
std::vector<Event> go(Session& session, const Vec3& from_W, const Vec3& to_W, int ticks) {
  std::vector<Event> told;
  for (int n = 1; n <= ticks; ++n) {
    (void)session.tick(tip_at(from_W + n * (to_W - from_W) / ticks));
    for (const Event& event : session.last_events())
      if (is_told(event)) told.push_back(event);
  }
  return told;
}

const Vec3 kAcrossFat(0.02, 0, 0);

TEST(Structures, FarFromAllOfThemNothingIsTold) {
  Session session(fat_case(), {});
  EXPECT_TRUE(go(session, Vec3(0, -0.05, 0.03), Vec3(0, -0.04, 0.03), 400).empty());
}

// 20 mm/s along x through a box of 12 mm: in at 0.7 s, out at 1.3 s, 4 mm under the nearest side.
TEST(Structures, ABoxIsEnteredAndLeftWhereTheTipPassesItsSides) {
  Session session(fat_case(), {});
  const std::vector<Event> told =
      go(session, kFatMiddle - kAcrossFat, kFatMiddle + kAcrossFat, 2000);
  ASSERT_EQ(told.size(), 2u);
  const double speed = 0.02, in_s = (0.02 - kFatHalf.x()) / speed,
               out_s = (0.02 + kFatHalf.x()) / speed;
  EXPECT_EQ(told[0].kind, EventKind::kStructureEntered);
  EXPECT_EQ(told[0].subject_kind, SubjectKind::kSoftPart);
  EXPECT_EQ(told[0].subject, 0u);
  EXPECT_EQ(told[0].hand, 0);
  const double entered_s = static_cast<double>(told[0].tick) * kStructureTick_s;
  EXPECT_GE(entered_s, in_s);
  EXPECT_LE(entered_s,
            in_s + StructureWatch::kIn_m / speed + kStructureLook_s + 3 * kStructureTick_s);
  EXPECT_NEAR(told[0].p_W.x(), kFatMiddle.x() - kFatHalf.x(), 3e-4);
  EXPECT_EQ(told[1].kind, EventKind::kStructureLeft);
  EXPECT_EQ(told[1].subject, 0u);
  const double left_s = static_cast<double>(told[1].tick) * kStructureTick_s;
  const double wait_s = 2 * kStructureTick_s * StructureWatch::kOutSteps;
  EXPECT_NEAR(left_s, out_s + wait_s, kStructureLook_s + 3 * kStructureTick_s);
  EXPECT_NEAR(told[1].values[0], out_s - in_s,
              StructureWatch::kIn_m / speed + 2 * kStructureLook_s);
  EXPECT_NEAR(told[1].values[1], kFatHalf.z() * 1e3, 1e-6);
}

// A chord of a ball, 3 mm off its middle: 2 sqrt(5^2 - 3^2) = 8 mm long, 2 mm deep.
TEST(Structures, OfABallItIsTheChord) {
  Session session(fat_case(), {});
  const Vec3 off = kBallMiddle + Vec3(0, 0.003, 0);
  const std::vector<Event> told = go(session, off - kAcrossFat, off + kAcrossFat, 4000);
  ASSERT_EQ(told.size(), 2u);
  EXPECT_EQ(told[0].subject, 1u);
  const double speed = 0.01;
  const double in_s = (0.02 - 0.004) / speed;
  // Entered once it is kIn_m deep: the slope of the depth along the chord is 4/5 there.
  EXPECT_NEAR(static_cast<double>(told[0].tick) * kStructureTick_s,
              in_s + StructureWatch::kIn_m / 0.8 / speed, 0.012);
  EXPECT_NEAR(told[1].values[0], 0.008 / speed, 0.03);
  EXPECT_NEAR(told[1].values[1], 2, 0.02);
}

TEST(Structures, ATipOnASurfaceTellsNothingAndAShortWayOutIsNone) {
  Session session(fat_case(), {});
  const Vec3 top = kFatMiddle + Vec3(0, 0, kFatHalf.z());
  const Vec3 just_under = top - Vec3(0, 0, StructureWatch::kIn_m / 2);
  EXPECT_TRUE(go(session, just_under, just_under, 300).empty());
  EXPECT_EQ(go(session, kFatMiddle, kFatMiddle, 50).size(), 1u);
  const Vec3 out = top + Vec3(0, 0, 0.001);
  const int short_ticks = 2 * static_cast<int>(StructureWatch::kOutSteps) - 10;
  EXPECT_TRUE(go(session, out, out, short_ticks).empty());
  EXPECT_TRUE(go(session, just_under, just_under, 100).empty()) << "it is in it still";
  EXPECT_EQ(go(session, out, out, 100).size(), 1u);
}

TEST(Structures, CartilageAndWhatHasNoInsideAreNotEntered) {
  Session cartilage(fat_case("cartilage"), {});
  EXPECT_TRUE(go(cartilage, kFatMiddle - kAcrossFat, kFatMiddle + kAcrossFat, 500).empty());
  Session open(fat_case("fat", true), {});
  EXPECT_TRUE(go(open, kFatMiddle - kAcrossFat, kFatMiddle + kAcrossFat, 500).empty());
}

TEST(Structures, WhatIsFeltHasEventsOfItsOwn) {
  const auto the_case = testing::band_case();
  const auto told = [&](std::span<const std::uint32_t> felt) {
    StructureWatch watch(*the_case);
    watch.add_softs(*the_case, felt);
    ToolState tool;
    tool.tick = 1;
    tool.X_WP.p = testing::kBandMiddle;
    BoneSnapshot bones = rest_snapshot(*the_case);
    bones.step = 2;
    InsideList list{};
    watch.look(tool, bones, list);
    return list[0].kind == SubjectKind::kSoftPart;
  };
  const std::uint32_t band = 0;
  EXPECT_TRUE(told({}));
  EXPECT_FALSE(told(std::span(&band, 1)));
}

TEST(Structures, ASoftPartMovesWithItsBone) {
  const auto the_case = fat_case();
  StructureWatch watch(*the_case);
  watch.add_softs(*the_case, {});
  ToolState tool;
  tool.tick = 1;
  tool.X_WP.p = kFatMiddle;
  BoneSnapshot bones = rest_snapshot(*the_case);
  bones.step = 2;
  bones.bones[0].X_WB.p += Vec3(0.05, 0, 0);
  InsideList list{};
  watch.look(tool, bones, list);
  EXPECT_EQ(list, InsideList{});
  tool.X_WP.p += Vec3(0.05, 0, 0);
  watch.look(tool, bones, list);
  EXPECT_EQ(list[0].kind, SubjectKind::kSoftPart);
  EXPECT_EQ(list[0].subject, 0u);
}

TEST(Structures, APoseThatIsNoNumberOrNotThereYetIsLookedPast) {
  const auto the_case = fat_case();
  StructureWatch watch(*the_case);
  watch.add_softs(*the_case, {});
  BoneSnapshot bones = rest_snapshot(*the_case);
  bones.step = 2;
  InsideList list{};
  ToolState tool;
  tool.X_WP.p = kFatMiddle;
  watch.look(tool, bones, list);
  tool.tick = 1;
  tool.X_WP.p.x() = std::nan("");
  watch.look(tool, bones, list);
  EXPECT_EQ(list, InsideList{});
}

// A drill goes 3 mm into a block and is drawn out again.
TEST(Structures, ADrilledBoneIsEnteredAndLeft) {
  const testing::Drilling drilling;
  Session session = drilling.session();
  std::vector<Event> told;
  const auto hear = [&] {
    for (const Event& event : session.last_events())
      if (is_told(event)) told.push_back(event);
  };
  for (std::uint64_t n = 1; n <= 1200; ++n) {
    const HandInput hand = testing::down_at(n, 1);
    (void)session.tick(hand.input, hand.command);
    hear();
  }
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].kind, EventKind::kStructureEntered);
  EXPECT_EQ(told[0].subject_kind, SubjectKind::kBone);
  EXPECT_EQ(told[0].subject, 0u);
  const double deepest_mm = (testing::kTop_m - session.tool_state().X_WP.p.z()) * 1e3;
  EXPECT_GT(deepest_mm, 1);
  for (std::uint64_t n = 1; n <= 600; ++n) {
    (void)session.tick(tip_at(session.tool_state().X_WD.p + Vec3(0, 0, 2e-5)));
    hear();
  }
  ASSERT_EQ(told.size(), 2u);
  EXPECT_EQ(told[1].kind, EventKind::kStructureLeft);
  EXPECT_NEAR(told[1].values[1], deepest_mm, 0.1);
}

TEST(Structures, EachHandHasItsOwn) {
  SessionSettings settings;
  settings.hands = {{"left", 0}, {"right", 0}};
  Session session(fat_case(), settings);
  std::vector<std::pair<std::size_t, std::uint32_t>> told;
  for (int n = 0; n < 100; ++n) {
    const HandInput inputs[] = {{tip_at(kBallMiddle), {}}, {tip_at(kFatMiddle), {}}};
    (void)session.tick(inputs);
    for (std::size_t h = 0; h < 2; ++h)
      for (const Event& event : session.last_events(h))
        if (is_told(event)) {
          EXPECT_EQ(event.hand, h);
          told.push_back({h, event.subject});
        }
  }
  EXPECT_EQ(told, (std::vector<std::pair<std::size_t, std::uint32_t>>{{0, 1}, {1, 0}}));
}

TEST(Structures, ARunWithoutThemIsAsItWasBeforeThereWereAny) {
  SessionSettings settings;
  settings.structures = false;
  Session session(fat_case(), settings);
  EXPECT_TRUE(go(session, kFatMiddle - kAcrossFat, kFatMiddle + kAcrossFat, 500).empty());
  EXPECT_EQ(session.save().hands[0].watch.inside, InsideList{});
  const std::string text = to_json(settings);
  EXPECT_FALSE(parse_settings(text)->structures);
  const std::size_t from = text.find("  \"structures\"");
  ASSERT_NE(from, std::string::npos);
  const std::string older = text.substr(0, from) + text.substr(text.find('\n', from) + 1);
  EXPECT_FALSE(parse_settings(older)->structures);
  settings.structures = true;
  EXPECT_TRUE(parse_settings(to_json(settings))->structures);
}

// A recording of a case that was opened without its soft parts, repeated with them.
TEST(Structures, ARunThatKnewNoSoftPartsTellsNoneInAReplayThatHasThem) {
  SessionSettings settings;
  settings.soft_structures = false;
  Session session(fat_case(), settings);
  EXPECT_TRUE(go(session, kFatMiddle - kAcrossFat, kFatMiddle + kAcrossFat, 500).empty());
  Case bare = *fat_case();
  bare.softs.clear();
  Session without(std::make_shared<const Case>(bare), settings);
  (void)go(without, kFatMiddle - kAcrossFat, kFatMiddle + kAcrossFat, 500);
  EXPECT_EQ(session.state_hash(), without.state_hash());
  EXPECT_FALSE(parse_settings(to_json(settings))->soft_structures);
}

// A state in the middle of a passage: what was entered is left later, once, and by both.
TEST(Structures, AStateGoesOnAsItWasAndATickAllocatesNothing) {
  Session session(fat_case(), {});
  EXPECT_EQ(go(session, kFatMiddle - kAcrossFat, kFatMiddle, 1000).size(), 1u);
  Session other(fat_case(), {});
  const auto state = state_from_bytes(to_bytes(session.save()));
  ASSERT_TRUE(state);
  ASSERT_TRUE(other.restore(*state));
  EXPECT_EQ(other.state_hash(), session.state_hash());
  const std::uint64_t before = testing::allocations();
  for (int n = 0; n < 100; ++n) (void)session.tick(tip_at(kFatMiddle));
  EXPECT_EQ(testing::allocations(), before);
  for (int n = 0; n < 100; ++n) (void)other.tick(tip_at(kFatMiddle));
  const auto first = go(session, kFatMiddle, kFatMiddle + kAcrossFat, 1000);
  const auto second = go(other, kFatMiddle, kFatMiddle + kAcrossFat, 1000);
  ASSERT_EQ(first.size(), 1u);
  EXPECT_EQ(first, second);
  EXPECT_EQ(first[0].kind, EventKind::kStructureLeft);
  EXPECT_EQ(other.state_hash(), session.state_hash());
}

// Going back leaves the hand where its device is, and so in what it is in.
TEST(Structures, GoingBackTellsNothing) {
  Session session(fat_case(), {});
  (void)session.tick(tip_at(kFatMiddle + Vec3(0, 0, 0.02)), {CommandKind::kMark, 0});
  EXPECT_EQ(go(session, kFatMiddle, kFatMiddle, 100).size(), 1u);
  (void)session.tick(tip_at(kFatMiddle), {CommandKind::kRestore, 0});
  EXPECT_TRUE(go(session, kFatMiddle, kFatMiddle, 100).empty());
}

TEST(Structures, AReplayFindsTheSame) {
  const auto the_case = fat_case();
  Session session(the_case, {});
  Recording recording;
  recording.header = recording_header(*the_case, {}, "test", "0");
  std::size_t told = 0;
  for (int n = 1; n <= 2000; ++n) {
    (void)session.tick(tip_at(kFatMiddle + (n / 1000.0 - 1) * kAcrossFat));
    keep_tick(recording, session);
    for (const Event& event : session.last_events()) told += is_told(event) ? 1 : 0;
  }
  recording.complete = true;
  EXPECT_EQ(told, 2u);
  const auto again = replay(recording, the_case);
  ASSERT_TRUE(again) << again.error().message();
  EXPECT_TRUE(again->identical) << again->first_different_tick;
}

}  // namespace
}  // namespace osteon
