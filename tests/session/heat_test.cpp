// How warm a session's bones become: what physics tells, and who draws them works out.
#include <gtest/gtest.h>

#include <optional>

#include "drilling.h"
#include "osteon/physics/heat_pulse.h"

namespace osteon {
namespace {

using namespace testing;

// Gathers pulses after each step, as a report does.
struct Followed {
  HeatPulses pulses;
  HeatOfBones heat;
  std::uint64_t step = 0;

  explicit Followed(const Session& session)
      : pulses(session.carving()->setup()),
        heat(session.carving()->setup().table.heat, session.carving()->setup().table.water) {}
  void see(const Session& session) {
    if (session.bones().step == step) return;
    step = session.bones().step;
    pulses.add(*session.carving(), session.bones(), session.last_step_record().command, 0.002);
    while (const HeatPulse* const pulse = pulses.due()) {
      heat.take(*pulse, [&](std::uint32_t b) { return session.carving()->field(b); });
      pulses.pop();
    }
  }
};

void drill(Session& session, Followed& followed, std::uint64_t ticks) {
  for (std::uint64_t n = 1; n <= ticks; ++n) {
    HandInput hand = down_at(n, 1);
    (void)session.tick(std::span(&hand, 1));
    followed.see(session);
  }
}

TEST(SessionHeat, ABoneThatIsNotDrilledStaysAsItIs) {
  const Drilling with;
  Session session = with.session();
  Followed followed(session);
  for (int n = 0; n < 200; ++n) {
    HandInput hand = down_at(0, 0);
    (void)session.tick(std::span(&hand, 1));
    followed.see(session);
  }
  EXPECT_EQ(followed.heat.bone(0), nullptr);
  EXPECT_EQ(followed.heat.bone(9), nullptr);
  EXPECT_EQ(followed.heat.hottest_c(), 37);
}

TEST(SessionHeat, WhoDrawsIsToldTheSamePulses) {
  const Drilling with;
  Session session = with.session();
  Followed followed(session);
  HeatOfBones drawn(with.setup->table.heat, with.setup->table.water);
  for (std::uint64_t n = 1; n <= 2500; ++n) {
    HandInput hand = down_at(n, 1);
    (void)session.tick(std::span(&hand, 1));
    followed.see(session);
    CutsPatch patch;
    while (session.cuts_feed()->take(patch))
      if (patch.heat)
        drawn.take(*patch.heat, [&](std::uint32_t b) { return session.carving()->field(b); });
  }
  ASSERT_NE(followed.heat.bone(0), nullptr);
  ASSERT_NE(drawn.bone(0), nullptr);
  EXPECT_GT(followed.heat.hottest_c(), 37.5);
  EXPECT_EQ(drawn.hottest_c(), followed.heat.hottest_c());
  EXPECT_EQ(drawn.bone(0)->energy_j(), followed.heat.bone(0)->energy_j());
  EXPECT_EQ(drawn.bone(0)->volume().cells, followed.heat.bone(0)->volume().cells);
}

TEST(SessionHeat, ARestorePointPutsTheTemperaturesBack) {
  const Drilling with;
  Session session = with.session();
  Followed followed(session);
  drill(session, followed, 600);
  HandInput hand = down_at(600, 1);
  hand.command = {CommandKind::kMark, 2};
  (void)session.tick(std::span(&hand, 1));
  followed.see(session);
  const HeatVolume before = followed.heat.bone(0)->volume();
  drill(session, followed, 2500);
  EXPECT_NE(followed.heat.bone(0)->volume().cells, before.cells);
  hand.command = {CommandKind::kRestore, 2};
  for (int n = 0; n < 2; ++n) {  // a tick without a step goes first
    (void)session.tick(std::span(&hand, 1));
    followed.see(session);
    hand.command = {};
  }
  EXPECT_EQ(followed.heat.bone(0)->volume().cells, before.cells);
}

TEST(SessionHeat, IrrigationKeepsTheBoneCooler) {
  Drilling dry, wet;
  wet.with([](CarvingSetup& setup) { setup.irrigation_m3_s = 100 * kM3_s_per_ml_min; });
  // Heat that is in the bone at the end.
  const auto kept_j = [](const Drilling& with) {
    Session session = with.session();
    Followed followed(session);
    drill(session, followed, 3000);
    return followed.heat.bone(0)->energy_j();
  };
  const double without = kept_j(dry), rinsed = kept_j(wet);
  EXPECT_GT(without, 0);
  EXPECT_LT(rinsed, 0.9 * without);
}

TEST(SessionHeat, TheSettingComesBackFromItsText) {
  SessionSettings settings;
  settings.carve.on = true;
  EXPECT_EQ(to_json(settings).find("irrigation"), std::string::npos);
  settings.carve.irrigation_ml_per_min = 60;
  const auto back = parse_settings(to_json(settings));
  ASSERT_TRUE(back) << back.error().message();
  EXPECT_EQ(back->carve.irrigation_ml_per_min, 60);
  settings.carve.irrigation_ml_per_min = 5000;
  EXPECT_FALSE(parse_settings(to_json(settings)));
}

}  // namespace
}  // namespace osteon
