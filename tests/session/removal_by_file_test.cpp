// What an instrument's file says of how it removes bone: a pin, and all that can be made.
#include <gtest/gtest.h>

#include <algorithm>

#include "drilling.h"
#include "osteon/carve/removed.h"

namespace osteon {
namespace {

using testing::Drilling;
using testing::kTop_m;

double gone_mm3(const Session& session) {
  return 1e9 * total(removed_volume(*session.carving()->field(0)));
}

// Straight down on the block's top.
double removed_by(const std::string& instrument, double power, int ticks = 1500) {
  const Drilling with(instrument);
  Session session = with.session();
  for (int n = 1; n <= ticks; ++n) {
    HandInput input;
    input.input.X_WD.p = {0, 0, kTop_m + std::max(0.002 - 0.00002 * n, -0.003)};
    if (n == 2) input.command = {CommandKind::kPower, power};
    (void)session.tick(std::span(&input, 1));
  }
  return gone_mm3(session);
}

TEST(RemovalByFile, APinGoesIn) {
  EXPECT_EQ(removed_by("guide_pin:2", 0), 0);
  EXPECT_GT(removed_by("guide_pin:2", 1), 1);
}

// Every instrument whose file says how it removes bone can be taken.
TEST(RemovalByFile, AllThatRemoveCanBeMade) {
  const auto all = load_instruments();
  ASSERT_TRUE(all);
  const auto the_case = testing::drilled_block();
  std::vector<std::string> tray;
  for (const Instrument& instrument : *all)
    if (instrument.removal) tray.push_back(instrument.name);
  EXPECT_EQ(tray.size(), 10u);
  EXPECT_TRUE(can_carve(*the_case, tray));
  EXPECT_FALSE(can_carve(*the_case, std::vector<std::string>{"hook_probe", "rongeur"}));
  CarveSettings settings;
  settings.on = true;
  settings.cell_m = 0.001;
  const auto made = make_carving(*the_case, tray, settings);
  ASSERT_TRUE(made) << made.error().message();
  for (const auto& tool : (*made)->tray) EXPECT_TRUE(tool.has_value());
}

}  // namespace
}  // namespace osteon
