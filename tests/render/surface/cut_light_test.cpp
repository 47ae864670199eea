// A soft part that was cut keeps its soft shadow, and a cut face is as dark as it lies deep.
#include "surface/cut_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../scenes.h"
#include "surface/surface.h"

namespace osteon {
namespace {

constexpr double kPart_m = 0.010;

// A ball that another shades, and the same cut through: other vertices, and a face.
struct Shadowed {
  Case the_case;
  PreparedCase prepared;
  RestLight light;
  TriMesh cut;

  Shadowed() {
    for (int i = 0; i < 2; ++i) {
      SoftPart part;
      part.name = i == 0 ? "cut" : "other";
      part.kind = "meniscus";
      part.mesh_W = sphere_mesh(kPart_m);
      for (Vec3& p : part.mesh_W.vertices) p.x() += 0.0205 * i;
      the_case.softs.push_back(part);
    }
    prepared = prepare_case(the_case);
    light = RestLight(prepared.softs[0].shades, prepared.softs[0].roots);
    cut = ball(41, 83);
    for (Vec3& p : cut.vertices) {
      p *= kPart_m;
      p.z() = std::min(p.z(), 0.006);
    }
  }
  const TriMesh& rest() const { return the_case.softs[0].mesh_W; }
};

/// Openness of what is drawn nearest to a place.
int open_at(const ShadedMesh& mesh, const Vec3& p) {
  double least = 1;
  int open = -1;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const auto& q = mesh.positions[v];
    const double away = (Eigen::Vector3f(q[0], q[1], q[2]).cast<double>() - p).norm();
    if (away >= least) continue;
    least = away;
    open = mesh.shades[v].openness;
  }
  return open;
}

TEST(CutLight, WhatWasNotCutKeepsItsShadow) {
  const Shadowed made;
  CutLight known;
  const ShadedMesh lit = cut_light(made.rest(), made.light, made.cut, known);
  ASSERT_FALSE(lit.positions.empty());
  const ShadedMesh& before = made.prepared.softs[0];
  int darkest = 255;
  for (const Vec3& way : {Vec3(1, 0, 0), Vec3(0.6, 0.5, -0.4), Vec3(0, 1, 0), Vec3(-1, 0, 0),
                          Vec3(0.3, -0.2, -0.9)}) {
    const Vec3 p = kPart_m * way.normalized();
    EXPECT_NEAR(open_at(lit, p), open_at(before, p), 14) << way.transpose();
    darkest = std::min(darkest, open_at(lit, p));
  }
  EXPECT_LT(darkest, 160) << "the other ball must shade this one";
}

TEST(CutLight, ACutFaceIsTheDarkerTheDeeperItLies) {
  const Shadowed made;
  CutLight known;
  const ShadedMesh lit = cut_light(made.rest(), made.light, made.cut, known);
  const int deep = open_at(lit, Vec3(0, 0, 0.006)), shallow = open_at(lit, Vec3(-0.0072, 0, 0.006));
  EXPECT_LT(deep, shallow - 20);
  EXPECT_GT(deep, 64);
}

TEST(CutLight, GoesAlongWithItsVerticesUntilTheNextCut) {
  const Shadowed made;
  RestLight light = made.light;
  const ShadedMesh first = shown_light(made.rest(), light, made.cut);
  TriMesh pressed = made.cut;
  for (Vec3& p : pressed.vertices) p.x() -= 0.002;
  const ShadedMesh moved = shown_light(made.rest(), light, pressed);
  ASSERT_EQ(moved.shades.size(), first.shades.size());
  for (std::size_t v = 0; v < moved.shades.size(); ++v)
    ASSERT_EQ(moved.shades[v].openness, first.shades[v].openness);
  TriMesh deeper = made.cut;
  for (Vec3& p : deeper.vertices) p.z() = std::min(p.z(), 0.003);
  std::swap(deeper.triangles.front(), deeper.triangles.back());
  EXPECT_LT(open_at(shown_light(made.rest(), light, deeper), Vec3(0, 0, 0.003)),
            open_at(first, Vec3(0, 0, 0.006)));
  const ShadedMesh whole = shown_light(made.rest(), light, made.rest());
  EXPECT_EQ(whole.positions, made.prepared.softs[0].positions);
}

TEST(CutLight, OfAnotherSurfaceItIsEmpty) {
  const Shadowed made;
  CutLight known;
  EXPECT_TRUE(cut_light(made.rest(), {}, made.cut, known).positions.empty());
  TriMesh less = made.rest();
  less.vertices.pop_back();
  EXPECT_TRUE(cut_light(less, made.light, made.cut, known).positions.empty());
}

}  // namespace
}  // namespace osteon
