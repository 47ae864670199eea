// Findings, measured on what has grown. The wrist is grown coarsely and with the soft parts alone
// that a test looks at.
#include "osteon/anatomy/findings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <set>

#include "anatomy/anatomy_assets.h"
#include "anatomy/morphometry.h"
#include "anatomy/soft/soft_checks.h"
#include "anatomy/surface_probe.h"
#include "bone/grow.h"
#include "bone/largest_piece.h"
#include "finding/apply_findings.h"
#include "finding/displace.h"
#include "mesh/surface_checks.h"
#include "osteon/anatomy/bone_gaps.h"
#include "osteon/anatomy/variation.h"
#include "osteon/base/file.h"
#include "osteon/mesh/self_crossing.h"
#include "recognise/split_bones.h"
#include "soft/soft_grow.h"

namespace osteon {
namespace {

AnatomyDescription description_of(const std::string& anatomy) {
  const auto file = kAnatomyAssets / (anatomy + ".toml");
  auto parsed = parse_description(read_file(file, 1 << 22).value(), file.string());
  if (!parsed) throw std::runtime_error(parsed.error().message());
  return std::move(*parsed);
}

/// A knee's long bones end 60 mm from the joint, which is quicker.
void cut_shafts(AnatomyDescription& anatomy) {
  for (BoneDescription& bone : anatomy.bones) {
    const double side = bone.name == "femur" ? 1 : bone.name == "tibia" ? -1 : 0;
    if (side == 0) continue;
    const Vec3 at_W(-0.06 * side, 0, 0);
    HalfSpace shaft;
    shaft.point = bone.R_WB.transpose() * (at_W - bone.p_WB);
    shaft.normal = bone.R_WB.transpose() * Vec3(side, 0, 0);
    Part& part = bone.solid.parts.emplace_back(bone.solid.parts.back());
    part.operation = Operation::kCut;
    part.primitive.emplace<HalfSpace>(shaft);
    part.blend = 0;
  }
}

/// The anatomy with these findings and no soft parts but those that are named. Bones are grown
/// coarsely but for the `fine` ones.
GeneratedAnatomy grown(const std::string& name, const std::vector<FindingChoice>& findings,
                       const std::set<std::string>& softs, const std::set<std::string>& fine = {}) {
  AnatomyDescription anatomy = description_of(name);
  const auto table = load_findings(kAnatomyAssets / (name + "_findings.toml"));
  if (!table) throw std::runtime_error(table.error().message());
  const auto applied = apply_findings(*table, findings, anatomy);
  if (!applied) throw std::runtime_error(applied.error().message());
  std::erase_if(anatomy.softs, [&](const auto& soft) { return !softs.contains(soft.name); });
  anatomy.landmarks.clear();
  for (BoneDescription& b : anatomy.bones) b.cell_m = fine.contains(b.name) ? 0.0014 : 0.002;
  cut_shafts(anatomy);
  const GenerateOptions options;
  auto grown = grow_bones(anatomy, options, name);
  if (!grown) throw std::runtime_error(grown.error().message());
  for (const auto& ok :
       {grow_soft_parts(anatomy, options, name, *grown), split_bones(anatomy, name, *grown)})
    if (!ok) throw std::runtime_error(ok.error().message());
  return std::move(*grown);
}

const GeneratedBone& bone(const GeneratedAnatomy& anatomy, const std::string& name) {
  return checks::bone_named(anatomy, name);
}

TriMesh in_world(const GeneratedBone& bone) {
  TriMesh mesh_W = bone.mesh;
  for (Vec3& v : mesh_W.vertices) v = bone.X_WB * v;
  return mesh_W;
}

double gap_mm(const TriMesh& a, const TriMesh& b) {
  const MeshDistance surface(a);
  double least = 1;
  for (const Vec3& v : b.vertices) least = std::min(least, surface.closest(v).signed_distance);
  return least * 1000;
}

std::size_t pieces_of(const TriMesh& mesh) { return largest_pieces(mesh, 1000).size(); }

void expect_whole(const TriMesh& mesh, const std::string& what) {
  EXPECT_TRUE(checks::is_closed_manifold(mesh)) << what;
  EXPECT_TRUE(checks::has_single_fans(mesh)) << what;
  EXPECT_GT(checks::signed_volume(mesh), 1e-9) << what;
  EXPECT_EQ(self_crossings(mesh).size(), 0u) << what;
}

std::string complaint(const std::vector<FindingChoice>& findings) {
  AnatomyDescription anatomy = description_of("wrist");
  const auto table = load_findings(kAnatomyAssets / "wrist_findings.toml");
  const auto applied = apply_findings(*table, findings, anatomy);
  return applied ? "" : applied.error().message();
}

TEST(Findings, UnknownOnesAndUnknownGradesListWhatThereIs) {
  for (const FindingChoice& bad :
       {FindingChoice{"gout", "3"}, {"geissler", "5"}, {"geissler", ""}, {"", ""}}) {
    const std::string text = complaint({bad});
    EXPECT_NE(text.find("finding '" + bad.finding + "'"), std::string::npos) << text;
    EXPECT_NE(text.find("geissler=1|2|3|4"), std::string::npos) << text;
    EXPECT_NE(text.find("tfcc_tear=1A|1B|1D"), std::string::npos) << text;
  }
  EXPECT_NE(complaint({{"geissler", "2"}, {"geissler", "3"}}).find("twice"), std::string::npos);
}

TEST(Findings, AMarkIsALandmarkOfItsGradeAlone) {
  const std::string text = R"([[finding]]
name = "hole"
meaning = "m"
source = "D"
[[finding.grade]]
name = "one"
meaning = "m"
cut = [{ of = "femur", shape = "ellipsoid", center_mm = [0, 0, 0], radii_mm = [5, 5, 5] }]
mark = [{ name = "hole_in", bone = "femur", position_mm = [1, 2, 3] }]
)";
  const auto table = parse_findings(text, "t");
  ASSERT_TRUE(table) << table.error().message();
  AnatomyDescription anatomy = description_of("knee");
  const std::size_t before = anatomy.landmarks.size();
  ASSERT_TRUE(apply_findings(*table, {{"hole", "one"}}, anatomy));
  ASSERT_EQ(anatomy.landmarks.size(), before + 1);
  EXPECT_EQ(anatomy.landmarks.back().name, "hole_in");
  EXPECT_EQ(anatomy.bones[*anatomy.landmarks.back().bone].name, "femur");
  const auto again = apply_findings(*table, {{"hole", "one"}}, anatomy);
  ASSERT_FALSE(again);
  EXPECT_NE(again.error().message().find("hole_in"), std::string::npos);
}

TEST(Findings, LandmarksGoAlongWithTheBoneThatAFindingMoves) {
  const std::string ball =
      "[[bone]]\nname = \"NAME\"\nfma_id = 1\nposition_mm = [0, 0, 0]\nadd = [{ shape = "
      "\"ellipsoid\", center_mm = [0, 0, 0], radii_mm = [5, 5, 5] }]\n";
  std::string text = "name = \"t\"\nside = \"right\"\n";
  for (const std::string name : {"one", "other"}) {
    std::string bone = ball;
    text += bone.replace(bone.find("NAME"), 4, name);
  }
  for (const auto& [name, bone] : {std::pair<std::string, std::string>{"on_one", "one"},
                                   {"on_other", "other"},
                                   {"free", ""}}) {
    text += "[[landmark]]\nname = \"" + name + "\"\nposition_mm = [5, 0, 0]\n";
    if (!bone.empty()) text += "bone = \"" + bone + "\"\n";
  }
  auto anatomy = parse_description(text, "t");
  ASSERT_TRUE(anatomy) << anatomy.error().message();
  const auto table = parse_findings(R"([[finding]]
name = "f"
meaning = "m"
source = "D"
[[finding.grade]]
name = "1"
meaning = "m"
move = [
  { bones = ["one"], pivot_mm = [0, 0, 0], turn_deg = [0, 0, 90], mm = [0, 0, 2] },
  { bones = ["one"], pivot_mm = [0, 0, 0], turn_deg = [0, 0, 0], mm = [1, 0, 0] },
]
)",
                                    "f");
  ASSERT_TRUE(table) << table.error().message();
  ASSERT_TRUE(apply_findings(*table, {{"f", "1"}}, *anatomy));
  const auto grown = grow_bones(*anatomy, {}, "t");
  ASSERT_TRUE(grown) << grown.error().message();
  ASSERT_EQ(grown->landmarks.size(), 3u);
  // A quarter turn about z takes x to y; then both shifts.
  EXPECT_NEAR((grown->landmarks[0].p_W - Vec3(0.001, 0.005, 0.002)).norm(), 0, 1e-12);
  EXPECT_EQ(grown->landmarks[1].p_W, Vec3(0.005, 0, 0));
  EXPECT_EQ(grown->landmarks[2].p_W, Vec3(0.005, 0, 0));
}

TEST(Findings, EveryFindingOfTheTablesFitsItsAnatomy) {
  for (const std::string name : {"wrist", "knee"}) {
    const auto findings = list_findings(kAnatomyAssets / (name + "_findings.toml"));
    ASSERT_TRUE(findings) << findings.error().message();
    const auto table = load_findings(kAnatomyAssets / (name + "_findings.toml"));
    EXPECT_GE(findings->size(), 3u);
    for (const AnatomyFinding& finding : *findings) {
      EXPECT_FALSE(finding.source.empty());
      for (const FindingGrade& grade : finding.grades) {
        AnatomyDescription anatomy = description_of(name);
        const auto applied = apply_findings(*table, {{finding.name, grade.name}}, anatomy);
        ASSERT_TRUE(applied) << applied.error().message();
        EXPECT_EQ(applied->at(0).meaning, grade.meaning);
      }
    }
  }
}

TEST(Findings, AScaphoidFractureMakesTwoBonesAsFarApartAsItsGradeSays) {
  const GeneratedAnatomy plain = grown("wrist", {}, {}, {"scaphoid"});
  for (const auto& [grade, wanted_mm] :
       {std::pair<std::string, double>{"undisplaced", 0.5}, {"nonunion", 2.0}}) {
    const auto broken = grown("wrist", {{"scaphoid_fracture", grade}},
                              {"scaphoid_cartilage", "scapholunate_dorsal"});
    ASSERT_EQ(broken.bones.size(), 16u);
    const TriMesh proximal = in_world(bone(broken, "scaphoid_proximal"));
    const TriMesh distal = in_world(bone(broken, "scaphoid_distal"));
    expect_whole(proximal, grade);
    expect_whole(distal, grade);
    EXPECT_EQ(pieces_of(proximal) + pieces_of(distal), 2u);
    // Across a rough crack the nearest points lie a little nearer than its gap.
    const double gap = gap_mm(proximal, distal);
    const double whole = checks::signed_volume(bone(plain, "scaphoid").mesh);
    const double left = checks::signed_volume(proximal) + checks::signed_volume(distal);
    std::printf("%s: gap %.2f mm, %.1f %% of the bone, the proximal fragment %.1f %%\n",
                grade.c_str(), gap, 100 * left / whole,
                100 * checks::signed_volume(proximal) / whole);
    EXPECT_LE(gap, wanted_mm + 0.05);
    EXPECT_GE(gap, 0.8 * wanted_mm);
    EXPECT_GT(checks::signed_volume(proximal), 0.3 * whole) << "through the waist";
    EXPECT_GT(checks::signed_volume(distal), 0.3 * whole);
    for (const char* layer : {"scaphoid_proximal_cartilage", "scaphoid_distal_cartilage"})
      expect_whole(checks::soft_named(broken, layer).mesh_W, layer);
    EXPECT_EQ(checks::soft_named(broken, "scapholunate_dorsal").attachments.at(0).bone,
              "scaphoid_proximal");
    for (const GeneratedBone& other : plain.bones)
      if (other.name != "scaphoid") {
        EXPECT_EQ(checks::hash_of(bone(broken, other.name).mesh), checks::hash_of(other.mesh))
            << other.name;
      }
  }
}

const std::set<std::string> kScapholunate = {
    "scaphoid_cartilage",  "lunate_cartilage",      "scapholunate_dorsal",  "scapholunate_volar",
    "radioscaphocapitate", "scapholunate_proximal", "lunotriquetral_dorsal"};

/// Between what an arthroscope sees of the scaphoid and of the lunate: their cartilage.
double free_way_mm(const GeneratedAnatomy& anatomy) {
  return gap_mm(checks::soft_named(anatomy, "scaphoid_cartilage").mesh_W,
                checks::soft_named(anatomy, "lunate_cartilage").mesh_W);
}

TEST(Findings, GeisslersGradesLetTheProbeAndThenTheArthroscopeThrough) {
  constexpr double kProbe_mm = 1.5, kArthroscope_mm = 2.7;
  const GeneratedAnatomy plain = grown("wrist", {}, kScapholunate);
  const double whole = free_way_mm(plain);
  std::vector<double> ways = {whole};
  for (const char* grade : {"1", "2", "3", "4"}) {
    const auto loose = grown("wrist", {{"geissler", grade}}, kScapholunate);
    ways.push_back(free_way_mm(loose));
    std::size_t torn = 0;
    for (const char* band :
         {"scapholunate_dorsal", "scapholunate_volar", "scapholunate_proximal"}) {
      const TriMesh& mesh = checks::soft_named(loose, band).mesh_W;
      expect_whole(mesh, std::string(band) + " of grade " + grade);
      torn += pieces_of(mesh) == 2;
    }
    std::printf("grade %s: free way %.2f mm, %zu bands torn\n", grade, ways.back(), torn);
    const std::size_t torn_wanted[] = {0, 0, 0, 2, 3};
    EXPECT_EQ(torn, torn_wanted[grade[0] - '0']) << grade;
    for (const char* same : {"scaphoid", "lunate", "radius"})
      EXPECT_EQ(checks::hash_of(bone(loose, same).mesh), checks::hash_of(bone(plain, same).mesh));
    EXPECT_EQ(checks::hash_of(checks::soft_named(loose, "lunotriquetral_dorsal").mesh_W),
              checks::hash_of(checks::soft_named(plain, "lunotriquetral_dorsal").mesh_W));
    std::vector<TriMesh> meshes_W;
    for (const GeneratedBone& b : loose.bones) meshes_W.push_back(in_world(b));
    for (const BoneGap& gap : bone_gaps(meshes_W, 0))
      EXPECT_GT(gap.gap_m, -kMostOverlap)
          << loose.bones[gap.first].name << " in " << loose.bones[gap.second].name;
  }
  EXPECT_NEAR(ways[1], whole, 1e-9) << "I: no step, no gap";
  EXPECT_GT(ways[2], whole + 0.3);
  EXPECT_LT(ways[2], kProbe_mm);
  EXPECT_GT(ways[3], kProbe_mm);
  EXPECT_LT(ways[3], kArthroscope_mm);
  EXPECT_GT(ways[4], kArthroscope_mm);
}

TEST(Findings, TheDiscIsTornWhereItsGradeSays) {
  const auto whole = grown("wrist", {}, {"tfcc_disc"});
  const TriMesh& disc = checks::soft_named(whole, "tfcc_disc").mesh_W;
  EXPECT_EQ(checks::euler_number(disc), 2);
  const auto torn = [&](const char* grade) {
    const auto anatomy = grown("wrist", {{"tfcc_tear", grade}}, {"tfcc_disc"});
    for (std::size_t i = 0; i < anatomy.bones.size(); ++i)
      EXPECT_EQ(checks::hash_of(anatomy.bones[i].mesh), checks::hash_of(whole.bones[i].mesh));
    const TriMesh mesh = checks::soft_named(anatomy, "tfcc_disc").mesh_W;
    expect_whole(mesh, grade);
    EXPECT_LT(checks::signed_volume(mesh), 0.97 * checks::signed_volume(disc)) << grade;
    return mesh;
  };
  const TriMesh central = torn("1A");
  EXPECT_EQ(pieces_of(central), 1u);
  EXPECT_EQ(checks::euler_number(central), 0) << "a hole right through";
  for (const char* grade : {"1B", "1D"}) {
    const TriMesh parted = torn(grade);
    EXPECT_EQ(pieces_of(parted), 2u) << grade;
    const auto pieces = largest_pieces(parted, 2);
    const double gap = gap_mm(take_pieces(parted, {pieces[0]}), take_pieces(parted, {pieces[1]}));
    std::printf("%s: %.2f mm apart\n", grade, gap);
    EXPECT_GT(gap, 0.7);
    EXPECT_LT(gap, 1.3);
  }
}

TEST(Findings, TheTornCruciateLigamentHasTwoStumpsWhereItsGradeSays) {
  const auto share_of_gap = [&](const char* grade, double wanted_mm) {
    const auto torn = grown("knee", {{"acl_tear", grade}}, {"acl"});
    const GeneratedSoft& acl = checks::soft_named(torn, "acl");
    expect_whole(acl.mesh_W, grade);
    const auto pieces = largest_pieces(acl.mesh_W, 9);
    EXPECT_EQ(pieces.size(), 2u);
    const Vec3 femur = acl.attachments.at(0).p_W, tibia = acl.attachments.at(1).p_W;
    const TriMesh a = take_pieces(acl.mesh_W, {pieces[0]}),
                  b = take_pieces(acl.mesh_W, {pieces[1]});
    const double gap = gap_mm(a, b);
    std::printf("%s: stumps %.1f mm apart\n", grade, gap);
    EXPECT_LE(gap, wanted_mm + 0.1);
    EXPECT_GE(gap, 0.6 * wanted_mm) << "between the fringes";
    // The middle of the gap along the ligament, from femur (0) to tibia (1).
    const Vec3 along = (tibia - femur) / (tibia - femur).squaredNorm();
    double lo = 1, hi = 0;
    for (const TriMesh* stump : {&a, &b}) {
      double first = 2, last = -1;
      for (const Vec3& v : stump->vertices) {
        first = std::min(first, along.dot(v - femur));
        last = std::max(last, along.dot(v - femur));
      }
      if (first < 0.1) lo = last;
      if (last > 0.9) hi = first;
    }
    return 0.5 * (lo + hi);
  };
  const double femoral = share_of_gap("femoral", 6), middle = share_of_gap("midsubstance", 8);
  EXPECT_LT(femoral, 0.4);
  EXPECT_NEAR(middle, 0.5, 0.1);
}

TEST(Findings, TheMeniscusIsTornWhereItsGradeSays) {
  const std::set<std::string> softs = {"femoral_cartilage", "medial_tibial_plateau",
                                       "medial_meniscus"};
  // Places in World, mm: in the middle of either tear, and between them and the outer rim.
  const Vec3 radial(7.5, 32, -3), lengthwise(7.6, 33.3, -10.2), rim(7.5, 36.5, -3);
  const auto expect = [&](const std::vector<FindingChoice>& findings, long euler, bool has_radial,
                          bool has_lengthwise) {
    const auto anatomy = grown("knee", findings, softs);
    const TriMesh& mesh = checks::soft_named(anatomy, "medial_meniscus").mesh_W;
    expect_whole(mesh, "meniscus");
    EXPECT_EQ(pieces_of(mesh), 1u);
    EXPECT_EQ(checks::euler_number(mesh), euler);
    const MeshDistance surface(mesh);
    const auto free_mm = [&](const Vec3& p_mm) {
      return 1e3 * surface.closest(1e-3 * p_mm).signed_distance;
    };
    std::printf("radial %.2f, lengthwise %.2f, rim %.2f mm\n", free_mm(radial), free_mm(lengthwise),
                free_mm(rim));
    // Free: half a millimetre from either side of the tear; else deep in the meniscus.
    EXPECT_NEAR(free_mm(radial) > 0 ? free_mm(radial) : 0.0, has_radial ? 0.5 : 0.0, 0.1);
    EXPECT_NEAR(free_mm(lengthwise) > 0 ? free_mm(lengthwise) : 0.0, has_lengthwise ? 0.5 : 0.0,
                0.1);
    EXPECT_LT(free_mm(rim), -0.5);
  };
  expect({{"meniscal_tear", "radial"}}, 2, true, false);
  expect({{"meniscal_tear", "bucket_handle"}}, 0, false, true);
}

TEST(Findings, ATearAcrossTheAnteriorHornPartsIt) {
  const auto anatomy = grown("knee", {{"meniscal_tear", "anterior"}},
                             {"femoral_cartilage", "medial_tibial_plateau", "medial_meniscus"});
  const TriMesh& mesh = checks::soft_named(anatomy, "medial_meniscus").mesh_W;
  expect_whole(mesh, "meniscus");
  EXPECT_EQ(pieces_of(mesh), 2u);
  const MeshDistance surface(mesh);
  const auto free_mm = [&](const Vec3& p_mm) {
    return 1e3 * surface.closest(1e-3 * p_mm).signed_distance;
  };
  // Half of the gap of 2 mm, in the middle of the horn; the body is whole.
  EXPECT_NEAR(free_mm({7, 16.5, 11.4}), 1, 0.15);
  EXPECT_NEAR(free_mm({7, 16.5, 12.5}), 1, 0.15);
  EXPECT_LT(free_mm({7.5, 36.5, -3}), -0.5);
}

TEST(Findings, ALesionOfTheCartilageIsBareBoneAsWideAsItsGradeSays) {
  const auto whole = grown("knee", {}, {"femoral_cartilage"}, {"femur"});
  const TriMesh& layer = checks::soft_named(whole, "femoral_cartilage").mesh_W;
  for (const auto& [grade, wanted_mm] : {std::pair<const char*, double>{"large", 18}}) {
    const auto anatomy =
        grown("knee", {{"cartilage_lesion", grade}}, {"femoral_cartilage"}, {"femur"});
    const TriMesh& mesh = checks::soft_named(anatomy, "femoral_cartilage").mesh_W;
    expect_whole(mesh, grade);
    EXPECT_EQ(pieces_of(mesh), 1u);
    EXPECT_EQ(checks::euler_number(mesh), checks::euler_number(layer) - 2) << "a hole in it";
    // Bone of the femur that was covered and is bare now.
    const MeshDistance was(layer), is(mesh);
    Aabb bare;
    for (const Vec3& p : in_world(bone(anatomy, "femur")).vertices)
      if (was.closest(p).signed_distance < 1e-5 && is.closest(p).signed_distance > 1e-5)
        bare.include(p);
    ASSERT_FALSE(bare.empty());
    const double across = std::max(bare.extent().y(), bare.extent().z()) * 1000;
    std::printf("%s: %.1f mm of bone bare\n", grade, across);
    EXPECT_NEAR(across, wanted_mm, 2.5) << "one cell at either rim";
    EXPECT_LE(across, wanted_mm + 0.01);
  }
}

TEST(Findings, ARandomPatientHasThemTooAndTheRestIsTheSameToTheBit) {
  GenerateOptions options;
  options.cell_m = 0.0016;
  VariationRequest request{7, {}, "left"};
  const auto make = [&] {
    auto made = generate_varied(kAnatomyAssets / "wrist.toml",
                                kAnatomyAssets / "wrist_variation.toml", request, options);
    if (!made) throw std::runtime_error(made.error().message());
    return std::move(made->anatomy);
  };
  const GeneratedAnatomy healthy = make();
  request.findings = {{"scaphoid_fracture", "undisplaced"}, {"tfcc_tear", "1A"}};
  request.findings_table = kAnatomyAssets / "wrist_findings.toml";
  const GeneratedAnatomy ill = make();
  ASSERT_EQ(ill.findings.size(), 2u);
  EXPECT_EQ(ill.findings[1].grade, "1A");
  for (const char* name : {"scaphoid_proximal_cartilage", "scaphoid_distal_cartilage", "tfcc_disc"})
    expect_whole(checks::soft_named(ill, name).mesh_W, name);
  // The ligaments give way to the cartilage that is cut.
  const std::set<std::string> touched = {
      "scapholunate_proximal",     "scapholunate_volar", "radioscaphocapitate",
      "dorsal_intercarpal",        "scaphocapitate",     "scaphotrapezial",
      "scaphoid_proximal",         "scaphoid_distal",    "scaphoid_proximal_cartilage",
      "scaphoid_distal_cartilage", "tfcc_disc"};
  std::size_t same = 0;
  for (const GeneratedBone& b : ill.bones)
    if (!touched.contains(b.name)) {
      EXPECT_EQ(checks::hash_of(b.mesh), checks::hash_of(bone(healthy, b.name).mesh)) << b.name;
      ++same;
    }
  EXPECT_EQ(same, 14u);
  for (const GeneratedSoft& s : ill.softs)
    if (!touched.contains(s.name)) {
      EXPECT_EQ(checks::hash_of(s.mesh_W),
                checks::hash_of(checks::soft_named(healthy, s.name).mesh_W))
          << s.name;
    }
  Hasher hasher;
  for (const GeneratedBone& b : ill.bones) hasher.add(checks::hash_of(b.mesh));
  std::printf("hash of seed 7 with findings: %016llx %016llx\n",
              static_cast<unsigned long long>(hasher.value()),
              static_cast<unsigned long long>(checks::hash_of_softs(ill)));
}

}  // namespace
}  // namespace osteon
