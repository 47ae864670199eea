// A sheet that is cut by duplicating vertices: a manifold whatever is cut, on the stroke, of the
// same area.
#include "osteon/tissue/skin_sheet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tissue/sheet/random_cuts.h"

namespace osteon {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

SkinSheet sheet_of(double width, double height, double edge, const SheetMaterial& m = {}) {
  return std::move(*SkinSheet::make(width, height, edge, m));
}

double triangle_area(const SplitSheet& split, const Triangle& t) {
  const SheetPoint u = split.point[t[1]] - split.point[t[0]],
                   v = split.point[t[2]] - split.point[t[0]];
  return 0.5 * (u.x() * v.y() - u.y() * v.x());
}

TEST(SkinSheet, RefusesWhatIsNoSheet) {
  const SheetMaterial m;
  for (const auto& [w, h, e] : {std::array{0.0, 0.04, 0.002},
                                {0.04, 0.04, 0.0},
                                {0.04, 0.04, -0.002},
                                {kNan, 0.04, 0.002},
                                {0.04, kNan, 0.002},
                                {0.04, 0.04, kNan},
                                {0.04, 0.04, 0.02},
                                {10.0, 0.04, 0.002}})
    EXPECT_FALSE(SkinSheet::make(w, h, e, m)) << w << " " << h << " " << e;
  for (double SheetMaterial::*field :
       {&SheetMaterial::stretch_n_per_m, &SheetMaterial::tension_n_per_m,
        &SheetMaterial::tether_n_per_m3, &SheetMaterial::fat_m, &SheetMaterial::poisson,
        &SheetMaterial::foundation_n_per_m3, &SheetMaterial::thickness_m, &SheetMaterial::friction,
        &SheetMaterial::pierce_pa, &SheetMaterial::fat_pierce_pa})
    for (const double bad : {kNan, -1.0}) {
      SheetMaterial wrong;
      wrong.*field = bad;
      EXPECT_FALSE(SkinSheet::make(0.04, 0.04, 0.002, wrong));
    }
}

TEST(SkinSheet, WholeItIsARectangleWithoutHoles) {
  const SkinSheet sheet = sheet_of(0.04, 0.03, 0.002);
  const SplitSheet whole = split(sheet, whole_sheet(sheet));
  EXPECT_EQ(whole.vertex.size(), sheet.points().size());
  EXPECT_TRUE(whole.walls.empty());
  EXPECT_NEAR(sheet_area(whole), 0.04 * 0.03, 1e-15);
  for (const Triangle& t : whole.triangles) EXPECT_GT(triangle_area(whole, t), 0);
  EXPECT_EQ(why_no_manifold(sheet, whole, sheet_surface(whole, {}, {})), "");
}

TEST(SkinSheet, ABladeThatIsNoNumberOrOffTheSheetCutsNothing) {
  const SkinSheet sheet = sheet_of(0.04, 0.03, 0.002);
  SheetCuts cuts = whole_sheet(sheet);
  begin_stroke(sheet, cuts, {kNan, 0});
  EXPECT_FALSE(cuts.blade_in);
  begin_stroke(sheet, cuts, {0.2, 0});
  EXPECT_FALSE(cuts.blade_in);
  EXPECT_EQ(go_on(sheet, cuts, {0, 0}, 0.005), 0);
  begin_stroke(sheet, cuts, {0, 0});
  EXPECT_TRUE(cuts.blade_in);
  EXPECT_EQ(go_on(sheet, cuts, {0.01, 0}, kNan), 0);
  EXPECT_EQ(go_on(sheet, cuts, {0.01, 0}, -1), 0);
  EXPECT_EQ(go_on(sheet, cuts, {kNan, 0}, 0.005), 0);
  EXPECT_FALSE(cuts.blade_in);
  begin_stroke(sheet, cuts, {0, 0});
  EXPECT_EQ(end_stroke(sheet, cuts, {0, 0}, 0.005), 0);
  EXPECT_TRUE(split(sheet, cuts).walls.empty());
}

TEST(SkinSheet, AScratchLessDeepThanTheSkinOpensNothing) {
  const SkinSheet sheet = sheet_of(0.04, 0.03, 0.002);
  SheetCuts cuts = whole_sheet(sheet);
  EXPECT_EQ(stroke(sheet, cuts, {{-0.01, 0}, {0.01, 0}}, 0.0015), 0);
  EXPECT_TRUE(split(sheet, cuts).walls.empty());
  // The same way again, deeper.
  EXPECT_NEAR(stroke(sheet, cuts, {{-0.01, 0}, {0.01, 0}}, 0.004), 0.02, 1e-9);
  EXPECT_FALSE(split(sheet, cuts).walls.empty());
}

// In whole skin the groove lies on the stroke exactly and is as long.
TEST(SkinSheet, AStraightCutLiesOnItsStrokeInAnyDirection) {
  const SkinSheet sheet = sheet_of(0.06, 0.06, 0.002);
  for (int i = 0; i < 40; ++i) {
    const double angle = 0.157 * i;
    const SheetPoint way(std::cos(angle), std::sin(angle)),
        from(0.0003 * i - 0.006, 0.0007 * i - 0.01);
    const SheetPoint a = from - 0.011 * way, b = from + 0.011 * way;
    SheetCuts cuts = whole_sheet(sheet);
    EXPECT_NEAR(stroke(sheet, cuts, {a, b}, 0.005), 0.022, 0.1 * 0.002) << i;
    for (std::size_t e = 0; e < sheet.edges().size(); ++e) {
      if (cuts.depth_m[e] == 0) continue;
      for (const std::uint32_t v : {sheet.edges()[e].a, sheet.edges()[e].b}) {
        const SheetPoint to = cuts.points[v] - a;
        EXPECT_LT(std::abs(to.x() * way.y() - to.y() * way.x()), 0.1 * 0.002) << i;
      }
    }
    const SplitSheet open = split(sheet, cuts);
    EXPECT_EQ(why_no_manifold(sheet, open, sheet_surface(open, {}, {})), "") << i;
  }
}

// Onto the sheet and off it, around it and back on it elsewhere: nothing along the rim.
TEST(SkinSheet, ABladeCutsWhereItIsOnTheSheetAlone) {
  const SkinSheet sheet = sheet_of(0.04, 0.03, 0.002);
  SheetCuts cuts = whole_sheet(sheet);
  const std::vector<SheetPoint> way = {{-0.05, 0.006}, {0.05, 0.006},   {0.05, 0.05},
                                       {-0.05, 0.05},  {-0.05, -0.006}, {0.05, -0.006}};
  const double opened = stroke(sheet, cuts, way, 0.005);
  EXPECT_GT(opened, 2 * (0.04 - 3 * 0.002));
  EXPECT_LT(opened, 2 * 0.04);
  for (std::size_t e = 0; e < sheet.edges().size(); ++e)
    if (cuts.depth_m[e] > 0) {
      EXPECT_NEAR(std::abs(cuts.points[sheet.edges()[e].a].y()), 0.006, 0.5 * 0.002);
      EXPECT_NEAR(std::abs(cuts.points[sheet.edges()[e].b].y()), 0.006, 0.5 * 0.002);
    }
}

TEST(SkinSheet, TheGrooveGrowsWithTheBladeAndStaysBehindItByAnEdge) {
  const SkinSheet sheet = sheet_of(0.06, 0.06, 0.002);
  SheetCuts cuts = whole_sheet(sheet);
  const SheetPoint from(-0.02, 0.003);
  begin_stroke(sheet, cuts, from);
  double opened = 0;
  for (int i = 1; i <= 400; ++i) {
    const double way = 0.0001 * i;
    opened += go_on(sheet, cuts, from + SheetPoint(way, 0), 0.005);
    EXPECT_LE(opened, way + 0.5 * 0.002);
    EXPECT_GE(opened, way - 1.5 * 0.002);
  }
}

// Lips apart by a known way: a wedge between them.
TEST(SkinSheet, TheGrooveHoldsTheWedgeBetweenItsLips) {
  const SkinSheet sheet = sheet_of(0.06, 0.06, 0.001);
  SheetCuts cuts = whole_sheet(sheet);
  stroke(sheet, cuts, {{-0.01, 0}, {0.01, 0}}, 0.004);
  const SplitSheet open = split(sheet, cuts);
  std::vector<SheetPoint> ways(open.vertex.size(), SheetPoint::Zero());
  // Each lip goes away from the cut by b(x) = 1 mm (1 - (x / 10 mm)^2).
  for (const Triangle& t : open.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t i = t[k];
      if (open.copies[open.vertex[i]] < 2) continue;
      double side = 0;
      for (const std::uint32_t j : t) side += open.point[j].y() - open.point[i].y();
      const double x = open.point[i].x() / 0.01;
      ways[i].y() = (side > 0 ? 1 : -1) * 0.001 * (1 - x * x);
    }
  const double area = 2 * 0.001 * 0.02 * 2 / 3;
  EXPECT_NEAR(open_area(open, ways), area, 0.02 * area);
  const TriMesh surface = sheet_surface(open, ways, {});
  EXPECT_NEAR(groove_volume(open, surface), 0.5 * 0.004 * area, 0.02 * 0.5 * 0.004 * area);
  EXPECT_NEAR(widest(open, ways), 0.002, 0.00002);
}

TEST(SkinSheet, StaysAManifoldOfTheSameAreaAfterEachOfManyRandomCuts) {
  expect_sound_after_random_cuts(40, 7);
}

}  // namespace
}  // namespace osteon
