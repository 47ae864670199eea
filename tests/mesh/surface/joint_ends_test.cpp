#include "osteon/mesh/joint_ends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "mesh/shapes.h"
#include "osteon/mesh/isosurface.h"

namespace osteon {
namespace {

// A rod of radius 5 mm and length 200 mm about the middle, with a ball of radius 15 mm at +z.
TriMesh club(const Pose& X) {
  IsosurfaceOptions options;
  options.cell_m = 0.002;
  const ScalarField field = [](const Vec3& p) {
    const Vec3 on_axis(0, 0, std::clamp(p.z(), -0.095, 0.095));
    return std::min((p - on_axis).norm() - 0.005, (p - Vec3(0, 0, 0.085)).norm() - 0.015);
  };
  const Vec3 half(0.02, 0.02, 0.105);
  TriMesh mesh = std::move(isosurface(field, {-half, half}, options).value());
  for (Vec3& v : mesh.vertices) v = X * v;
  return mesh;
}

TEST(JointEnds, OfNothingAndOfAShortBodyThereIsNoShaft) {
  EXPECT_FALSE(JointEnds(TriMesh{}).has_shaft());
  EXPECT_FALSE(JointEnds(TriMesh{}).on_shaft(Vec3::Zero()));
  EXPECT_FALSE(JointEnds(test::cube(0.01)).has_shaft());
  EXPECT_FALSE(JointEnds(test::sphere(0.01, 12)).on_shaft(Vec3::Zero()));
}

TEST(JointEnds, AnEndIsAsLongAsItIsWide) {
  const Pose X{Vec3(0.3, -0.2, 0.1), Quat(0.9, 0.1, -0.3, 0.2).normalized()};
  for (const Pose& X_WB : {Pose{}, X}) {
    const JointEnds ends(club(X_WB));
    ASSERT_TRUE(ends.has_shaft());
    for (const auto& [z, shaft] : {std::pair{-0.099, false},
                                   {-0.092, false},
                                   {-0.086, true},
                                   {0.0, true},
                                   {0.066, true},
                                   {0.074, false},
                                   {0.099, false}})
      EXPECT_EQ(ends.on_shaft(X_WB * Vec3(0.002, -0.001, z)), shaft) << z;
  }
}

}  // namespace
}  // namespace osteon
