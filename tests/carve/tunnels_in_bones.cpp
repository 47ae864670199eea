// Tunnels along random lines through the built-in and the real femur and tibia, each compared with
// CGAL: takes minutes.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

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

/// A line by a random vertex of the bone: through it, past it at about the drill's radius, or
/// beginning or ending in the bone.
TunnelLine random_line(const TriMesh& bone, Random& random) {
  const auto vertex =
      static_cast<std::size_t>(random.uniform(0, static_cast<double>(bone.vertices.size())));
  const Vec3 along = random.direction();
  const double diameter = random.uniform(2e-3, 12e-3);
  const double aside = random.uniform(0, 0.55) * diameter;
  const double before = random.uniform(-5e-3, 100e-3), beyond = random.uniform(5e-3, 100e-3);
  const Vec3 at = bone.vertices[vertex] + aside * along.unitOrthogonal();
  return {at - before * along, at + beyond * along, diameter};
}

void drill_random_lines(const TriMesh& bone, int count) {
  Random random(15);
  const double whole = volume(bone);
  for (int i = 0; i < count; ++i) {
    const TunnelLine line = random_line(bone, random);
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
