// Bone removed in a session: a drill goes into a block that is felt as a field.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "osteon/carve/removed.h"
#include "osteon/physics/carving.h"
#include "osteon/physics/carving_setup.h"
#include "osteon/scene/carve_events.h"
#include "osteon/scene/instrument.h"
#include "osteon/scene/tool_set.h"
#include "osteon/session/session.h"
#include "session_fixtures.h"

namespace osteon {
namespace {

using testing::box_mesh;

constexpr double kTop_m = 0.004;  // of the block

std::shared_ptr<const Case> block() {
  CaseDef def;
  def.name = "block";
  BoneDef bone;
  bone.name = "block";
  bone.mesh = box_mesh(Vec3(0.005, 0.005, kTop_m));
  bone.felt = Felt::kField;
  def.bones.push_back(bone);
  auto built = build_case(std::move(def));
  EXPECT_TRUE(built);
  return std::make_shared<const Case>(std::move(*built));
}

struct Drilling {
  std::shared_ptr<const Case> the_case = block();
  SessionSettings settings;
  Tray tray;
  std::shared_ptr<const CarvingSetup> setup;

  explicit Drilling(const std::string& instrument = "drill:3.2") {
    settings.tray = {instrument};
    settings.carve.on = true;
    settings.carve.cell_m = 0.0004;
    settings.haptic.max_force_n = 8;
    const auto all = load_instruments();
    EXPECT_TRUE(all);
    const auto name = parse_tool_name(instrument);
    const Instrument* found = find_instrument(*all, name->name);
    tray.push_back(std::make_shared<const Tool>(
        make_tool(*found, *find_size(*found, name->size_mm.value_or(3.2)))));
    auto made = make_carving(*the_case, settings.tray, settings.carve);
    EXPECT_TRUE(made);
    setup = *made;
  }
  Session session() const { return Session(the_case, settings, tray, setup); }
};

// Straight down on the block's top from 1 mm above, `speed` fast, to `deepest` under it.
HandInput down_at(std::uint64_t n, double power, double speed = 0.02, double deepest = 0.003) {
  HandInput hand;
  const double z = std::max(0.001 - speed * 0.001 * static_cast<double>(n), -deepest);
  hand.input.X_WD.p = {0.0003, 0.0002, kTop_m + z};
  if (n == 2) hand.command = {CommandKind::kPower, power};
  return hand;
}

void run(Session& session, std::uint64_t from, std::uint64_t to, double power,
         std::vector<Event>* events = nullptr) {
  for (std::uint64_t n = from; n <= to; ++n) {
    const HandInput hand = down_at(n, power);
    (void)session.tick(std::span(&hand, 1));
    if (events)
      for (const Event& event : session.last_events()) events->push_back(event);
  }
}

double removed_mm3(const Session& session) {
  return 1e9 * total(removed_volume(*session.carving()->field(0)));
}

TEST(Carving, ADrillThatDoesNotTurnRemovesNothing) {
  const Drilling with;
  Session session = with.session();
  run(session, 1, 1500, 0);
  EXPECT_EQ(removed_mm3(session), 0);
  EXPECT_GT(session.tool_state().force_W.z(), 5);
}

// What is gone is the drill's point and shank down to where the tip stands, and no more: the tip
// follows what was removed.
TEST(Carving, ADrillGoesInByWhatItRemovesAndFeelsItsHole) {
  const Drilling with;
  Session session = with.session();
  std::vector<Event> events;
  run(session, 1, 6000, 1, &events);
  const double depth = kTop_m - session.tool_state().X_WP.p.z();
  ASSERT_GT(depth, 0.001);
  const double r = 0.0016, cone = r / std::tan(59 * std::numbers::pi / 180);
  const double wanted =
      std::numbers::pi * r * r * (std::max(0.0, depth - cone) + std::min(depth, cone) / 3) * 1e9;
  EXPECT_NEAR(removed_mm3(session), wanted, 0.1 * wanted + 0.3);
  EXPECT_TRUE(std::any_of(events.begin(), events.end(),
                          [](const Event& e) { return e.kind == kCutBegin; }));
  EXPECT_TRUE(std::any_of(events.begin(), events.end(),
                          [](const Event& e) { return e.kind == kCortexEntered; }));
  // Pulled sideways the wall holds it.
  HandInput aside = down_at(6000, 1);
  aside.input.X_WD.p.x() += 0.002;
  for (int i = 0; i < 400; ++i) (void)session.tick(std::span(&aside, 1));
  EXPECT_LT(std::abs(session.tool_state().X_WP.p.x() - 0.0003), 0.0004);
  EXPECT_LT(session.tool_state().force_W.x(), -1);
}

TEST(Carving, AStateGivesTheSameBitsAfterwards) {
  const Drilling with;
  Session session = with.session();
  run(session, 1, 2500, 1);
  ASSERT_GT(removed_mm3(session), 1);
  const auto back = state_from_bytes(to_bytes(session.save()));
  ASSERT_TRUE(back) << back.error().message();
  Session other = with.session();
  ASSERT_TRUE(other.restore(*back));
  EXPECT_EQ(other.state_hash(), session.state_hash());
  run(session, 2501, 3500, 1);
  run(other, 2501, 3500, 1);
  EXPECT_EQ(other.state_hash(), session.state_hash());
  EXPECT_EQ(other.tool_state().force_W, session.tool_state().force_W);
}

TEST(Carving, ARestorePointPutsTheBoneBack) {
  const Drilling with;
  Session session = with.session();
  HandInput mark = down_at(1, 0);
  mark.command = {CommandKind::kMark, 0};
  (void)session.tick(std::span(&mark, 1));
  run(session, 2, 3000, 1);
  ASSERT_GT(removed_mm3(session), 1);
  HandInput back = down_at(3000, 0);
  back.command = {CommandKind::kRestore, 0};
  (void)session.tick(std::span(&back, 1));
  HandInput above = down_at(0, 0);
  for (int i = 0; i < 200; ++i) (void)session.tick(std::span(&above, 1));
  EXPECT_EQ(removed_mm3(session), 0);
  // And it is felt whole again.
  run(session, 3, 1500, 0);
  EXPECT_GT(session.tool_state().X_WP.p.z(), kTop_m - 0.0002);
}

// A burr's origin is the middle of its ball.
TEST(Carving, ABurrRemovesWhereItIsPressed) {
  const Drilling with("microdrill:3");
  Session session = with.session();
  for (std::uint64_t n = 1; n <= 1500; ++n) {
    HandInput hand = down_at(n, 0.5);
    hand.input.X_WD.p.z() += 0.0015;
    (void)session.tick(std::span(&hand, 1));
  }
  EXPECT_GT(removed_mm3(session), 3);
  EXPECT_LT(session.tool_state().X_WP.p.z(), kTop_m + 0.0005);
}

TEST(Carving, SettingsComeBackFromTheirText) {
  SessionSettings settings;
  settings.carve = {true, 0.0003, 0.002, 0.01, 12};
  const auto back = parse_settings(to_json(settings));
  ASSERT_TRUE(back) << back.error().message();
  EXPECT_TRUE(back->carve.on);
  EXPECT_EQ(back->carve.cell_m, 0.0003);
  EXPECT_EQ(back->carve.thrust_scale, 12);
  settings.carve.cell_m = -1;
  EXPECT_FALSE(parse_settings(to_json(settings)));
}

}  // namespace
}  // namespace osteon
