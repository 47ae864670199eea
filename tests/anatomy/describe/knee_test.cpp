#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "anatomy/anatomy_assets.h"
#include "anatomy/knee_figures.h"
#include "anatomy/surface_probe.h"
#include "mesh/shapes.h"
#include "mesh/surface_checks.h"
#include "osteon/anatomy/bone_gaps.h"
#include "osteon/anatomy/likeness.h"
#include "osteon/anatomy/variation.h"
#include "osteon/mesh/distance.h"
#include "osteon/mesh/mesh_io.h"

namespace osteon {
namespace {

VariedAnatomy varied(const VariationRequest& request, std::optional<double> cell_m = {}) {
  GenerateOptions options;
  options.cell_m = cell_m;
  options.soft_parts = false;
  auto r = generate_varied(kAnatomyAssets / "knee.toml", kAnatomyAssets / "knee_variation.toml",
                           request, options);
  if (!r) throw std::runtime_error(r.error().message());
  return std::move(*r);
}

const GeneratedAnatomy& knee() {
  static const GeneratedAnatomy grown = varied({{}, {}, ""}).anatomy;
  return grown;
}

std::uint64_t hash_of(const GeneratedAnatomy& anatomy) {
  Hasher hasher;
  for (const GeneratedBone& bone : anatomy.bones) hasher.add(checks::hash_of(bone.mesh));
  return hasher.value();
}

checks::NotchFigures notch_of(const GeneratedAnatomy& anatomy) {
  const MeshDistance femur(checks::bone_named(anatomy, "femur").mesh);
  return checks::notch_figures(
      anatomy, [&](const Vec3& p_W) { return femur.closest(p_W).signed_distance < 0; });
}

double slope_of(const GeneratedAnatomy& anatomy) {
  const MeshDistance tibia(checks::bone_named(anatomy, "tibia").mesh);
  return checks::plateau_slope_deg(
      anatomy, [&](const Vec3& p_W) { return tibia.closest(p_W).signed_distance < 0; });
}

TEST(Knee, HasItsFourBonesByNameAndFmaId) {
  std::map<std::string, int> ids;
  for (const GeneratedBone& bone : knee().bones) ids[bone.name] = bone.fma_id;
  EXPECT_EQ(ids, (std::map<std::string, int>{
                     {"femur", 9611}, {"tibia", 24476}, {"fibula", 24479}, {"patella", 24485}}));
  EXPECT_EQ(knee().side, "right");
}

TEST(Knee, BonesAreClosedManifoldSingleAndWhole) {
  for (const GeneratedBone& bone : knee().bones) {
    SCOPED_TRACE(bone.name);
    EXPECT_TRUE(checks::is_closed_manifold(bone.mesh));
    EXPECT_TRUE(checks::has_single_fans(bone.mesh));
    EXPECT_EQ(checks::euler_number(bone.mesh), 2);
    EXPECT_GT(checks::signed_volume(bone.mesh), 5e-6);
  }
}

/// The series give women and men apart: what stands for both lies between their means.
TEST(Knee, FemurHasItsPublishedFigures) {
  const auto f = checks::femur_figures(knee());
  std::printf(
      "length %.1f mm, bicondylar width %.1f mm, condyle depth %.1f mm, head %.1f mm, neck-shaft "
      "%.1f deg, torsion %.1f deg, antecurvation radius %.0f mm\n",
      f.length_mm, f.bicondylar_mm, f.condyle_depth_mm, f.head_mm, f.neck_shaft_deg, f.torsion_deg,
      f.bow_mm);
  EXPECT_NEAR(f.length_mm, 413, 28);
  EXPECT_GT(f.bicondylar_mm, 78.5);
  EXPECT_LT(f.bicondylar_mm, 88.6);
  EXPECT_GT(f.condyle_depth_mm, 56);
  EXPECT_LT(f.condyle_depth_mm, 61.5);
  EXPECT_NEAR(f.head_mm, 47, 2);
  EXPECT_GT(f.neck_shaft_deg, 122);
  EXPECT_LT(f.neck_shaft_deg, 129);
  EXPECT_NEAR(f.torsion_deg, 14, 3);
  EXPECT_NEAR(f.bow_mm / 943, 1, 0.15);
}

TEST(Knee, NotchHasItsPublishedFigures) {
  const auto n = notch_of(knee());
  std::printf("notch width %.1f mm, depth %.1f mm\n", n.width_mm, n.depth_mm);
  EXPECT_GT(n.width_mm, 18.7);
  EXPECT_LT(n.width_mm, 22.0);
  EXPECT_GT(n.depth_mm, 23.7);
  EXPECT_LT(n.depth_mm, 27.8);
}

TEST(Knee, PlateauHasItsPublishedFigures) {
  const auto t = checks::tibia_figures(knee());
  const double slope = slope_of(knee());
  std::printf("plateau %.1f x %.1f mm, slope %.1f deg\n", t.width_mm, t.depth_mm, slope);
  EXPECT_GT(t.width_mm, 68.8);
  EXPECT_LT(t.width_mm, 76.4);
  EXPECT_GT(t.depth_mm, 45.7);
  EXPECT_LT(t.depth_mm, 51.3);
  EXPECT_NEAR(slope, 7, 2.5);
}

/// Bone to bone: two layers of cartilage of about 2 mm at the joint surfaces.
TEST(Knee, JointSpacesHoldTheCartilageAndNoTwoBonesOverlap) {
  std::vector<TriMesh> meshes_W;
  for (const GeneratedBone& bone : knee().bones) meshes_W.push_back(bone.mesh);
  std::map<std::pair<std::string, std::string>, double> gaps_mm;
  for (const BoneGap& gap : bone_gaps(meshes_W, 0.006)) {
    const auto& a = knee().bones[gap.first].name;
    const auto& b = knee().bones[gap.second].name;
    gaps_mm[{a, b}] = gap.gap_m * 1e3;
    std::printf("%-8s %-8s %.2f mm\n", a.c_str(), b.c_str(), gap.gap_m * 1e3);
  }
  EXPECT_NEAR((gaps_mm.at({"femur", "tibia"})), 4.2, 0.5);
  EXPECT_NEAR((gaps_mm.at({"femur", "patella"})), 4.2, 0.5);
  EXPECT_NEAR((gaps_mm.at({"tibia", "fibula"})), 1.5, 0.5);
}

TEST(Knee, LandmarksOfBonesLieOnThem) {
  const std::pair<const char*, const char*> places[] = {{"blumensaat_posterior", "femur"},
                                                        {"blumensaat_anterior", "femur"},
                                                        {"acl_femur", "femur"},
                                                        {"acl_femur_am", "femur"},
                                                        {"acl_femur_pl", "femur"},
                                                        {"acl_tibia", "tibia"},
                                                        {"pcl_femur", "femur"},
                                                        {"pcl_tibia", "tibia"},
                                                        {"tibial_tubercle", "tibia"},
                                                        {"medial_epicondyle", "femur"},
                                                        {"lateral_epicondyle", "femur"},
                                                        {"greater_trochanter_tip", "femur"},
                                                        {"patella_apex", "patella"}};
  for (const auto& [name, bone] : places) {
    const MeshDistance surface(checks::bone_named(knee(), bone).mesh);
    EXPECT_LT(std::abs(surface.closest(checks::landmark_of(knee(), name)).signed_distance), 0.001)
        << name;
  }
}

TEST(Knee, LigamentRunsAndPortalsAreWhereTheyShouldBe) {
  const Vec3 femur = checks::landmark_of(knee(), "acl_femur");
  const Vec3 tibia = checks::landmark_of(knee(), "acl_tibia");
  const double length_mm = (femur - tibia).norm() * 1e3;
  std::printf("ACL %.1f mm\n", length_mm);
  EXPECT_GT(length_mm, 22);
  EXPECT_LT(length_mm, 41);
  EXPECT_LT(femur.y(), 0) << "on the lateral wall";
  EXPECT_LT(femur.z(), tibia.z()) << "runs forwards and down";
  for (const char* name : {"portal_al", "portal_am"})
    for (const GeneratedBone& bone : knee().bones) {
      const double d =
          MeshDistance(bone.mesh).closest(checks::landmark_of(knee(), name)).signed_distance;
      EXPECT_GT(d, 0.005) << name << " at " << bone.name;
    }
}

TEST(Knee, IsLikeTheReferenceBones) {
  const auto folder = test::shared_folder() / "anatomy/knee";
  if (!std::filesystem::is_directory(folder))
    GTEST_SKIP() << "no reference bones; OSTEON_SHARED names the folder that holds anatomy/knee";
  const std::tuple<const char*, double, double> ends[] = {
      {"femur", 0.1, 1}, {"tibia", 0.09, -1}, {"patella", 0, 0}};
  for (const auto& [name, end_m, towards] : ends) {
    const auto reference = load_mesh(folder / (std::string(name) + ".stl"), 1);
    ASSERT_TRUE(reference) << reference.error().message();
    LikenessOptions options;
    options.end_m = end_m;
    options.towards_end_B = Vec3(towards, 0, 0);
    const auto got = compare_surfaces(checks::bone_named(knee(), name).mesh, *reference, options);
    std::printf("%-8s mean %.2f mm, 95 %% %.2f mm\n", name, got.mean_m * 1e3, got.p95_m * 1e3);
    EXPECT_LE(got.mean_m, 0.0025) << name;
  }
}

constexpr double kCoarse_m = 0.003;  // enough to measure how a parameter acts

TEST(Knee, NotchWidthIsWhatIsAskedFor) {
  for (const double width : {17.0, 24.0}) {
    const auto n = notch_of(varied({{}, {{"notch_width_mm", width}}, ""}, kCoarse_m).anatomy);
    EXPECT_NEAR(n.width_mm, width, 1.0);
    EXPECT_NEAR(n.depth_mm, notch_of(knee()).depth_mm, 0.5);
  }
}

TEST(Knee, TibialSlopeIsWhatIsAskedFor) {
  for (const double slope : {3.0, 11.0})
    EXPECT_NEAR(slope_of(varied({{}, {{"tibial_slope_deg", slope}}, ""}, kCoarse_m).anatomy), slope,
                1.2);
}

TEST(Knee, CondylesAndAllGrowAsAskedFor) {
  const GeneratedAnatomy coarse = varied({{}, {}, ""}, kCoarse_m).anatomy;
  const auto plain = checks::femur_figures(coarse);
  const auto large =
      checks::femur_figures(varied({{}, {{"condyle_size_percent", 106}}, ""}, kCoarse_m).anatomy);
  EXPECT_NEAR(large.bicondylar_mm / plain.bicondylar_mm, 1.06, 0.01);
  EXPECT_NEAR(large.head_mm, plain.head_mm, 0.3);
  const GeneratedAnatomy small =
      varied({{}, {{"size_percent", 90}, {"notch_width_mm", 0.9 * 20.4}}, ""}, kCoarse_m).anatomy;
  for (std::size_t i = 0; i < small.bones.size(); ++i)
    EXPECT_NEAR(checks::signed_volume(small.bones[i].mesh) /
                    checks::signed_volume(coarse.bones[i].mesh) / (0.9 * 0.9 * 0.9),
                1, 0.02);
}

TEST(Knee, ASeedGivesTheSameKneeAgainAndItsBonesPart) {
  const VariedAnatomy a = varied({7, {}, ""}, kCoarse_m), b = varied({7, {}, ""}, kCoarse_m);
  EXPECT_EQ(hash_of(a.anatomy), hash_of(b.anatomy));
  EXPECT_NE(hash_of(a.anatomy), hash_of(knee()));
  std::vector<TriMesh> meshes_W;
  for (const GeneratedBone& bone : a.anatomy.bones) {
    EXPECT_TRUE(checks::is_closed_manifold(bone.mesh)) << bone.name;
    meshes_W.push_back(bone.mesh);
  }
  EXPECT_TRUE(bone_gaps(meshes_W, 0).empty());
  std::printf("hash of the knee: %016llx, of seed 7: %016llx\n",
              static_cast<unsigned long long>(hash_of(knee())),
              static_cast<unsigned long long>(hash_of(a.anatomy)));
}

}  // namespace
}  // namespace osteon
