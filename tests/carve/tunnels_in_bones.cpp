// Tunnels along random lines through the built-in and the real femur and tibia, each compared with
// CGAL: takes minutes.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/shapes.h"
#include "osteon/anatomy/generate.h"
#include "osteon/base/random.h"
#include "osteon/carve/tunnel.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/mesh_io.h"
#include "osteon/mesh/repair.h"
#include "tunnel_oracle.h"

namespace osteon {
namespace {

const GeneratedAnatomy& knee() {
  static const GeneratedAnatomy grown = [] {
    GenerateOptions options;
    options.soft_parts = false;
    auto made = generate_anatomy(
        std::filesystem::path(OSTEON_SOURCE_DIR) / "assets/anatomy/knee.toml", options);
    EXPECT_TRUE(made) << made.error().message();
    return made ? *made : GeneratedAnatomy{};
  }();
  return grown;
}

TriMesh built_in(const std::string& name) {
  for (const GeneratedBone& bone : knee().bones)
    if (bone.name == name) return bone.mesh;
  return {};
}

TriMesh real(const std::string& name) {
  auto mesh = load_mesh(test::shared_folder() / "anatomy/knee" / (name + ".stl"), 1.0);
  if (!mesh) return {};
  repair(*mesh);
  return *mesh;
}

std::size_t random_vertex(const TriMesh& bone, Random& random) {
  return static_cast<std::size_t>(random.uniform(0, static_cast<double>(bone.vertices.size())));
}

/// By a random vertex of the bone: through it, past it at about the drill's radius, or beginning or
/// ending in the bone.
TunnelLine anywhere(const TriMesh& bone, Random& random, double diameter) {
  const Vec3 along = random.direction();
  const double aside = random.uniform(0, 0.55) * diameter;
  const double before = random.uniform(-5e-3, 100e-3), beyond = random.uniform(5e-3, 100e-3);
  const Vec3 at = bone.vertices[random_vertex(bone, random)] + aside * along.unitOrthogonal();
  return {at - before * along, at + beyond * along, diameter};
}

/// Along the surface at a vertex, outside of it: the drill's side touches it (`deep_m` 0), cuts in,
/// or passes it by.
TunnelLine along_surface(const TriMesh& bone, Random& random, double diameter, double deep_m) {
  const std::vector<Vec3> normals = vertex_normals(bone);
  const std::size_t v = random_vertex(bone, random);
  const Vec3 along = normals[v].cross(random.direction()).normalized();
  const Vec3 at = bone.vertices[v] + (0.5 * diameter - deep_m) * normals[v];
  return {at - 0.04 * along, at + 0.04 * along, diameter};
}

/// From one end of the bone to the other: of the femur's and tibia's widest axis through both
/// condyles.
TunnelLine right_through(const TriMesh& bone, Random& random, double diameter) {
  const Aabb box = bounds(bone);
  const Vec3 size = box.extent();
  // The long axis is that of the shaft; the wider of the other two leads across both condyles.
  Eigen::Index shaft = 0, across = 0;
  size.maxCoeff(&shaft);
  Vec3 rest = size;
  rest[shaft] = 0;
  rest.maxCoeff(&across);
  const auto at_end = [&](double sign) {
    for (;;) {
      const Vec3& p = bone.vertices[random_vertex(bone, random)];
      if (sign * (p - box.center())[across] > 0.35 * size[across]) return p;
    }
  };
  const Vec3 a = at_end(-1), b = at_end(1), along = (b - a).normalized();
  return {a - 0.01 * along, b + 0.01 * along, diameter};
}

/// Begins under the surface, and leads on into the bone or out of it.
TunnelLine from_inside(const TriMesh& bone, Random& random, double diameter) {
  const std::vector<Vec3> normals = vertex_normals(bone);
  const std::size_t v = random_vertex(bone, random);
  const Vec3 along = random.direction();
  const Vec3 from = bone.vertices[v] - random.uniform(4e-3, 9e-3) * normals[v];
  return {from, from + random.uniform(4e-3, 60e-3) * along, diameter};
}

/// A fifth of the lines of each kind.
TunnelLine random_line(const TriMesh& bone, Random& random, int n) {
  const double diameter = random.uniform(2e-3, 12e-3);
  switch (n % 5) {
    case 1:  // grazing
      return along_surface(bone, random, diameter, random.uniform(0, 0.1) * diameter);
    case 2:  // tangential, or missing by a little; elsewhere it may meet the bone all the same
      return along_surface(bone, random, diameter, n % 2 == 0 ? 0 : -random.uniform(0, 3e-3));
    case 3:
      return right_through(bone, random, diameter);
    case 4:
      return from_inside(bone, random, diameter);
    default:
      return anywhere(bone, random, diameter);
  }
}

void drill_random_lines(const TriMesh& bone, int count) {
  Random random(15);
  const double whole = volume(bone);
  for (int i = 0; i < count; ++i) {
    const TunnelLine line = random_line(bone, random, i);
    const auto plan = plan_tunnel(bone, line);
    ASSERT_TRUE(plan) << i << ": " << plan.error().message();
    const auto cut = advance(*plan, plan->length_m);
    ASSERT_TRUE(cut) << i << ": " << cut.error().message();
    EXPECT_EQ(test::faults_of(bone, *plan, *cut), "") << i;
    const double left = test::cgal_volume_less_cylinder(bone, line.from, line.to, line.diameter_m);
    if (left < 0) continue;  // the oracle gave up
    // A cut so shallow that a thousandth of it is thinner than the oracle's own sides.
    EXPECT_NEAR(cut->removed_m3, whole - left, 1e-3 * (whole - left) + 1e-12) << i;
  }
}

TEST(TunnelsInBones, BuiltInFemur) { drill_random_lines(built_in("femur"), 100); }
TEST(TunnelsInBones, BuiltInTibia) { drill_random_lines(built_in("tibia"), 100); }

TEST(TunnelsInBones, RealFemur) {
  const TriMesh bone = real("femur");
  if (bone.triangles.empty()) GTEST_SKIP() << "no real bones: set OSTEON_SHARED";
  if (!topology(bone).closed()) GTEST_SKIP() << "the real femur is not closed";
  drill_random_lines(bone, 100);
}

TEST(TunnelsInBones, RealTibia) {
  const TriMesh bone = real("tibia");
  if (bone.triangles.empty()) GTEST_SKIP() << "no real bones: set OSTEON_SHARED";
  if (!topology(bone).closed()) GTEST_SKIP() << "the real tibia is not closed";
  drill_random_lines(bone, 100);
}

}  // namespace
}  // namespace osteon
