// The balance made in pieces, against the one that is solved at once by Eigen.
#include "osteon/tissue/sheet_work.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tissue/sheet/sheet_checks.h"

namespace osteon {
namespace {

std::unique_ptr<const SheetYield> yield_of(const SkinSheet& sheet, const SheetCuts& cuts,
                                           int* pieces = nullptr) {
  SheetWork work(sheet, cuts);
  int n = 1;
  while (!work.step()) ++n;
  if (pieces) *pieces = n;
  return work.take();
}

SkinSheet portal_sheet() { return std::move(*SkinSheet::make(0.030, 0.036, 0.0012, {})); }

SheetCuts cut_cross(const SkinSheet& sheet) {
  SheetCuts cuts = whole_sheet(sheet);
  for (const auto& [from, to] :
       {std::pair<SheetPoint, SheetPoint>{{-0.008, -0.002}, {0.007, 0.003}},
        {{0.001, -0.009}, {-0.002, 0.010}}}) {
    begin_stroke(sheet, cuts, from);
    (void)end_stroke(sheet, cuts, to, 0.006);
  }
  return cuts;
}

TEST(SheetWork, OfAWholeSheetNothingMovesAndItIsAsStiffAsSolvedAtOnce) {
  const SkinSheet sheet = portal_sheet();
  const auto yield = yield_of(sheet, whole_sheet(sheet));
  for (const SheetPoint& way : yield->ways()) EXPECT_EQ(way.norm(), 0);
  const SheetBalance balance(sheet, split(sheet, whole_sheet(sheet)));
  SheetScratch scratch;
  for (const double radius : {0.0005, 0.0015, 0.0027})
    for (const SheetPoint& p : {SheetPoint(0, 0), SheetPoint(0.004, -0.007)}) {
      const double k = balance.stiffness(load_on(balance.split(), {p, radius}));
      EXPECT_NEAR(yield->stiffness({p, radius}, scratch) / k, 1, 0.01) << radius;
    }
}

TEST(SheetWork, ACutSheetOpensAndGivesWayAsSolvedAtOnce) {
  const SkinSheet sheet = portal_sheet();
  const SheetCuts cuts = cut_cross(sheet);
  int pieces = 0;
  const auto yield = yield_of(sheet, cuts, &pieces);
  const SheetBalance balance(sheet, split(sheet, cuts));
  ASSERT_EQ(yield->ways().size(), balance.ways().size());
  double widest_m = 0;
  for (std::size_t i = 0; i < yield->ways().size(); ++i) {
    EXPECT_NEAR((yield->ways()[i] - balance.ways()[i]).norm(), 0, 1e-12);
    widest_m = std::max(widest_m, yield->ways()[i].norm());
  }
  EXPECT_GT(widest_m, 0.0003);
  EXPECT_GT(pieces, 10);
  // The same load, so that the matrices alone are compared.
  const SheetDisc disc{{0.002, 0.004}, 0.0012};
  const SheetLoad load = load_on(balance.split(), disc);
  SheetScratch scratch;
  EXPECT_NEAR(yield->stiffness(disc, scratch) / balance.stiffness(load), 1, 0.01);
  const std::vector<double> dent = yield->dent(disc);
  const SheetDent slight = balance.pressed(load, 1e-4);
  double off = 0, most = 0;
  for (std::size_t i = 0; i < dent.size(); ++i) {
    off = std::max(off, std::abs(1e-4 * dent[i] - slight.down_m[i]));
    most = std::max(most, std::abs(slight.down_m[i]));
  }
  EXPECT_LT(off, 0.01 * most);
}

TEST(SheetWork, ADiscThatIsPartlyOnTheSheetIsFeltAndOneBesideItIsNot) {
  const SkinSheet sheet = portal_sheet();
  const auto yield = yield_of(sheet, whole_sheet(sheet));
  SheetScratch scratch;
  EXPECT_GT(yield->stiffness({{0.0149, 0}, 0.0025}, scratch), 0);
  EXPECT_EQ(yield->stiffness({{0.0300, 0}, 0.0025}, scratch), 0);
  EXPECT_EQ(yield->stiffness({{NAN, 0}, 0.0025}, scratch), 0);
}

TEST(SheetWork, TheSameCutsGiveTheSameBits) {
  const SkinSheet sheet = portal_sheet();
  const auto a = yield_of(sheet, cut_cross(sheet)), b = yield_of(sheet, cut_cross(sheet));
  SheetScratch scratch;
  const SheetDisc disc{{0.001, 0.001}, 0.002};
  EXPECT_EQ(a->stiffness(disc, scratch), b->stiffness(disc, scratch));
  EXPECT_EQ(a->dent(disc), b->dent(disc));
}

}  // namespace
}  // namespace osteon
