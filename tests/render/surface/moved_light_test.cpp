// The light of a soft surface goes with its vertices.
#include "surface/moved_light.h"

#include <gtest/gtest.h>

#include "../scenes.h"

namespace osteon {
namespace {

// Two balls near one another: where they face each other there is less light.
struct TwoSofts {
  Case the_case;
  PreparedCase prepared;

  TwoSofts() {
    for (int i = 0; i < 2; ++i) {
      SoftPart part;
      part.name = i == 0 ? "near" : "other";
      part.kind = "meniscus";
      part.mesh_W = sphere_mesh(0.010);
      for (Vec3& p : part.mesh_W.vertices) p.x() += 0.0205 * i;
      the_case.softs.push_back(part);
    }
    prepared = prepare_case(the_case);
  }
  const TriMesh& rest() const { return the_case.softs[0].mesh_W; }
};

TEST(MovedLight, WhatHasNotMovedIsDrawnAsItWas) {
  const TwoSofts two;
  const ShadedMesh& as_it_was = two.prepared.softs[0];
  const ShadedMesh lit = moved_light(two.rest(), as_it_was.shades, two.rest());
  EXPECT_EQ(lit.positions, as_it_was.positions);
  EXPECT_EQ(lit.normals, as_it_was.normals);
  EXPECT_EQ(lit.triangles, as_it_was.triangles);
  EXPECT_EQ(lit.closed, as_it_was.closed);
  ASSERT_EQ(lit.shades.size(), as_it_was.shades.size());
  for (std::size_t v = 0; v < lit.shades.size(); ++v)
    ASSERT_EQ(lit.shades[v].openness, as_it_was.shades[v].openness);
}

TEST(MovedLight, AVertexTakesItsShadowAlong) {
  const TwoSofts two;
  const ShadedMesh& baked = two.prepared.softs[0];
  TriMesh moved = two.rest();
  for (Vec3& p : moved.vertices) p += Vec3(0, 0, 0.002 * p.x() / 0.01);
  const ShadedMesh lit = moved_light(two.rest(), baked.shades, moved);
  ASSERT_EQ(lit.shades.size(), baked.shades.size());
  int darkest = 255;
  for (std::size_t v = 0; v < lit.shades.size(); ++v) {
    ASSERT_EQ(lit.shades[v].openness, baked.shades[v].openness);
    ASSERT_EQ(lit.shades[v].cavity, baked.shades[v].cavity);
    darkest = std::min<int>(darkest, lit.shades[v].openness);
  }
  EXPECT_LT(darkest, 160) << "the other ball must shade this one";
  EXPECT_NE(lit.positions, baked.positions);
}

TEST(MovedLight, OfAnotherSurfaceItIsEmpty) {
  const TwoSofts two;
  TriMesh less = two.rest();
  less.vertices.pop_back();
  EXPECT_TRUE(moved_light(two.rest(), two.prepared.softs[0].shades, less).positions.empty());
  EXPECT_TRUE(moved_light(two.rest(), {}, two.rest()).positions.empty());
}

TEST(MovedLight, AVertexThatIsNotFiniteIsLeftOut) {
  const TwoSofts two;
  TriMesh moved = two.rest();
  moved.vertices[3].x() = std::nan("");
  const ShadedMesh lit = moved_light(two.rest(), two.prepared.softs[0].shades, moved);
  EXPECT_EQ(lit.positions.size() + 1, two.prepared.softs[0].positions.size());
  EXPECT_EQ(lit.shades.size(), lit.positions.size());
}

}  // namespace
}  // namespace osteon
