// A sheet laid on a body's skin.
#include "osteon/tissue/skin_place.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/mesh/measure.h"
#include "tissue/sheet/sheet_checks.h"

namespace osteon {
namespace {

constexpr double kRadius = 0.05;

// A limb: a tube along x, facing outwards.
TriMesh tube() {
  constexpr std::uint32_t kAround = 90, kAlong = 40;
  TriMesh out;
  for (std::uint32_t i = 0; i <= kAlong; ++i)
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const double angle = 2 * 3.141592653589793 * k / kAround;
      out.vertices.emplace_back(0.2 * i / kAlong - 0.1, kRadius * std::cos(angle),
                                kRadius * std::sin(angle));
    }
  for (std::uint32_t i = 0; i < kAlong; ++i)
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const std::uint32_t a = i * kAround + k, b = i * kAround + (k + 1) % kAround;
      out.triangles.push_back({a, b, a + kAround});
      out.triangles.push_back({b, b + kAround, a + kAround});
    }
  for (Triangle& t : out.triangles) {
    const Vec3 &a = out.vertices[t[0]], &b = out.vertices[t[1]], &c = out.vertices[t[2]];
    Vec3 way = a;
    way.x() = 0;
    if ((b - a).cross(c - a).dot(way) < 0) std::swap(t[1], t[2]);
  }
  return out;
}

TEST(SkinPlace, TheFrameStandsOnTheSkinAndLooksOutOfIt) {
  const TriMesh limb = tube();
  const auto frame = sheet_frame(limb, {0.01, 0.002, 0.07}, -Vec3::UnitX(), 0, 0.015);
  ASSERT_TRUE(frame);
  EXPECT_NEAR(frame->p.z(), kRadius, 0.0003);
  EXPECT_GT(frame->rotate(Vec3::UnitZ()).z(), 0.99);
  EXPECT_LT(frame->rotate(Vec3::UnitY()).x(), -0.99);
  const auto turned =
      sheet_frame(limb, {0.01, 0.002, 0.07}, -Vec3::UnitX(), 1.5707963267948966, 0.015);
  EXPECT_GT(std::abs(turned->rotate(Vec3::UnitY()).y()), 0.99);
}

TEST(SkinPlace, RefusesNoSkinAndADirectionOutOfIt) {
  EXPECT_FALSE(sheet_frame({}, Vec3::Zero(), Vec3::UnitX(), 0, 0.015));
  EXPECT_FALSE(sheet_frame(tube(), {0, 0, 0.07}, Vec3::UnitZ(), 0, 0.015));
}

TEST(SkinPlace, ASheetLiesOnTheSkinItsGrooveUnderIt) {
  const TriMesh limb = tube();
  const auto frame = sheet_frame(limb, {0, 0, 0.07}, -Vec3::UnitX(), 0, 0.015);
  const auto sheet = SkinSheet::make(0.04, 0.03, 0.002, {});
  SheetCuts cuts = whole_sheet(*sheet);
  stroke(*sheet, cuts, {{-0.008, 0}, {0.008, 0}}, 0.005);
  const SplitSheet open = split(*sheet, cuts);
  const auto laid = lay_on(limb, *frame, sheet_surface(open, {}, {}));
  ASSERT_TRUE(laid) << laid.error().message();
  double deepest = 0;
  for (std::size_t i = 0; i < laid->vertices.size(); ++i) {
    const Vec3& p = laid->vertices[i];
    const double under = kRadius - std::hypot(p.y(), p.z());
    if (i < open.vertex.size())
      EXPECT_NEAR(under, 0, 0.0002);
    else
      deepest = std::max(deepest, under);
  }
  EXPECT_NEAR(deepest, 0.005, 0.0003);
  const TriMesh rest = around(limb, *frame, 0.04, 0.03);
  EXPECT_LT(rest.triangles.size(), limb.triangles.size() - 20);
  // What was cut out is the rectangle bent around the tube, to the facets' flatness.
  const double cut_out = area(limb) - area(rest);
  EXPECT_NEAR(cut_out, 0.03 * 2 * kRadius * std::asin(0.02 / kRadius), 0.001 * cut_out);
  const Pose X_SW = frame->inverse();
  for (const Triangle& t : rest.triangles) {
    const Vec3 middle =
        X_SW * Vec3((rest.vertices[t[0]] + rest.vertices[t[1]] + rest.vertices[t[2]]) / 3);
    const bool under = std::abs(middle.x()) < 0.02 - 1e-9 && std::abs(middle.y()) < 0.015 - 1e-9;
    EXPECT_FALSE(under && std::abs(middle.z()) < 0.02);
  }
  EXPECT_FALSE(lay_on(limb, *frame,
                      sheet_surface(split(*SkinSheet::make(0.12, 0.03, 0.002, {}),
                                          whole_sheet(*SkinSheet::make(0.12, 0.03, 0.002, {}))),
                                    {}, {})));
}

}  // namespace
}  // namespace osteon
