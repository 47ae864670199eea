// The lips of a cut, against the balance that is solved at once and one that is solved otherwise.
#include "osteon/tissue/sheet_lips.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tissue/sheet/lip_oracle.h"
#include "tissue/sheet/sheet_checks.h"

namespace osteon {
namespace {

SkinSheet lip_sheet(double edge_m = 0.0012) {
  return std::move(*SkinSheet::make(0.030, 0.036, edge_m, {}));
}

SheetCuts slit_along_x(const SkinSheet& sheet, double half_m) {
  SheetCuts cuts = whole_sheet(sheet);
  begin_stroke(sheet, cuts, {-half_m, 0});
  (void)end_stroke(sheet, cuts, {half_m, 0}, 0.006);
  return cuts;
}

struct Lips {
  std::shared_ptr<const SheetYield> yields;
  std::unique_ptr<const SheetLips> lips;
  Lips(const SkinSheet& sheet, const SheetCuts& cuts) {
    SheetWork work(sheet, cuts);
    while (!work.step()) {
    }
    yields = work.take();
    LipWork more(yields);
    while (!more.step()) {
    }
    lips = more.take();
  }
};

// The tension that a cut has set free, put on its lips, moves them as the cut did.
TEST(SheetLips, PushedWithTheTensionThatTheyHaveLostTheyMoveAsTheyOpened) {
  const SkinSheet sheet = lip_sheet();
  SheetCuts cuts = slit_along_x(sheet, 0.008);
  begin_stroke(sheet, cuts, {0.001, -0.009});
  (void)end_stroke(sheet, cuts, {-0.002, 0.010}, 0.006);
  const Lips of(sheet, cuts);
  ASSERT_GT(of.lips->edges().size(), 20u);
  ASSERT_EQ(of.lips->ends().size(), 4u);
  const SheetBalance balance(sheet, split(sheet, cuts));
  const double tension = sheet.material().tension_n_per_m;
  double most = 0;
  for (std::size_t i = 0; i < of.lips->count(); ++i) {
    SheetPoint way = SheetPoint::Zero();
    for (const SheetLips::Edge& edge : of.lips->edges())
      for (std::size_t side = 0; side < 2; ++side) {
        const SheetPoint left(-edge.way.y(), edge.way.x());
        const SheetPoint force = (side == 0 ? 0.5 : -0.5) * tension * left;
        for (const std::uint32_t lip : edge.sides[side].lip) way += of.lips->yields(i, lip) * force;
      }
    most = std::max(most, way.norm());
    EXPECT_NEAR((way - balance.ways()[of.lips->copy(i)]).norm(), 0, 1e-12) << i;
  }
  EXPECT_GT(most, 0.0003);
}

// A flat blade as a row of discs.
std::vector<LipDisc> blade_at(double y_m, double half_m) {
  std::vector<LipDisc> out;
  for (int i = -2; i <= 2; ++i) out.push_back({{0.5 * i * half_m, y_m}, 0.0005, 0});
  return out;
}

double force_n(const LipPushes& pushes) {
  SheetPoint sum = SheetPoint::Zero();
  for (const LipPush& push : pushes.list()) sum += push.force_n * push.out;
  EXPECT_LT(std::abs(sum.x()), 0.05 * std::abs(sum.y()) + 1e-9);
  return sum.y();
}

TEST(SheetLips, ABladeThatIsDrawnAsideIsPressedAsOneThatHoldsTheLipsVertices) {
  const SkinSheet sheet = lip_sheet();
  const SheetCuts cuts = slit_along_x(sheet, 0.010);
  const Lips of(sheet, cuts);
  LipOracle oracle(sheet, cuts);
  LipPushes pushes;
  press_lips(*of.lips, blade_at(0, 0.005), 1e9, pushes);
  EXPECT_EQ(force_n(pushes), 0);  // the cut stands open by more than that
  for (const double y_m : {0.002, 0.004, 0.006}) {
    press_lips(*of.lips, blade_at(y_m, 0.005), 1e9, pushes);
    EXPECT_NEAR(force_n(pushes) / oracle.force_n(y_m + 0.0005, 0.005), 1, 0.05) << y_m;
    EXPECT_GT(force_n(pushes), 1);
  }
}

// No disc stands in a lip, none pulls, and lips that are pushed lie on their discs: by the whole
// sheet under those forces, not by the table that they were found with.
TEST(SheetLips, ManyDiscsPushAndNoneStandsInALip) {
  const SkinSheet sheet = lip_sheet();
  const SheetCuts cuts = slit_along_x(sheet, 0.010);
  const Lips of(sheet, cuts);
  std::vector<LipDisc> discs = blade_at(0.004, 0.005);
  discs.push_back({{0.007, -0.002}, 0.00275, 1});
  discs.push_back({{-0.009, 0.0005}, 0.001, 2});
  LipPushes pushes;
  const double surface = 5000;
  press_lips(*of.lips, discs, surface, pushes);
  std::vector<SheetPull> pulls;
  for (const LipPush& push : pushes.list())
    for (std::size_t k = 0; k < 2; ++k)
      pulls.push_back({of.lips->copy(push.lip[k]), push.share[k] * push.force_n * push.out});
  const std::vector<SheetPoint> ways = of.yields->pulled(pulls);
  std::array<std::size_t, 3> push_of{};
  for (const LipPush& push : pushes.list()) {
    SheetPoint way = SheetPoint::Zero();
    for (std::size_t k = 0; k < 2; ++k) way += push.share[k] * ways[of.lips->copy(push.lip[k])];
    EXPECT_NEAR(push.out.dot(way), push.moved_m, 1e-9);
    EXPECT_GE(push.force_n, 0);
    const double stands_in = push.deep_m - push.moved_m - push.force_n / surface;
    EXPECT_LT(stands_in, 1e-7);
    if (push.force_n > 0) {
      EXPECT_NEAR(stands_in, 0, 1e-7);
      ++push_of[push.hand];
    }
  }
  for (const std::size_t count : push_of) EXPECT_GT(count, 0u);
}

// Along the slit the force changes as the disc's place does: between vertices, and at its end.
TEST(SheetLips, ADiscThatGoesAlongALipMeetsNoSteps) {
  const SkinSheet sheet = lip_sheet();
  const Lips of(sheet, slit_along_x(sheet, 0.010));
  LipPushes pushes;
  double before = 0, most = 0, steepest = 0;
  for (int i = 0; i <= 2000; ++i) {
    const std::array disc{LipDisc{{-0.008 + 1e-5 * i, 0.003}, 0.001, 0}};
    press_lips(*of.lips, disc, 5000, pushes);
    SheetPoint sum = SheetPoint::Zero();
    for (const LipPush& push : pushes.list()) sum += push.force_n * push.out;
    if (i > 0) steepest = std::max(steepest, std::abs(sum.norm() - before));
    before = sum.norm();
    most = std::max(most, before);
  }
  EXPECT_GT(most, 1);
  EXPECT_LT(steepest, 0.02 * most);
}

}  // namespace
}  // namespace osteon
