#include <gtest/gtest.h>

#include <cstdio>
#include <set>

#include "anatomy/anatomy_assets.h"
#include "anatomy/soft/soft_checks.h"
#include "osteon/anatomy/variation.h"

namespace osteon {
namespace {

/// Coarse bones are enough for what holds for every patient.
GenerateOptions coarse() {
  GenerateOptions options;
  options.cell_m = 0.0012;
  return options;
}

GeneratedAnatomy patient(const VariationRequest& request, const GenerateOptions& options) {
  auto r = generate_varied(kAnatomyAssets / "wrist.toml", kAnatomyAssets / "wrist_variation.toml",
                           request, options);
  if (!r) throw std::runtime_error(r.error().message());
  return std::move(r->anatomy);
}

const GeneratedAnatomy& soft_wrist() {
  static const GeneratedAnatomy grown = patient({{}, {}, ""}, {});
  return grown;
}

Vec3 landmark(const GeneratedAnatomy& anatomy, const std::string& name) {
  for (const GeneratedLandmark& l : anatomy.landmarks)
    if (l.name == name) return l.p_W;
  throw std::out_of_range(name);
}

TEST(WristSoft, HasWhatAnArthroscopyLooksAt) {
  std::set<std::string> names;
  for (const GeneratedSoft& soft : soft_wrist().softs) names.insert(soft.name);
  for (const char* name : {"scaphoid_fossa",
                           "lunate_fossa",
                           "tfcc_disc",
                           "scapholunate_dorsal",
                           "scapholunate_proximal",
                           "scapholunate_volar",
                           "lunotriquetral_dorsal",
                           "lunotriquetral_volar",
                           "radioscaphocapitate",
                           "long_radiolunate",
                           "short_radiolunate",
                           "ulnolunate",
                           "ulnotriquetral",
                           "dorsal_radiocarpal",
                           "dorsal_intercarpal",
                           "triquetrohamate",
                           "triquetrocapitate",
                           "scaphocapitate",
                           "scaphotrapezial",
                           "capitohamate_volar",
                           "capitohamate_dorsal",
                           "capitotrapezoid_dorsal",
                           "trapeziotrapezoid_dorsal",
                           "skin"})
    EXPECT_TRUE(names.contains(name)) << name;
}

TEST(WristSoft, IsSound) {
  checks::expect_sound_softs(soft_wrist());
  checks::expect_layers_apart(soft_wrist());
}

TEST(WristSoft, CartilageEndsWithoutALedge) { checks::expect_no_ledges(soft_wrist()); }

TEST(WristSoft, RimsOfCartilageAreSmoothCurves) { checks::expect_smooth_rims(soft_wrist(), 7); }

/// 0.8 mm (K) where the joint has room; the radiocarpal joint has.
TEST(WristSoft, CartilageIsAsThickAsTheJointHasRoomFor) {
  for (const GeneratedSoft& soft : soft_wrist().softs) {
    if (soft.kind != "cartilage") continue;
    const double height = checks::height_of(soft_wrist(), soft.name);
    std::printf("%-24s %.2f mm\n", soft.name.c_str(), height * 1e3);
    EXPECT_GT(height, 0.5e-3) << soft.name;
    EXPECT_LE(height, 0.8001e-3) << soft.name;
  }
  EXPECT_GT(checks::height_of(soft_wrist(), "scaphoid_fossa"), 0.75e-3);
}

TEST(WristSoft, BandsJoinTheBonesThatTheirNamesSay) {
  const std::tuple<const char*, const char*, const char*> bands[] = {
      {"scapholunate_dorsal", "scaphoid", "lunate"},
      {"lunotriquetral_volar", "lunate", "triquetrum"},
      {"radioscaphocapitate", "radius", "capitate"},
      {"long_radiolunate", "radius", "lunate"},
      {"short_radiolunate", "radius", "lunate"},
      {"ulnolunate", "ulna", "lunate"},
      {"ulnotriquetral", "ulna", "triquetrum"},
      {"dorsal_radiocarpal", "radius", "triquetrum"},
      {"dorsal_intercarpal", "triquetrum", "scaphoid"},
      {"triquetrohamate", "triquetrum", "hamate"},
      {"triquetrocapitate", "triquetrum", "capitate"},
      {"scaphocapitate", "scaphoid", "capitate"},
      {"scaphotrapezial", "scaphoid", "trapezium"},
      {"capitohamate_volar", "capitate", "hamate"},
      {"capitohamate_dorsal", "capitate", "hamate"},
      {"capitotrapezoid_dorsal", "capitate", "trapezoid"},
      {"trapeziotrapezoid_dorsal", "trapezoid", "trapezium"}};
  for (const auto& [name, from, to] : bands) {
    const GeneratedSoft& band = checks::soft_named(soft_wrist(), name);
    ASSERT_EQ(band.attachments.size(), 2u) << name;
    EXPECT_EQ(band.attachments[0].bone, from) << name;
    EXPECT_EQ(band.attachments[1].bone, to) << name;
  }
}

/// The disc lies between the ulna's head and the lunate and triquetrum.
TEST(WristSoft, TheDiscLiesBetweenUlnaAndCarpus) {
  const TriMesh& disc = checks::soft_named(soft_wrist(), "tfcc_disc").mesh_W;
  Aabb box;
  for (const Vec3& v : disc.vertices) box.include(v);
  std::printf("disc %.1f x %.1f x %.1f mm\n", box.extent().x() * 1e3, box.extent().y() * 1e3,
              box.extent().z() * 1e3);
  EXPECT_LT(box.extent().x(), 0.006);
  EXPECT_GT(box.extent().y(), 0.012);
  EXPECT_GT(box.extent().z(), 0.009);
  const auto bones = checks::bone_surfaces_W(soft_wrist());
  for (std::size_t i = 0; i < bones.size(); ++i) {
    if (soft_wrist().bones[i].name != "ulna" && soft_wrist().bones[i].name != "radius") continue;
    double nearest = 1;
    for (const Vec3& p : disc.vertices)
      nearest = std::min(nearest, std::abs(bones[i].closest(p).signed_distance));
    EXPECT_LT(nearest, 0.0009) << "at the " << soft_wrist().bones[i].name;
  }
}

constexpr double kSkinMesh_m = 1.5e-4;  // its triangles are chords of the skin

// The way in is against the surface's mean normal about the portal.
TEST(WristSoft, PortalsPointIntoTheSkin) {
  const TriMesh& skin = checks::soft_named(soft_wrist(), "skin").mesh_W;
  for (const GeneratedLandmark& l : soft_wrist().landmarks) {
    if (l.name.rfind("portal_", 0) != 0) {
      EXPECT_EQ(l.inwards_W, Vec3(Vec3::Zero())) << l.name;
      continue;
    }
    Vec3 out = Vec3::Zero();
    for (const Triangle& t : skin.triangles) {
      const Vec3 &a = skin.vertices[t[0]], &b = skin.vertices[t[1]], &c = skin.vertices[t[2]];
      if (((a + b + c) / 3 - l.p_W).norm() < 0.005) out += (b - a).cross(c - a);
    }
    EXPECT_NEAR(l.inwards_W.norm(), 1, 1e-12) << l.name;
    EXPECT_LT(std::acos(std::min(1.0, -l.inwards_W.dot(out.normalized()))), 0.08) << l.name;
  }
}

// Runs that nobody looks at grow no skin: their portals are the same to the bit.
TEST(WristSoft, PortalsLieWhereTheyDoWithoutSoftParts) {
  GenerateOptions bare;
  bare.soft_parts = false;
  bare.cell_m = 0.003;
  const GeneratedAnatomy bones = patient({{}, {}, ""}, bare);
  ASSERT_TRUE(bones.softs.empty());
  ASSERT_EQ(bones.landmarks.size(), soft_wrist().landmarks.size());
  int portals = 0;
  for (std::size_t i = 0; i < bones.landmarks.size(); ++i) {
    const GeneratedLandmark &a = bones.landmarks[i], &b = soft_wrist().landmarks[i];
    if (a.name.rfind("portal_", 0) != 0) continue;
    ++portals;
    EXPECT_EQ(a.p_W, b.p_W) << a.name;
    EXPECT_EQ(a.inwards_W, b.inwards_W) << a.name;
  }
  EXPECT_EQ(portals, 5);
}

TEST(WristSoft, PortalsLieOnTheSkinAndFossaCentresOnTheirCartilage) {
  const MeshDistance skin(checks::soft_named(soft_wrist(), "skin").mesh_W);
  for (const char* name : {"portal_3_4", "portal_4_5", "portal_6r", "portal_mcr", "portal_mcu"})
    EXPECT_LT(std::abs(skin.closest(landmark(soft_wrist(), name)).signed_distance), kSkinMesh_m)
        << name;
  for (const char* fossa : {"scaphoid_fossa", "lunate_fossa"}) {
    const MeshDistance surface(checks::soft_named(soft_wrist(), fossa).mesh_W);
    const Vec3 center = landmark(soft_wrist(), std::string(fossa) + "_center");
    EXPECT_LT(std::abs(surface.closest(center).signed_distance), 1e-6) << fossa;
  }
}

TEST(WristSoft, TheSkinHoldsEverything) {
  const MeshDistance skin(checks::soft_named(soft_wrist(), "skin").mesh_W);
  for (const MeshDistance& bone : checks::bone_surfaces_W(soft_wrist()))
    for (std::size_t k = 0; k < bone.mesh().vertices.size(); k += 37)
      EXPECT_LT(skin.closest(bone.mesh().vertices[k]).signed_distance, 0.0002);
}

TEST(WristSoft, RandomPatientsAreSoundAndTheOtherSideIsTheMirrorImage) {
  const GeneratedAnatomy right = patient({7, {}, ""}, coarse());
  checks::expect_sound_softs(right);
  std::printf("hash of the soft parts of seed 7: %016llx\n",
              static_cast<unsigned long long>(checks::hash_of_softs(right)));
  const GeneratedAnatomy left = patient({7, {}, "left"}, coarse());
  for (std::size_t i = 0; i < right.softs.size(); ++i) {
    const auto& a = right.softs[i].mesh_W.vertices;
    const auto& b = left.softs[i].mesh_W.vertices;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) ASSERT_EQ(b[k], Vec3(a[k].x(), -a[k].y(), a[k].z()));
    EXPECT_GT(checks::signed_volume(left.softs[i].mesh_W), 0) << "faces outwards";
  }
}

/// What runs in parallel, in whatever order, gives the same bytes.
TEST(WristSoft, TheOrderOfTasksChangesNothing) {
  GenerateOptions backwards = coarse();
  backwards.run = [](std::size_t count, const std::function<void(std::size_t)>& task,
                     const std::function<void(double)>&) {
    for (std::size_t i = count; i-- > 0;) task(i);
  };
  const auto forwards = generate_anatomy(kAnatomyAssets / "wrist.toml", coarse());
  const auto again = generate_anatomy(kAnatomyAssets / "wrist.toml", backwards);
  ASSERT_TRUE(again && forwards) << again.error().message();
  EXPECT_EQ(checks::hash_of_softs(*again), checks::hash_of_softs(*forwards));
}

}  // namespace
}  // namespace osteon
