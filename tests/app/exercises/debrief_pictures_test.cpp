#include "exercises/debrief_pictures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/loops/fake_device.h"
#include "mesh/surface_checks.h"

namespace osteon {
namespace {

// In the report of a whole reconstruction `acl.graft` is what holds the graft.
TEST(DebriefReport, TellsTheGraftThatWasMadeAtABench) {
  Debrief debrief;
  debrief.outcome.emplace();
  debrief.reports.emplace_back();
  EXPECT_EQ(report_of(debrief).find("\"acl\""), std::string::npos);
  debrief.graft.emplace();
  debrief.graft->plan.channel_m = 0.03125;
  const auto alone = nlohmann::json::parse(report_of(debrief))["acl"];
  EXPECT_EQ(alone["graft"]["channel_mm"], 31.25) << alone;
  EXPECT_FALSE(alone.contains("made"));
  debrief.acl.emplace();
  const auto whole = nlohmann::json::parse(report_of(debrief))["acl"];
  EXPECT_EQ(whole["made"]["channel_mm"], 31.25) << whole;
}

TEST(DebriefPictures, ATubeNeedsTwoPlaces) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(tube_along({}, 0.001, 6).triangles.empty());
  const Vec3 same[] = {Vec3(1, 2, 3), Vec3(1, 2, 3)};
  EXPECT_TRUE(tube_along(same, 0.001, 6).triangles.empty());
  const Vec3 lost[] = {Vec3(1, 2, 3), Vec3(nan, 2, 3)};
  EXPECT_TRUE(tube_along(lost, 0.001, 6).triangles.empty());
}

TEST(DebriefPictures, AStraightTubeIsAClosedPrism) {
  const Vec3 line[] = {Vec3(0, 0, 0), Vec3(0, 0, 0.01), Vec3(0, 0, 0.03)};
  const TriMesh tube = tube_along(line, 0.002, 6);
  EXPECT_TRUE(checks::is_closed_manifold(tube));
  // A hexagon's area is 1.5 sqrt(3) r^2.
  EXPECT_NEAR(checks::signed_volume(tube), 1.5 * std::sqrt(3.0) * 4e-6 * 0.03, 1e-12);
}

TEST(DebriefPictures, ATubeStaysWholeWhereTheWayTurnsBack) {
  std::vector<Vec3> line;
  for (int i = 0; i <= 10; ++i) line.emplace_back(0.001 * i, 0, 0);
  for (int i = 9; i >= 0; --i) line.emplace_back(0.001 * i, 0, 0);
  const TriMesh tube = tube_along(line, 0.0005, 5);
  EXPECT_TRUE(checks::is_closed_manifold(tube));
  for (const Vec3& v : tube.vertices) EXPECT_TRUE(is_finite(v));
}

TEST(DebriefPictures, SurfacesAreColouredWhereDamageIs) {
  const auto the_case = test::blocks_case();
  PreparedCase prepared = prepare_unlit(*the_case);
  DamageMap map(2);
  DamageSpot spot;
  spot.p_B = Vec3(0.010, 0.010, 0.010);  // a corner of "near"
  spot.force_n = 2;
  map[0].push_back(spot);
  color_by_damage(map, DamageKind::kForce, prepared);
  int coloured = 0;
  for (std::size_t v = 0; v < prepared.bones[0].shades.size(); ++v) {
    const auto& p = prepared.bones[0].positions[v];
    const bool there = p[0] > 0 && p[1] > 0 && p[2] > 0;
    EXPECT_EQ(prepared.bones[0].shades[v].felt, there ? 128 + 64 : 128);
    coloured += there ? 1 : 0;
  }
  EXPECT_GT(coloured, 0);
  for (const auto& shade : prepared.bones[1].shades) EXPECT_EQ(shade.felt, 128);
}

TEST(DebriefPictures, BeadsStandWhereDamageIsInThreeSteps) {
  Debrief debrief;
  debrief.the_case = test::blocks_case();
  debrief.damage.resize(2);
  EXPECT_TRUE(damage_marks(debrief, DamageKind::kForce).empty());
  for (const double n : {0.1, 0.5, 2.0, 9.0}) {
    DamageSpot spot;
    spot.force_n = n;
    spot.p_B = Vec3(0, 0, 0.010);
    debrief.damage[1].push_back(spot);
  }
  const auto marks = damage_marks(debrief, DamageKind::kForce);
  ASSERT_EQ(marks.size(), 3u) << "a tenth of a newton is not shown";
  for (const SolidMark& mark : marks) {
    EXPECT_TRUE(checks::is_closed_manifold(mark.mesh_W));
    EXPECT_GT(checks::signed_volume(mark.mesh_W), 0);
    Vec3 middle = Vec3::Zero();
    for (const Vec3& v : mark.mesh_W.vertices) middle += v / 6;
    EXPECT_NEAR((middle - Vec3(0.03, 0, 0)).norm(), 0, 1e-12);
  }
  EXPECT_TRUE(damage_marks(debrief, DamageKind::kHeat).empty());
}

TEST(DebriefPictures, TheCameraLooksAtTheDamageFromOutside) {
  Debrief debrief;
  debrief.the_case = test::blocks_case();
  debrief.damage.resize(2);
  EXPECT_EQ(camera_at_damage(debrief, DamageKind::kForce, 1).target_W,
            preset_camera(ViewPreset::kDorsal, *debrief.the_case, 1).target_W)
      << "nothing to look at: the whole case";
  DamageSpot spot;
  spot.n_B = Vec3::UnitX();
  spot.force_n = 4;
  spot.p_B = Vec3(0.010, 0.002, 0);
  debrief.damage[1].push_back(spot);
  spot.p_B.y() = -0.002;
  debrief.damage[1].push_back(spot);
  const Camera camera = camera_at_damage(debrief, DamageKind::kForce, 1);
  EXPECT_NEAR((camera.target_W - Vec3(0.040, 0, -0.010)).norm(), 0, 1e-9);
  EXPECT_GT((camera.eye_W() - camera.target_W).normalized().x(), 0.99);
}

}  // namespace
}  // namespace osteon
