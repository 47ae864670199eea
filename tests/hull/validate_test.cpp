#include "osteon/hull/validate.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "shapes.h"

namespace osteon {
namespace {

class ValidateHull : public ::testing::Test {
 protected:
  bool sound() const { return validate_hull(hull_, points_).empty(); }

  test::Points points_ = test::lattice(3);
  Hull hull_ = *build_hull(points_).hull;
};

TEST_F(ValidateHull, AcceptsASoundHull) { EXPECT_TRUE(sound()); }

TEST_F(ValidateHull, EmptyHull) {
  hull_ = Hull{};
  EXPECT_FALSE(sound());
}

TEST_F(ValidateHull, MissingTriangle) {
  hull_.triangles.pop_back();
  hull_.plane_of.pop_back();
  EXPECT_FALSE(sound());
}

TEST_F(ValidateHull, FlippedTriangle) {
  std::swap(hull_.triangles[3][0], hull_.triangles[3][1]);
  EXPECT_FALSE(sound());
}

TEST_F(ValidateHull, AllTrianglesFlipped) {
  for (Triangle& t : hull_.triangles) std::swap(t[0], t[1]);
  EXPECT_FALSE(sound());
}

TEST_F(ValidateHull, IndexOutOfRange) {
  hull_.triangles[0][0] = 99;
  EXPECT_FALSE(sound());
}

TEST_F(ValidateHull, PlaneIndexOutOfRange) {
  hull_.plane_of[0] = 99;
  EXPECT_FALSE(sound());
}

TEST_F(ValidateHull, MovedVertex) {
  hull_.vertices[0] += Vec3(1e-6, 0, 0);
  EXPECT_FALSE(sound());
}

TEST_F(ValidateHull, SwappedSources) {
  std::swap(hull_.source[0], hull_.source[1]);
  EXPECT_FALSE(sound());
}

TEST_F(ValidateHull, PlaneMovedInAndOut) {
  for (const double shift : {-1e-6, 1e-6}) {
    hull_.planes[2].d += shift;
    EXPECT_FALSE(sound()) << shift;
    hull_.planes[2].d -= shift;
  }
}

TEST_F(ValidateHull, NormalNotUnit) {
  hull_.planes[1].n *= 1.001;
  hull_.planes[1].d *= 1.001;
  EXPECT_FALSE(sound());
}

TEST_F(ValidateHull, PointOutside) {
  points_.emplace_back(1, 1, 2.00001);
  EXPECT_FALSE(sound());
}

TEST_F(ValidateHull, WrongVolume) {
  hull_.volume *= 1.0001;
  EXPECT_FALSE(sound());
}

TEST_F(ValidateHull, DentedSurface) {
  // The centre of a face as a vertex, one millimetre deep: closed, but not convex.
  points_ = test::box_corners();
  points_.emplace_back(0.5, 0.5, 0.999);
  hull_ = *build_hull(test::Points(points_.begin(), points_.begin() + 8)).hull;
  const auto top = [this](const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [this](auto v) { return hull_.vertices[v].z() == 1; });
  };
  hull_.vertices.emplace_back(0.5, 0.5, 0.999);
  hull_.source.push_back(8);
  for (std::size_t i = 0; i < hull_.triangles.size(); ++i) {
    if (!top(hull_.triangles[i])) continue;
    const Triangle t = hull_.triangles[i];
    hull_.triangles[i] = {t[0], t[1], 8};
    hull_.triangles.push_back({t[1], t[2], 8});
    hull_.triangles.push_back({t[2], t[0], 8});
    hull_.plane_of.insert(hull_.plane_of.end(), 2, hull_.plane_of[i]);
    break;
  }
  EXPECT_FALSE(sound());
}

}  // namespace
}  // namespace osteon
