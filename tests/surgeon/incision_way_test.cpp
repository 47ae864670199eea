#include "incision_way.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

// Over a limb along y, 50 mm thick, its top at the origin.
Case limb() {
  constexpr int kCells = 30;
  constexpr double kCell_m = 0.002, kLimb_m = 0.05;
  SoftPart skin;
  skin.name = skin.tissue = skin.kind = "skin";
  for (int j = 0; j <= kCells; ++j)
    for (int i = 0; i <= kCells; ++i) {
      const double x = kCell_m * (i - kCells / 2), y = kCell_m * (j - kCells / 2);
      skin.mesh_W.vertices.emplace_back(x, y, std::sqrt(kLimb_m * kLimb_m - x * x) - kLimb_m);
    }
  for (std::uint32_t j = 0; j < kCells; ++j)
    for (std::uint32_t i = 0; i < kCells; ++i) {
      const std::uint32_t a = j * (kCells + 1) + i, b = a + 1, c = a + kCells + 1, d = c + 1;
      skin.mesh_W.triangles.push_back({a, b, d});
      skin.mesh_W.triangles.push_back({a, d, c});
    }
  Case out;
  out.softs.push_back(skin);
  return out;
}

struct Stroke {
  double from = 1, to = -1, deepest = 0, x = 0;
  std::size_t samples = 0;
};

// What a way does under the skin.
Stroke stroke_of(const ProbePath& path) {
  Stroke out;
  for (const PathSample& sample : path.samples) {
    const Vec3& p = sample.X_WD.p;
    const double skin_z = std::sqrt(0.05 * 0.05 - p.x() * p.x()) - 0.05;
    if (sample.instrument != "scalpel_15" || !(p.z() < skin_z - 1e-4)) continue;
    ++out.samples;
    out.from = std::min(out.from, p.y());
    out.to = std::max(out.to, p.y());
    out.deepest = std::max(out.deepest, skin_z - p.z());
    out.x = p.x();
    // The blade stands upright, its edge along the stroke.
    EXPECT_NEAR(sample.X_WD.rotate(Vec3::UnitZ()).z(), 1, 1e-9);
    EXPECT_NEAR(std::abs(sample.X_WD.rotate(Vec3::UnitX()).y()), 1, 1e-9);
  }
  return out;
}

HandWay hand_beside() { return {"guide_pin", held_by_shaft({0, 0.1, 0.2}, Vec3::UnitZ()), 1}; }

const RoundJoint kRoundLimb{Vec3(0, 0.06, -0.05), {}};

Stroke opened(const std::string& fault) {
  HandWay way = hand_beside();
  const Case skin = limb();
  open_skin(skin, Pose{}, kRoundLimb, fault, way);
  EXPECT_GT(way.pose().p.z(), 0.05) << "off it again";
  return stroke_of(way.path());
}

TEST(IncisionWay, WithoutSkinNothingIsDone) {
  HandWay way = hand_beside();
  open_skin(Case(), Pose{}, kRoundLimb, "", way);
  EXPECT_EQ(way.path().samples.size(), 1u);
}

TEST(IncisionWay, OneStrokeAlongTheLimbThroughTheSkin) {
  const Stroke done = opened("");
  ASSERT_GT(done.samples, 5u);
  EXPECT_GT(done.to - done.from, 0.028);
  EXPECT_LT(done.to - done.from, 0.04);
  EXPECT_NEAR(done.to + done.from, 0, 1e-6);
  EXPECT_GT(done.deepest, 0.010);
  EXPECT_LT(done.deepest, 0.013);
  EXPECT_NEAR(done.x, 0, 1e-6);
}

TEST(IncisionWay, WhoErrsCutsAsideOrTooDeepAndNotBoth) {
  const Stroke aside = opened("incision_aside"), deep = opened("incision_deep");
  EXPECT_GT(std::abs(aside.x), 0.0125);
  EXPECT_LT(aside.deepest, 0.014);
  EXPECT_NEAR(deep.x, 0, 1e-6);
  EXPECT_GT(deep.deepest, 0.020);
}

}  // namespace
}  // namespace osteon
