// The walls and the floor of a cut, as they are drawn.
#include "skin/skin_groove.h"

#include <gtest/gtest.h>

#include <map>

#include "tissue/sheet/sheet_checks.h"

namespace osteon {
namespace {

constexpr double kSkin_m = 0.002, kCut_m = 0.006, kOpen_m = 0.003;

struct OpenCut {
  SkinSheet sheet = std::move(*SkinSheet::make(0.04, 0.03, 0.0015, {}));
  SplitSheet open;
  TriMesh surface;
  SkinGroove groove;

  // Each lip goes kOpen_m away from a cut along x, less towards its ends.
  OpenCut() {
    SheetCuts cuts = whole_sheet(sheet);
    stroke(sheet, cuts, {{-0.012, 0}, {0.012, 0}}, kCut_m);
    open = split(sheet, cuts);
    std::vector<SheetPoint> ways(open.vertex.size(), SheetPoint::Zero());
    for (const SheetWall& wall : open.walls)
      for (const std::uint32_t i : {wall.from, wall.to}) {
        if (open.copies[open.vertex[i]] < 2) continue;
        const double side = open.point[wall.to].x() > open.point[wall.from].x() ? 1 : -1;
        const double x = open.point[i].x() / 0.013;
        ways[i].y() = side * kOpen_m * (1 - x * x);
      }
    surface = sheet_surface(open, ways, {});
    const auto copies = std::span<const Vec3>(surface.vertices).first(open.vertex.size());
    groove = skin_groove(open, copies, kSkin_m);
  }
};

const OpenCut& open_cut() {
  static const OpenCut cut;
  return cut;
}

// Its only boundary runs just under the lips.
TEST(SkinGroove, IsAManifoldThatHangsOnTheLips) {
  const SkinGroove& groove = open_cut().groove;
  ASSERT_FALSE(groove.triangles.empty());
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> ways;
  for (const Triangle& t : groove.triangles)
    for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(++ways[std::pair(t[k], t[(k + 1) % 3])], 1);
  for (const auto& [way, n] : ways)
    if (!ways.count(std::pair(way.second, way.first))) {
      EXPECT_LT(groove.depth_m[way.first], 2e-5);
      EXPECT_LT(groove.depth_m[way.second], 2e-5);
      EXPECT_NEAR(groove.points[way.first].z(), 0, 2e-5);
    }
}

// The skin goes straight down, as far as it is thick; the floor is as deep as the cut, and takes
// the middle half of the width.
TEST(SkinGroove, HasTheSkinsSectionAndAFloorOfFat) {
  const OpenCut& cut = open_cut();
  double floor_m2 = 0, section_m2 = 0, aslant_m2 = 0;
  for (const Triangle& t : cut.groove.triangles) {
    const Vec3 &a = cut.groove.points[t[0]], &b = cut.groove.points[t[1]],
               &c = cut.groove.points[t[2]];
    const Vec3 normal = 0.5 * (b - a).cross(c - a);
    const auto deeper = [&](double than_m) {
      return cut.groove.depth_m[t[0]] > than_m && cut.groove.depth_m[t[1]] > than_m &&
             cut.groove.depth_m[t[2]] > than_m;
    };
    if (deeper(0.9 * kCut_m)) floor_m2 += normal.z();
    if (!deeper(1e-4))
      (std::abs(normal.z()) < 0.1 * normal.norm() ? section_m2 : aslant_m2) += normal.norm();
  }
  double deepest = 0, open_m2 = 0;
  for (const double depth : cut.groove.depth_m) deepest = std::max(deepest, depth);
  std::vector<SheetPoint> ways;
  for (std::size_t i = 0; i < cut.open.vertex.size(); ++i)
    ways.emplace_back(cut.surface.vertices[i].head<2>() - cut.open.point[i]);
  open_m2 = open_area(cut.open, ways);
  EXPECT_NEAR(deepest, kCut_m, 1e-9);
  EXPECT_GT(floor_m2, 0.5 * open_m2);
  EXPECT_LT(floor_m2, open_m2);
  EXPECT_GT(section_m2, 5 * aslant_m2);
}

TEST(SkinGroove, OfWholeSkinThereIsNone) {
  const SkinSheet sheet = std::move(*SkinSheet::make(0.03, 0.03, 0.002, {}));
  const SplitSheet whole = split(sheet, whole_sheet(sheet));
  EXPECT_TRUE(skin_groove(whole, sheet_surface(whole, {}, {}).vertices, kSkin_m).triangles.empty());
}

}  // namespace
}  // namespace osteon
