#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "osteon/tissue/sheet_balance.h"
#include "tissue/sheet/sheet_checks.h"

namespace osteon {

inline void expect_sound(const SkinSheet& sheet, const SheetCuts& cuts) {
  const double edge = sheet.edge_m(), least = 0.25 * 0.25 * std::sqrt(3.0) * edge * edge;
  const SplitSheet open = split(sheet, cuts);
  ASSERT_EQ(why_no_manifold(sheet, open, sheet_surface(open, {}, {})), "");
  ASSERT_NEAR(sheet_area(open), 0.03 * 0.03, 1e-12);
  for (const Triangle& t : open.triangles) {
    const SheetPoint u = open.point[t[1]] - open.point[t[0]],
                     v = open.point[t[2]] - open.point[t[0]];
    ASSERT_GT(0.5 * (u.x() * v.y() - u.y() * v.x()), 0.9 * least);
  }
}

/// Fifty cuts in each of so many pieces of skin, across and along each other, closed ones too, to
/// and over the rim: each time a manifold of the same area, in balance at the end.
inline void expect_sound_after_random_cuts(int pieces, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto at = [&](double size) { return size * ((random() % 10001) / 10000.0 - 0.5); };
  const SkinSheet sheet = std::move(*SkinSheet::make(0.03, 0.03, 0.002, {}));
  for (int piece = 0; piece < pieces && !::testing::Test::HasFailure(); ++piece) {
    SCOPED_TRACE(piece);
    SheetCuts cuts = whole_sheet(sheet);
    for (int i = 0; i < 50; ++i) {
      std::vector<SheetPoint> points;
      for (std::size_t k = 0; k < 2 + random() % 4; ++k) {
        const double x = at(0.034);
        points.emplace_back(x, at(0.034));
      }
      if (random() % 4 == 0) points.push_back(points.front());
      stroke(sheet, cuts, points, 0.001 + 0.005 * (random() % 100) / 100.0);
      expect_sound(sheet, cuts);
    }
    if (piece % 10 != 0) continue;
    const SheetBalance balance(sheet, split(sheet, cuts));
    for (const SheetPoint& way : balance.ways()) ASSERT_TRUE(way.allFinite());
    const SheetLoad load = load_on(balance.split(), {{0.002, -0.001}, 0.0025});
    const SheetDent dent = balance.pressed(load, 3);
    for (const double down : dent.down_m) ASSERT_LT(std::abs(down), sheet.material().fat_m);
  }
}

}  // namespace osteon
