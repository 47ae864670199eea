#include "osteon/carve/carved_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numbers>

#include "carve/carve_fixtures.h"
#include "osteon/carve/removed.h"
#include "osteon/mesh/cube_loops.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/mesh_io.h"

namespace osteon {
namespace {

using namespace test;

const std::shared_ptr<const UncutField>& solid_block() {
  static const auto field = block_field(0.006);
  return field;
}

void expect_sound(const TriMesh& mesh) {
  const Topology shape = topology(mesh);
  EXPECT_EQ(shape.boundary_edges, 0u);
  EXPECT_EQ(shape.non_manifold_edges, 0u);
  EXPECT_EQ(shape.misoriented_edges, 0u);
  EXPECT_GT(volume(mesh), 0);
}

void expect_same(const TriMesh& a, const TriMesh& b) {
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.triangles, b.triangles);
}

Pose random_pose(Random& random, double reach_m) {
  Pose X;
  const double x = random.uniform(-reach_m, reach_m), y = random.uniform(-reach_m, reach_m);
  X.p = {x, y, random.uniform(-reach_m, reach_m)};
  X.q = random.rotation();
  return X;
}

// The surface's loops rest on this: no cube has two faces that one of its loops takes twice, and
// once such a face is joined no other face is such.
TEST(CarvedSurface, NoCubeHasTwoFacesThatOneLoopTakesTwice) {
  int with_one = 0;
  for (int m = 0; m < 256; ++m) {
    const auto mask = static_cast<std::uint8_t>(m);
    std::vector<int> bad;
    for (int f = 0; f < 6; ++f)
      if (face_is_ambiguous(mask, f) && one_loop_takes_face(cube_loops(mask, 0), f))
        bad.push_back(f);
    EXPECT_LE(bad.size(), 1u) << m;
    if (bad.empty()) continue;
    ++with_one;
    const CubeLoops joined = cube_loops(mask, static_cast<std::uint8_t>(1 << bad[0]));
    for (int f = 0; f < 6; ++f)
      EXPECT_FALSE(face_is_ambiguous(mask, f) && one_loop_takes_face(joined, f)) << m;
  }
  EXPECT_GT(with_one, 0);
}

TEST(CarvedSurface, AnUncutBoneIsItsMesh) {
  const CarvedField field = value(CarvedField::make(solid_block(), {}, 64));
  const TriMesh mesh = value(carved_mesh(field));
  expect_sound(mesh);
  EXPECT_NEAR(1e9 * volume(mesh), 12 * 12 * 12, 2);
  double worst = 0;
  for (const Vec3& v : mesh.vertices)
    worst = std::max(worst, std::abs(v.cwiseAbs().maxCoeff() - 0.006));
  EXPECT_LT(worst, 0.0001);
}

TEST(CarvedSurface, TheMeshLosesWhatWasRemoved) {
  const CarvedField field = value(CarvedField::make(solid_block(), {}, 64));
  const double whole = volume(value(carved_mesh(field)));
  for (const double size : {2.0, 3.0, 4.0, 5.0}) {
    CarvedField cut = value(CarvedField::make(solid_block(), {}, 4096));
    cut.cut(cutter("burr", size), Pose{});
    const double ball = std::numbers::pi * size * size * size / 6;
    EXPECT_NEAR(1e9 * (whole - volume(value(carved_mesh(cut)))), ball, 0.005 * ball) << size;
    EXPECT_NEAR(1e9 * total(removed_volume(cut)), ball, 0.005 * ball) << size;
  }
}

TEST(CarvedSurface, NothingLeftIsSaid) {
  CarvedField field = value(CarvedField::make(block_field(0.0015), {}, 4096));
  field.cut(cutter("burr", 8), Pose{});
  const auto mesh = carved_mesh(field);
  ASSERT_FALSE(mesh);
  EXPECT_NE(mesh.error().message().find("nothing of the bone remains"), std::string::npos);
}

// Random cuts with all kinds of instruments, meshed by changed blocks on the way: closed, manifold,
// and bit by bit what meshing the whole field anew gives.
TEST(CarvedSurface, ChangedBlocksAloneGiveTheWholeSurface) {
  Random random(7);
  CarvedField field = value(CarvedField::make(solid_block(), {}, 4096));
  CarvedSurface surface(field);
  surface.mesh_all(field);
  const auto kinds = cutter_kinds();
  const int cuts = std::getenv("OSTEON_LONG") ? 1000 : 300;
  for (int n = 0; n < cuts; ++n) {
    const auto kind = static_cast<std::size_t>(random.uniform(0, double(kinds.size())));
    const Cutter tool = cutter(std::string(kinds[kind].name), random.uniform(0.3, 3));
    const Pose from = random_pose(random, 0.008);
    Pose to = from;
    to.p += random.uniform(0, 0.002) * random.direction();
    field.cut(tool, from, to);
    if (n % 10 != 0) continue;
    surface.update(field);
    expect_sound(surface.joined());
  }
  surface.update(field);
  expect_same(surface.joined(), value(carved_mesh(field)));
}

TEST(CarvedSurface, UndoPutsTheSurfaceBack) {
  CarvedField field = value(CarvedField::make(solid_block(), {}, 4096));
  CarvedSurface surface(field);
  surface.mesh_all(field);
  const TriMesh whole = surface.joined();
  const CarveState before = field.save();
  field.cut(cutter("burr", 4), pose_along({0, 0, 0.006}, Vec3::UnitZ()));
  EXPECT_FALSE(surface.update(field).empty());
  EXPECT_NE(surface.joined().vertices.size(), whole.vertices.size());
  ASSERT_TRUE(field.restore(before));
  EXPECT_FALSE(surface.update(field).empty());
  expect_same(surface.joined(), whole);
  EXPECT_TRUE(surface.update(field).empty());
}

TEST(CarvedSurface, OnlyBlocksNearACutAreMeshed) {
  CarvedField field = value(CarvedField::make(solid_block(), {}, 4096));
  CarvedSurface surface(field);
  field.cut(cutter("burr", 1), pose_along({0, 0, 0.006}, Vec3::UnitZ()));
  const auto changed = surface.update(field);
  EXPECT_GT(changed.size(), 0u);
  EXPECT_LT(changed.size(), 28u);
  for (const std::uint32_t b : changed)
    EXPECT_LT((field.grid().middle(field.grid().place(b)) - Vec3(0, 0, 0.006)).norm(), 0.005);
}

// What a reader of the file makes of it, who knows places alone, in single precision.
TEST(CarvedSurface, AFileOfItIsClosedToo) {
  CarvedField field = value(CarvedField::make(solid_block(), {}, 4096));
  Random random(8);
  for (int n = 0; n < 60; ++n)
    field.cut(cutter("burr", random.uniform(0.5, 3)), random_pose(random, 0.007));
  const TriMesh mesh = value(carved_mesh(field));
  std::vector<Eigen::Vector3f> places;
  for (const Vec3& v : mesh.vertices) places.push_back((1e3 * v).cast<float>());
  const auto less = [](const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  std::sort(places.begin(), places.end(), less);
  const auto twice = std::adjacent_find(places.begin(), places.end());
  EXPECT_EQ(twice, places.end());
}

}  // namespace
}  // namespace osteon
