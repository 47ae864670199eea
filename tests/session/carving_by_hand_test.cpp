// What removes bone without a motor, or with a blade: awl, curette, shaver, osteotome, punch.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drilling.h"
#include "osteon/carve/removed.h"

namespace osteon {
namespace {

using testing::Drilling;
using testing::kTop_m;

double removed_mm3(const Session& session) {
  return 1e9 * total(removed_volume(*session.carving()->field(0)));
}

// The tool stands over the middle of the block's top, its shaft upwards, and is pressed on it.
struct Hand {
  double press_m = 0.003;  // the hand wants the tip so far under the top
  double draw_m = 0;       // to and fro along x
  double twist_rad = 0;    // to and fro about the shaft
  double lean_rad = 0;     // of the shaft about x: -pi/2 lays it along -y, +y of Tool downwards
  double power = 0;
  double jaw = -1;  // opened at first and shut later; below 0: not at all
};

double removed_by(const std::string& instrument, const Hand& hand, int ticks = 2500) {
  const Drilling with(instrument);
  Session session = with.session();
  for (int n = 1; n <= ticks; ++n) {
    HandInput input;
    const double t = 0.001 * n, phase = 2 * std::numbers::pi * 2 * t;
    const double z = std::max(0.002 - 0.02 * t, -hand.press_m);
    const double x = hand.draw_m * std::sin(phase);
    input.input.X_WD.p = {x, 0, kTop_m + z};
    input.input.v_W = {hand.draw_m * 4 * std::numbers::pi * std::cos(phase), 0, 0};
    input.input.X_WD.q = Quat(Eigen::AngleAxisd(hand.lean_rad, Vec3::UnitX())) *
                         Quat(Eigen::AngleAxisd(hand.twist_rad * std::sin(phase), Vec3::UnitZ()));
    if (n == 2) input.command = {CommandKind::kPower, hand.power};
    if (hand.jaw >= 0 && n == 3) input.command = {CommandKind::kJaw, 1};
    if (hand.jaw >= 0 && n == 1500) input.command = {CommandKind::kJaw, 0};
    (void)session.tick(std::span(&input, 1));
  }
  return removed_mm3(session);
}

TEST(CarvingByHand, AnAwlGoesInWhereItIsPushedAndTurned) {
  const double still = removed_by("awl:8", {});
  const double turned = removed_by("awl:8", {.twist_rad = 0.8});
  EXPECT_LT(still, 0.5);
  EXPECT_GT(turned, still + 1);
}

TEST(CarvingByHand, ACuretteRemovesWhatItIsDrawnAlong) {
  const Hand facing{.lean_rad = -std::numbers::pi / 2};
  Hand drawn = facing;
  drawn.draw_m = 0.003;
  EXPECT_EQ(removed_by("bone_curette:3", facing), 0);
  EXPECT_GT(removed_by("bone_curette:3", drawn), 0.05);
  // With its back it only slides.
  drawn.lean_rad = std::numbers::pi / 2;
  EXPECT_EQ(removed_by("bone_curette:3", drawn), 0);
}

TEST(CarvingByHand, AnOsteotomeGoesInByTheBlowsOnIt) {
  const double pushed = removed_by("osteotome:4", {});
  const double struck = removed_by("osteotome:4", {.power = 1});
  EXPECT_LT(pushed, 1);
  EXPECT_GT(struck, pushed + 2);
}

TEST(CarvingByHand, AShaversWindowGripsBoneALittle) {
  Hand hand{.lean_rad = -std::numbers::pi / 2, .power = 1};
  const double facing = removed_by("shaver:3.5", hand);
  EXPECT_GT(facing, 0.05);
  EXPECT_LT(facing, 20);
  hand.lean_rad = std::numbers::pi / 2;
  EXPECT_EQ(removed_by("shaver:3.5", hand), 0);
}

TEST(CarvingByHand, APinGoesIn) {
  EXPECT_EQ(removed_by("guide_pin:2", {}), 0);
  EXPECT_GT(removed_by("guide_pin:2", {.power = 1}), 3);
}

// Every instrument whose file says how it removes bone can be taken.
TEST(CarvingByHand, AllThatRemoveCanBeMade) {
  const auto all = load_instruments();
  ASSERT_TRUE(all);
  const auto the_case = testing::drilled_block();
  std::vector<std::string> tray;
  for (const Instrument& instrument : *all)
    if (has_effect(instrument, InstrumentFunction::kRemove)) tray.push_back(instrument.name);
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
