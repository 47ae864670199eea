#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <set>

#include "anatomy/morphometry.h"
#include "anatomy/surface_probe.h"
#include "mesh/surface_checks.h"
#include "osteon/anatomy/generate.h"

namespace osteon {
namespace {

const std::filesystem::path kWrist =
    std::filesystem::path(OSTEON_SOURCE_DIR) / "assets/anatomy/wrist.toml";

const GeneratedAnatomy& wrist() {
  static const GeneratedAnatomy grown = [] {
    auto r = generate_anatomy(kWrist);
    if (!r) throw std::runtime_error(r.error().message());
    return std::move(*r);
  }();
  return grown;
}

const std::map<std::string, int> kFmaIds = {
    {"radius", 23463},       {"ulna", 23466},         {"scaphoid", 23709},
    {"lunate", 23712},       {"triquetrum", 23715},   {"pisiform", 23718},
    {"trapezium", 23721},    {"trapezoid", 23724},    {"capitate", 23727},
    {"hamate", 23730},       {"metacarpal_1", 23899}, {"metacarpal_2", 23900},
    {"metacarpal_3", 23901}, {"metacarpal_4", 23902}, {"metacarpal_5", 23903}};

/// Length x width x height, mm; K, +-15 %.
const std::map<std::string, Vec3> kCarpals_mm = {
    {"scaphoid", {26, 14, 12}}, {"lunate", {17, 13, 13}},    {"triquetrum", {18, 13, 12}},
    {"pisiform", {14, 10, 9}},  {"trapezium", {22, 17, 13}}, {"trapezoid", {17, 13, 11}},
    {"capitate", {25, 15, 19}}, {"hamate", {22, 16, 24}}};

TEST(Wrist, HasItsFifteenBonesByNameAndFmaId) {
  std::map<std::string, int> ids;
  for (const GeneratedBone& bone : wrist().bones) ids[bone.name] = bone.fma_id;
  EXPECT_EQ(ids, kFmaIds);
  EXPECT_EQ(wrist().side, "right");
}

TEST(Wrist, BonesAreClosedManifoldSingleAndWhole) {
  for (const GeneratedBone& bone : wrist().bones) {
    SCOPED_TRACE(bone.name);
    EXPECT_TRUE(checks::is_closed_manifold(bone.mesh));
    EXPECT_TRUE(checks::has_single_fans(bone.mesh));
    EXPECT_EQ(checks::euler_number(bone.mesh), 2);
    EXPECT_GT(checks::signed_volume(bone.mesh), 300e-9);
  }
}

TEST(Wrist, CarpalsHaveTheirSizes) {
  for (const auto& [name, table_mm] : kCarpals_mm) {
    SCOPED_TRACE(name);
    const Vec3 got = checks::figures_of(checks::bone_named(wrist(), name)).extents_mm;
    std::array<double, 3> want = {table_mm.x(), table_mm.y(), table_mm.z()};
    std::sort(want.begin(), want.end(), std::greater<>());
    std::printf("%-13s %5.1f x %4.1f x %4.1f mm (table %g x %g x %g)\n", name.c_str(), got.x(),
                got.y(), got.z(), want[0], want[1], want[2]);
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(got[k] / want[static_cast<std::size_t>(k)], 1, 0.15) << "axis " << k;
  }
}

TEST(Wrist, CarpalsStandInTheirOrderOfVolume) {
  const std::array order = {"capitate", "hamate",    "scaphoid",   "trapezium",
                            "lunate",   "trapezoid", "triquetrum", "pisiform"};
  double last = 1e300;
  for (const char* name : order) {
    const double v = checks::figures_of(checks::bone_named(wrist(), name)).volume_mm3;
    std::printf("%-13s %6.0f mm3\n", name, v);
    EXPECT_LT(v, last) << name;
    last = v;
  }
}

TEST(Wrist, MetacarpalsHaveTheirLengths) {
  const std::array<double, 5> want_mm = {43, 67.7, 66.1, 58.0, 52.3};
  for (std::size_t i = 0; i < 5; ++i) {
    const std::string name = "metacarpal_" + std::to_string(i + 1);
    const double got = checks::figures_of(checks::bone_named(wrist(), name)).extents_mm.x();
    std::printf("%-13s %5.1f mm (table %g)\n", name.c_str(), got, want_mm[i]);
    EXPECT_NEAR(got, want_mm[i], 2.0) << name;
  }
}

TEST(Wrist, DistalRadiusLiesWithinOneDeviationOfFilms) {
  const auto f = checks::distal_radius_figures(wrist());
  std::printf(
      "inclination %.1f deg, volar tilt %.1f deg, height %.1f mm, ulnar variance %.2f mm, "
      "width %.1f mm, depth %.1f mm\n",
      f.inclination_deg, f.volar_tilt_deg, f.height_mm, f.ulnar_variance_mm, f.width_mm,
      f.depth_mm);
  EXPECT_NEAR(f.inclination_deg, 24.0, 3.8);
  EXPECT_NEAR(f.volar_tilt_deg, 13.8, 4.4);
  EXPECT_NEAR(f.height_mm, 11.3, 1.7);
  EXPECT_NEAR(f.ulnar_variance_mm, -0.45, 2.0);
  EXPECT_NEAR(f.width_mm / 30, 1, 0.15);
  EXPECT_NEAR(f.depth_mm / 19, 1, 0.15);
}

using Pair = std::pair<std::string, std::string>;

const std::set<Pair> kJoints = {
    {"radius", "scaphoid"},        {"radius", "lunate"},         {"scaphoid", "lunate"},
    {"lunate", "triquetrum"},      {"scaphoid", "trapezium"},    {"scaphoid", "trapezoid"},
    {"scaphoid", "capitate"},      {"lunate", "capitate"},       {"capitate", "hamate"},
    {"triquetrum", "hamate"},      {"triquetrum", "pisiform"},   {"trapezium", "trapezoid"},
    {"trapezoid", "capitate"},     {"radius", "ulna"},           {"trapezium", "metacarpal_1"},
    {"trapezoid", "metacarpal_2"}, {"capitate", "metacarpal_3"}, {"hamate", "metacarpal_4"},
    {"hamate", "metacarpal_5"}};

TEST(Wrist, JointSpacesAreNarrowAndNoTwoBonesOverlap) {
  const auto& bones = wrist().bones;
  std::vector<checks::SurfaceProbe> probes;
  for (const GeneratedBone& bone : bones) probes.emplace_back(bone.mesh, bone.X_WB);
  constexpr double kLimit = 0.003;
  std::size_t joints = 0;
  for (std::size_t i = 0; i < bones.size(); ++i)
    for (std::size_t j = 0; j < bones.size(); ++j) {
      const Aabb near = probes[j].box_W().grown(kLimit);
      double gap = kLimit;
      for (const Vec3& p : probes[i].vertices_W()) {
        if (!near.overlaps({p, p})) continue;
        const double d = probes[j].distance(p, kLimit);
        gap = std::min(gap, probes[j].inside(p) ? -d : d);
      }
      EXPECT_TRUE(i == j || gap > -0.0001) << bones[i].name << " in " << bones[j].name;
      if (!kJoints.contains({bones[i].name, bones[j].name})) continue;
      ++joints;
      std::printf("%-13s %-13s %.2f mm\n", bones[i].name.c_str(), bones[j].name.c_str(), gap * 1e3);
      EXPECT_GE(gap, 0.0005) << bones[i].name << " - " << bones[j].name;
      EXPECT_LE(gap, 0.0025) << bones[i].name << " - " << bones[j].name;
    }
  EXPECT_EQ(joints, kJoints.size());
}

Vec3 landmark(const std::string& name) {
  for (const GeneratedLandmark& l : wrist().landmarks)
    if (l.name == name) return l.p_W;
  ADD_FAILURE() << "no landmark " << name;
  return Vec3::Zero();
}

TEST(Wrist, BonyLandmarksLieOnTheirBones) {
  const std::pair<const char*, const char*> places[] = {
      {"lister_tubercle", "radius"}, {"radial_styloid", "radius"}, {"ulnar_styloid", "ulna"}};
  for (const auto& [name, bone_name] : places) {
    const GeneratedBone& bone = checks::bone_named(wrist(), bone_name);
    EXPECT_LT(checks::SurfaceProbe(bone.mesh, bone.X_WB).distance(landmark(name), 0.01), 0.001)
        << name;
  }
}

TEST(Wrist, PortalsLieOverTheirJointsOffBone) {
  const Vec3 lister = landmark("lister_tubercle");
  EXPECT_NEAR(landmark("portal_3_4").x() - lister.x(), 0.010, 0.003);
  EXPECT_NEAR(landmark("portal_mcr").x() - landmark("portal_3_4").x(), 0.010, 0.002);
  EXPECT_LT(landmark("portal_4_5").y(), landmark("portal_3_4").y());
  EXPECT_LT(landmark("portal_6r").y(), landmark("portal_4_5").y());
  for (const GeneratedBone& bone : wrist().bones) {
    const checks::SurfaceProbe probe(bone.mesh, bone.X_WB);
    for (const char* name : {"portal_3_4", "portal_4_5", "portal_6r", "portal_mcr", "portal_mcu"}) {
      EXPECT_FALSE(probe.inside(landmark(name))) << name << " in " << bone.name;
      EXPECT_GT(probe.distance(landmark(name), 0.004), 0.0015) << name << " at " << bone.name;
    }
  }
}

TEST(Wrist, GrowsTheSameBytesEachTime) {
  GenerateOptions bones_alone;
  bones_alone.soft_parts = false;
  const auto again = generate_anatomy(kWrist, bones_alone);
  ASSERT_TRUE(again);
  Hasher first, second;
  for (const GeneratedBone& bone : wrist().bones) first.add(checks::hash_of(bone.mesh));
  for (const GeneratedBone& bone : again->bones) second.add(checks::hash_of(bone.mesh));
  std::printf("hash of the wrist's surfaces: %016llx\n",
              static_cast<unsigned long long>(first.value()));
  EXPECT_EQ(first.value(), second.value());
}

TEST(Wrist, CoarserCellsGiveFewerTrianglesAndTheSameBones) {
  GenerateOptions coarse;
  coarse.cell_m = 0.0012;
  coarse.soft_parts = false;
  const auto grown = generate_anatomy(kWrist, coarse);
  ASSERT_TRUE(grown) << grown.error().message();
  for (std::size_t i = 0; i < grown->bones.size(); ++i) {
    const TriMesh& mesh = grown->bones[i].mesh;
    EXPECT_TRUE(checks::is_closed_manifold(mesh));
    EXPECT_LT(2 * mesh.triangles.size(), wrist().bones[i].mesh.triangles.size());
    EXPECT_NEAR(checks::signed_volume(mesh) / checks::signed_volume(wrist().bones[i].mesh), 1,
                0.03);
  }
}

}  // namespace
}  // namespace osteon
