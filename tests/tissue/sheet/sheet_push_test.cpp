// The law of a push against the balance that it stands for.
#include "osteon/tissue/sheet_push.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/tissue/sheet_balance.h"

namespace osteon {
namespace {

TEST(SheetPush, WithoutAPushThereIsNoForceAndBadNumbersGiveNone) {
  EXPECT_EQ(push_sheet({}, 0).force_n, 0);
  EXPECT_EQ(push_sheet({0, 0.2, 0.012, 2000}, 0.005).force_n, 0);
  EXPECT_EQ(push_sheet({NAN, 0.2, 0.012, 2000}, 0.005).force_n, 0);
  EXPECT_EQ(pushed_by({}, -1), 0);
  EXPECT_NEAR(push_sheet({}, -0.001).force_n, -0.4, 1e-12);
}

TEST(SheetPush, IsTheBalanceOfTheSheetAtEveryDepth) {
  const SkinSheet sheet = std::move(*SkinSheet::make(0.05, 0.05, 0.00125, {}));
  const SheetBalance balance(sheet, split(sheet, whole_sheet(sheet)));
  const FatShare share = FatShare::of(sheet);
  for (const double radius : {0.001, 0.0017, 0.0027, 0.0045}) {
    const SheetLoad load = load_on(balance.split(), {{0.0003, 0.0004}, radius});
    const double k = balance.stiffness(load);
    const SheetPush push{k, share.at(radius, k), sheet.material().fat_m, 1e9};
    SheetDent dent;
    for (const double deep : {0.001, 0.003, 0.006, 0.009, 0.0105}) {
      dent = balance.pressed_by(load, deep, dent);
      EXPECT_NEAR(push_sheet(push, deep).force_n / dent.force_n, 1, deep < 0.010 ? 0.05 : 0.1)
          << radius << " " << deep;
    }
  }
}

// Where less of the sheet is under tension, the fat below is as it was.
TEST(SheetPush, BesideACutItIsTheBalanceToo) {
  const SkinSheet sheet = std::move(*SkinSheet::make(0.04, 0.04, 0.00125, {}));
  SheetCuts cuts = whole_sheet(sheet);
  begin_stroke(sheet, cuts, {-0.007, 0});
  (void)end_stroke(sheet, cuts, {0.007, 0.001}, 0.006);
  const SheetBalance balance(sheet, split(sheet, cuts));
  const FatShare share = FatShare::of(sheet);
  for (const SheetPoint& p : {SheetPoint(0, 0.0035), SheetPoint(0.004, -0.006)}) {
    const SheetLoad load = load_on(balance.split(), {p, 0.0025});
    const double k = balance.stiffness(load);
    const SheetPush push{k, share.at(0.0025, k), sheet.material().fat_m, 1e9};
    for (const double deep : {0.001, 0.003, 0.006})
      EXPECT_NEAR(push_sheet(push, deep).force_n / balance.pressed_by(load, deep).force_n, 1, 0.06)
          << p.transpose() << " " << deep;
  }
}

TEST(SheetPush, OverAThinnerCoverTheFatAloneBearsMore) {
  const SheetPush usual{400, 0.2, 0.012, 2000};
  for (const double none : {0.0, -1.0, double(NAN), 0.012})
    EXPECT_EQ(over_cover(usual, none).stiffness_n_per_m, 400) << none;
  const SheetPush thin = over_cover(usual, 0.004);
  EXPECT_NEAR(thin.stiffness_n_per_m * (1 - thin.share), 320, 1e-9) << "of the membrane";
  EXPECT_NEAR(thin.stiffness_n_per_m * thin.share, 240, 1e-9);
  EXPECT_EQ(thin.fat_m, 0.004);
  EXPECT_EQ(thin.most_n_per_m, 2000);
  for (double deep = 0.0005; deep < 0.010; deep += 0.0005) {
    EXPECT_GT(push_sheet(thin, deep).force_n, push_sheet(usual, deep).force_n) << deep;
    EXPECT_LE(push_sheet(thin, deep).stiffness_n_per_m, 2000 * (1 + 1e-12)) << deep;
  }
}

TEST(SheetPush, ItsSlopeIsTheForcesAndIsBounded) {
  const SheetPush push{400, 0.22, 0.012, 1500};
  double before = -1;
  for (double deep = 0.0001; deep < 0.03; deep += 0.0001) {
    const SheetTouch touch = push_sheet(push, deep);
    const double h = 1e-8;
    const double slope =
        (push_sheet(push, deep + h).force_n - push_sheet(push, deep - h).force_n) / (2 * h);
    EXPECT_NEAR(touch.stiffness_n_per_m / slope, 1, 1e-4) << deep;
    EXPECT_LE(touch.stiffness_n_per_m, 1500 * (1 + 1e-12));
    EXPECT_GT(touch.force_n, before);
    before = touch.force_n;
    EXPECT_NEAR(pushed_by(push, touch.force_n), deep, 1e-12);
  }
}

TEST(SheetPush, ASheetStifferThanTheHandIsAsStiffAsTheHand) {
  const SheetPush push{400, 0.22, 0.012, 300};
  EXPECT_NEAR(push_sheet(push, 0.002).force_n, 0.6, 1e-12);
  EXPECT_NEAR(push_sheet(push, 0.002).stiffness_n_per_m, 300, 1e-12);
}

}  // namespace
}  // namespace osteon
