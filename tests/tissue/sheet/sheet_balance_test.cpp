// The balance of a sheet: closed forms of a membrane on a foundation and of a slit under tension.
#include "osteon/tissue/sheet_balance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tissue/sheet/sheet_checks.h"

namespace osteon {
namespace {

SkinSheet sheet_of(double width, double edge, const SheetMaterial& m) {
  return std::move(*SkinSheet::make(width, width, edge, m));
}

// w = p / k (1 - a/l K1(a/l) I0(r/l)) under the disc: of its mean the stiffness follows.
double disc_stiffness(const SheetMaterial& m, double a) {
  const double l = std::sqrt(m.tension_n_per_m / m.foundation_n_per_m3);
  return m.foundation_n_per_m3 * std::numbers::pi * a * a /
         (1 - 2 * std::cyl_bessel_k(1, a / l) * std::cyl_bessel_i(1, a / l));
}

TEST(SheetBalance, WithoutACutNothingMovesAndAllIsUnderTension) {
  const SkinSheet sheet = sheet_of(0.03, 0.002, {});
  const SheetBalance balance(sheet, split(sheet, whole_sheet(sheet)));
  for (const SheetPoint& way : balance.ways()) EXPECT_EQ(way.norm(), 0);
  for (const auto& n : balance.tension()) EXPECT_EQ(n, (std::array<double, 3>{80, 80, 0}));
}

TEST(SheetBalance, ADiscThatIsNotOnTheSheetHasNoLoad) {
  const SkinSheet sheet = sheet_of(0.03, 0.002, {});
  const SplitSheet whole = split(sheet, whole_sheet(sheet));
  EXPECT_TRUE(load_on(whole, {{0.014, 0}, 0.0025}).copy.empty());
  EXPECT_TRUE(load_on(whole, {{NAN, 0}, 0.0025}).copy.empty());
  const SheetLoad load = load_on(whole, {{0.001, 0.002}, 0.0025});
  double sum = 0;
  SheetPoint middle = SheetPoint::Zero();
  for (std::size_t i = 0; i < load.copy.size(); ++i) {
    sum += load.weight[i];
    middle += load.weight[i] * whole.point[load.copy[i]];
  }
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_NEAR((middle - SheetPoint(0.001, 0.002)).norm(), 0, 1e-12);
}

TEST(SheetBalance, ADiscPressedSlightlyIsTheClosedForm) {
  SheetMaterial m;
  for (const double radius : {0.0025, 0.005, 0.01})
    for (const double tension : {30.0, 80.0, 200.0}) {
      m.tension_n_per_m = tension;
      const SkinSheet sheet = sheet_of(0.12, 0.001, m);
      const SheetBalance balance(sheet, split(sheet, whole_sheet(sheet)));
      const double k = balance.stiffness(load_on(balance.split(), {{0.0003, 0.0007}, radius}));
      EXPECT_NEAR(k / disc_stiffness(m, radius), 1, 0.03) << radius << " " << tension;
    }
}

// Of the tissue table: 400 N/m to the hand's 5 mm tip.
TEST(SheetBalance, PalpatedItIsAsStiffAsTheTissueTableSays) {
  const SkinSheet sheet = sheet_of(0.06, 0.0015, {});
  const SheetBalance balance(sheet, split(sheet, whole_sheet(sheet)));
  for (const SheetPoint& p : {SheetPoint(0, 0), SheetPoint(0.01, 0.004), SheetPoint(-0.015, 0.012)})
    EXPECT_NEAR(balance.stiffness(load_on(balance.split(), {p, 0.0025})), 400, 60);
}

// So wide a disc, under so little tension, that each point bears the fat's own pressure.
TEST(SheetBalance, PressedHardItMeetsTheFatThatStiffens) {
  SheetMaterial m;
  m.tension_n_per_m = 1e-3;
  const SkinSheet sheet = sheet_of(0.06, 0.002, m);
  const SheetBalance balance(sheet, split(sheet, whole_sheet(sheet)));
  const SheetLoad load = load_on(balance.split(), {{0, 0}, 0.02});
  constexpr double area = std::numbers::pi * 0.02 * 0.02;
  std::uint32_t middle = 0;
  for (std::uint32_t i = 0; i < load.copy.size(); ++i)
    if (balance.split().point[load.copy[i]].norm() < 0.001) middle = load.copy[i];
  for (const double force : {1.0, 10.0, 100.0, 3000.0}) {
    const SheetDent dent = balance.pressed(load, force);
    const double p = force / area;
    EXPECT_NEAR(dent.down_m[middle], p / (m.foundation_n_per_m3 + p / m.fat_m),
                0.05 * p / (m.foundation_n_per_m3 + p / m.fat_m));
    EXPECT_LT(dent.mean_m, m.fat_m);
    const SheetDent again = balance.pressed_by(load, dent.mean_m);
    EXPECT_NEAR(again.force_n / force, 1, 1e-5);
  }
}

// Maxwell: what a push here does there is what the same push there does here, lips or not.
TEST(SheetBalance, SlightPushesAreReciprocalOverACut) {
  const SkinSheet sheet = sheet_of(0.05, 0.0015, {});
  SheetCuts cuts = whole_sheet(sheet);
  stroke(sheet, cuts, {{-0.01, 0}, {0.01, 0.001}}, 0.005);
  const SheetBalance balance(sheet, split(sheet, cuts));
  const SheetLoad a = load_on(balance.split(), {{0, 0.004}, 0.002}),
                  b = load_on(balance.split(), {{0.003, -0.004}, 0.002});
  const auto way = [](const SheetLoad& load, const SheetDent& dent) {
    double sum = 0;
    for (std::size_t i = 0; i < load.copy.size(); ++i)
      sum += load.weight[i] * dent.down_m[load.copy[i]];
    return sum;
  };
  const double ab = way(b, balance.pressed(a, 1e-6)), ba = way(a, balance.pressed(b, 1e-6));
  EXPECT_GT(ab, 0);
  EXPECT_NEAR(ab / ba, 1, 1e-4);
}

TEST(SheetBalance, ACutMakesItSofterThereAndNotFarFromIt) {
  const SkinSheet sheet = sheet_of(0.08, 0.0015, {});
  SheetCuts cuts = whole_sheet(sheet);
  const SheetBalance whole(sheet, split(sheet, cuts));
  stroke(sheet, cuts, {{-0.006, 0}, {0.006, 0}}, 0.005);
  const SheetBalance open(sheet, split(sheet, cuts));
  const auto share = [&](const SheetPoint& p) {
    return open.stiffness(load_on(open.split(), {p, 0.0025})) /
           whole.stiffness(load_on(whole.split(), {p, 0.0025}));
  };
  EXPECT_LT(share({0, 0.003}), 0.85);
  EXPECT_GT(share({0, 0.003}), 0.2);
  EXPECT_NEAR(share({0, 0.025}), 1, 0.1);
}

// Each lip of a slit of half length a in an endless membrane goes 2 T sqrt(a^2 - x^2) / Eh (plane
// stress: Westergaard 1939), whatever Poisson's ratio. Here the rim is held at 10 a, which takes
// about 2 (a / 10 a)^2 of it, and the fat hardly holds it. Triangles of constant strain are too
// stiff at the ends, in proportion to their size: two sizes tell the answer of none.
TEST(SheetBalance, ASlitUnderTensionOpensAsTheClosedForm) {
  SheetMaterial m;
  m.tether_n_per_m3 = 10;
  constexpr double a = 0.016;
  struct Opening {
    double area = 0, middle = 0;
  };
  const auto with = [&](double edge) {
    const SkinSheet sheet = sheet_of(0.32, edge, m);
    SheetCuts cuts = whole_sheet(sheet);
    stroke(sheet, cuts, {{-a, 0}, {a, 0}}, 0.005);
    const SheetBalance balance(sheet, split(sheet, cuts));
    const double lip = 2 * m.tension_n_per_m * a / m.stretch_n_per_m;
    return Opening{open_area(balance.split(), balance.ways()) / (std::numbers::pi * a * lip),
                   widest(balance.split(), balance.ways()) / (2 * lip)};
  };
  for (const double poisson : {0.0, 0.45}) {
    m.poisson = poisson;
    const Opening coarse = with(0.004), fine = with(0.002);
    EXPECT_GT(fine.area, coarse.area);
    EXPECT_NEAR(fine.middle, 1, 0.08) << poisson;
    EXPECT_NEAR(2 * fine.middle - coarse.middle, 1, 0.04) << poisson;
    const double along = 1 - (1 - poisson) * m.tension_n_per_m / m.stretch_n_per_m;
    EXPECT_NEAR((2 * fine.area - coarse.area) / along, 1, 0.04) << poisson;
  }
}

TEST(SheetBalance, ALipBearsNoTensionAcrossItAndTheEndOfASlitBearsMore) {
  const SkinSheet sheet = sheet_of(0.06, 0.001, {});
  SheetCuts cuts = whole_sheet(sheet);
  stroke(sheet, cuts, {{-0.01, 0}, {0.01, 0}}, 0.005);
  const SheetBalance balance(sheet, split(sheet, cuts));
  const SplitSheet& open = balance.split();
  double lip = 0, end = 0;
  for (std::size_t t = 0; t < open.triangles.size(); ++t) {
    SheetPoint p = SheetPoint::Zero();
    for (const std::uint32_t i : open.triangles[t]) p += open.point[i] / 3;
    if (p.norm() < 0.001) lip = std::max(lip, balance.tension()[t][1]);
    if ((p - SheetPoint(0.0105, 0)).norm() < 0.001) end = std::max(end, balance.tension()[t][1]);
    EXPECT_GE(balance.tension()[t][0], -1e-9);
    EXPECT_GE(balance.tension()[t][1], -1e-9);
  }
  EXPECT_LT(lip, 0.15 * 80);
  EXPECT_GT(end, 1.5 * 80);
}

}  // namespace
}  // namespace osteon
