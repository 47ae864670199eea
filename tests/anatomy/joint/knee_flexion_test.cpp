#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "anatomy/anatomy_assets.h"
#include "anatomy/knee_figures.h"
#include "anatomy/soft/soft_checks.h"
#include "osteon/anatomy/bone_gaps.h"
#include "osteon/anatomy/variation.h"

namespace osteon {
namespace {

constexpr double kPoseCell_m = 0.003;  // enough where only poses matter

GeneratedAnatomy grown_with(VariationRequest request, bool soft_parts,
                            std::optional<double> cell_m = {}) {
  GenerateOptions options;
  options.soft_parts = soft_parts;
  options.cell_m = cell_m;
  request.findings_table = kAnatomyAssets / "knee_findings.toml";
  auto r = generate_varied(kAnatomyAssets / "knee.toml", kAnatomyAssets / "knee_variation.toml",
                           request, options);
  if (!r) throw std::runtime_error(r.error().message());
  return std::move(r->anatomy);
}

const GeneratedAnatomy& stretched() {
  static const GeneratedAnatomy grown = grown_with({}, false);
  return grown;
}

/// Smaller, other condyles, another slope, of a left leg; bent with its soft parts.
const GeneratedAnatomy& bent_patient() {
  static const GeneratedAnatomy grown =
      grown_with({11, {{"flexion_deg", 90}}, "left", {{"acl_tear", "midsubstance"}}}, true);
  return grown;
}

const TriMesh& mesh_of(const GeneratedAnatomy& knee, const char* bone) {
  return checks::bone_named(knee, bone).mesh;
}

/// Pose in the femur.
Pose pose_in_femur(const GeneratedAnatomy& knee, const std::string& bone, double degrees) {
  for (const GeneratedJoint::Moved& moved : knee.joints.at(0).bones)
    if (moved.bone == bone) return pose_at(moved.X_FB, degrees);
  return {};
}

Vec3 landmark(const GeneratedAnatomy& knee, const char* name) {
  return checks::landmark_of(knee, name);
}

/// Between a place on the femur and one that stood at `p_W` in the stretched knee and moves with
/// `bone`; mm.
double length_mm(const char* on_femur, const Vec3& p_W, const char* bone, double degrees) {
  const Pose X = pose_in_femur(stretched(), bone, degrees);
  return 1e3 * (X * p_W - landmark(stretched(), on_femur)).norm();
}

/// Where one half of the plateau is nearest to the femur: the mean of what is nearly so.
struct PlateauContact {
  double gap_mm = 1e9;
  Vec3 at_mm = Vec3::Zero();  ///< in the tibia
};
PlateauContact contact_of(const MeshDistance& femur, double degrees, double side) {
  const Pose X = pose_in_femur(stretched(), "tibia", degrees);
  std::vector<std::pair<double, Vec3>> gaps_mm;
  PlateauContact contact;
  for (const Vec3& v : mesh_of(stretched(), "tibia").vertices) {
    if (side * v.y() < 0.012 || v.x() > 0.02) continue;
    gaps_mm.emplace_back(1e3 * femur.closest(X * v).signed_distance, 1e3 * v);
    contact.gap_mm = std::min(contact.gap_mm, gaps_mm.back().first);
  }
  double count = 0;
  for (const auto& [gap_mm, at_mm] : gaps_mm) {
    if (gap_mm > contact.gap_mm + 0.15) continue;
    contact.at_mm += at_mm;
    count += 1;
  }
  contact.at_mm /= count;
  return contact;
}

/// Degrees that the tibia's front has turned towards medial about its long axis.
double inward_deg(double degrees) {
  const Vec3 medial_T = pose_in_femur(stretched(), "tibia", degrees).q.conjugate() * Vec3::UnitY();
  return std::atan2(medial_T.z(), medial_T.y()) * checks::kDegreesOf;
}

TEST(KneeFlexion, AtNoughtNothingHasMoved) {
  ASSERT_EQ(stretched().joints.size(), 1u);
  EXPECT_EQ(stretched().joints[0].fixed, "femur");
  ASSERT_EQ(stretched().joints[0].bones.size(), 3u);
  for (const GeneratedJoint::Moved& moved : stretched().joints[0].bones) {
    EXPECT_EQ(moved.X_FB.last(), 130) << moved.bone;
    EXPECT_EQ(pose_at(moved.X_FB, 0).p, Vec3::Zero()) << moved.bone;
    EXPECT_EQ(pose_at(moved.X_FB, 0).q.coeffs(), Quat::Identity().coeffs()) << moved.bone;
  }
}

TEST(KneeFlexion, BendsAsFarAsItSays) {
  for (double a = 0; a <= 130; a += 13) {
    const Vec3 shank = pose_in_femur(stretched(), "tibia", a).rotate(Vec3::UnitX());
    EXPECT_NEAR(std::atan2(-shank.z(), shank.x()) * checks::kDegreesOf, a, 0.05) << a;
    EXPECT_LT(std::abs(shank.y()), 0.06) << "to no side, at " << a;
  }
}

/// No two bones overlap; where two layers of cartilage belong, there is room for them; between the
/// rows of the table too.
TEST(KneeFlexion, BonesStayAsFarApartAsTheirCartilageIsThick) {
  const MeshDistance femur(mesh_of(stretched(), "femur"));
  double least_mm = 1e9, most_mm = 0, least_patella_mm = 1e9, most_patella_mm = 0;
  for (double a = 0; a <= 130; a += 13) {
    for (const double side : {1.0, -1.0}) {
      const double gap_mm = contact_of(femur, a, side).gap_mm;
      least_mm = std::min(least_mm, gap_mm);
      most_mm = std::max(most_mm, gap_mm);
      EXPECT_GT(gap_mm, 4.0) << a << " side " << side;
      EXPECT_LT(gap_mm, 4.8) << a << " side " << side;
    }
    std::vector<TriMesh> meshes_F;
    for (const GeneratedBone& bone : stretched().bones) {
      const Pose X = pose_in_femur(stretched(), bone.name, a);
      meshes_F.push_back(bone.mesh);
      for (Vec3& v : meshes_F.back().vertices) v = X * v;
    }
    double patella_mm = 1e9;
    for (const BoneGap& gap : bone_gaps(meshes_F, 0.006)) {
      EXPECT_GT(gap.gap_m, 0.001) << a << ": " << gap.first << " and " << gap.second;
      if (gap.first == 0 && gap.second == 3) patella_mm = 1e3 * gap.gap_m;
    }
    EXPECT_NEAR(patella_mm, 4.2, 0.4) << a;
    least_patella_mm = std::min(least_patella_mm, patella_mm);
    most_patella_mm = std::max(most_patella_mm, patella_mm);
  }
  std::printf("from the femur: both plateaus %.2f to %.2f mm, patella %.2f to %.2f mm\n", least_mm,
              most_mm, least_patella_mm, most_patella_mm);
}

/// Way of a condyle's centre to the back of the tibia.
double center_back_mm(const Vec3& center_F, double degrees) {
  const Vec3 seen_T = pose_in_femur(stretched(), "tibia", degrees).inverse() * center_F;
  return 1e3 * (center_F.z() - seen_T.z());
}

/// Iwaki, Pinskerova, Freeman 2000 (K): the medial condyle's centre stays within 2 mm, the lateral
/// one goes back by 15 to 20 mm, the tibia turned inwards, most of it at the end of extension.
TEST(KneeFlexion, RollsBackLaterallyAndTurnsInwards) {
  const double medial_mm = center_back_mm({-0.0155, 0.0265, -0.0045}, 120);
  EXPECT_LT(std::abs(medial_mm), 2);
  const double lateral_mm = center_back_mm({-0.016, -0.0265, -0.0045}, 120);
  EXPECT_GT(lateral_mm, 15);
  EXPECT_LT(lateral_mm, 20);
  std::printf("the centres go back by %.1f mm medially, %.1f laterally; inwards %.0f, %.0f deg\n",
              medial_mm, lateral_mm, inward_deg(30), inward_deg(120));
  double before = -1;
  for (double a = 0; a <= 130; a += 10) {
    EXPECT_GT(inward_deg(a), before) << a;
    before = inward_deg(a);
  }
  EXPECT_NEAR(inward_deg(120), 19, 0.5);
  EXPECT_GT(inward_deg(30), 0.4 * inward_deg(120));
}

/// After the first degrees, in which the contact rocks back from the flatter front of the condyles,
/// it goes back on both sides, laterally by much more; in the whole range it stays on the plateau.
TEST(KneeFlexion, ContactGoesBackOverThePlateau) {
  const MeshDistance femur(mesh_of(stretched(), "femur"));
  double back_mm[2];
  for (const int side : {0, 1}) {
    const PlateauContact start = contact_of(femur, 10, side == 0 ? 1 : -1);
    const PlateauContact end = contact_of(femur, 120, side == 0 ? 1 : -1);
    back_mm[side] = start.at_mm.z() - end.at_mm.z();
    EXPECT_LT(start.at_mm.z(), 10);
    EXPECT_GT(end.at_mm.z(), -26);
  }
  std::printf("from 10 to 120 degrees the contact goes back by %.1f mm medially, %.1f laterally\n",
              back_mm[0], back_mm[1]);
  EXPECT_GT(back_mm[0], 0);
  EXPECT_GT(back_mm[1], 13);
  EXPECT_LT(back_mm[1], 20);
  EXPECT_GT(back_mm[1] - back_mm[0], 5);
}

TEST(KneeFlexion, TurnsAndGlidesWithoutAJump) {
  for (const char* bone : {"tibia", "patella"}) {
    Vec3 rate_before = Vec3::Zero();
    for (double a = 0.5; a <= 130; a += 0.5) {
      const Vec3 p(0.01, 0.02, 0.01);
      const Vec3 rate = 2 * (pose_in_femur(stretched(), bone, a) * p -
                             pose_in_femur(stretched(), bone, a - 0.5) * p);
      EXPECT_LT(rate.norm(), 0.0025) << bone << " at " << a;
      if (a > 0.5) {
        EXPECT_LT((rate - rate_before).norm(), 1.5e-4) << bone << " at " << a;
      }
      rate_before = rate;
    }
  }
}

/// Distances between footprints, against those of the stretched knee: ligaments that guide the
/// joint change little, those that go slack grow shorter only.
TEST(KneeFlexion, LigamentsKeepTheirLengthsAsTheyShould) {
  struct Run {
    const char* name;
    const char* on_femur;
    Vec3 far;
    const char* bone;
    double least, most;
  };
  const Run runs[] = {{"acl", "acl_femur", landmark(stretched(), "acl_tibia"), "tibia", 0.75, 1.02},
                      {"pcl", "pcl_femur", landmark(stretched(), "pcl_tibia"), "tibia", 0.98, 1.12},
                      {"mcl", "medial_epicondyle", {0.058, 0.012, 0.006}, "tibia", 0.90, 1.02},
                      {"lcl", "lateral_epicondyle", {0.035, -0.034, -0.023}, "fibula", 0.78, 1.02}};
  for (const Run& run : runs) {
    const double rest = length_mm(run.on_femur, run.far, run.bone, 0);
    double least = 1, most = 1;
    for (double a = 0; a <= 120; a += 10) {
      const double share = length_mm(run.on_femur, run.far, run.bone, a) / rest;
      least = std::min(least, share);
      most = std::max(most, share);
    }
    std::printf("%s %.1f mm, %.0f to %.0f %% of it\n", run.name, rest, 100 * least, 100 * most);
    EXPECT_GE(least, run.least) << run.name;
    EXPECT_LE(most, run.most) << run.name;
  }
}

TEST(KneeFlexion, PatellarTendonKeepsItsLength) {
  const Vec3 apex(-0.017, -0.002, 0.052), tubercle(0.0422, -0.004, 0.027);
  const Vec3 from = MeshDistance(mesh_of(stretched(), "patella")).closest(apex).point;
  const Vec3 to = MeshDistance(mesh_of(stretched(), "tibia")).closest(tubercle).point;
  for (double a = 0; a <= 130; a += 5) {
    const Vec3 way = pose_in_femur(stretched(), "patella", a) * from -
                     pose_in_femur(stretched(), "tibia", a) * to;
    EXPECT_NEAR(way.norm() / (from - to).norm(), 1, a == 5 ? 0.02 : 0.01) << a;
  }
}

TEST(KneeFlexion, ABentPatientIsSound) {
  const GeneratedAnatomy& knee = bent_patient();
  EXPECT_EQ(knee.joints.at(0).at_deg, 90);
  checks::expect_sound_softs(knee);
  std::vector<TriMesh> meshes_W;
  for (const GeneratedBone& bone : knee.bones) {
    meshes_W.push_back(bone.mesh);
    for (Vec3& v : meshes_W.back().vertices) v = bone.X_WB * v;
  }
  for (const BoneGap& gap : bone_gaps(meshes_W, 0.001)) EXPECT_GT(gap.gap_m, 0.0005);
  const GeneratedSoft& skin = checks::soft_named(knee, "skin");
  EXPECT_EQ(checks::euler_number(skin.mesh_W), 2);
  const MeshDistance outline(skin.mesh_W);
  for (const GeneratedBone& bone : knee.bones)
    for (std::size_t i = 0; i < bone.mesh.vertices.size(); i += 40) {
      const Vec3 p_W = bone.X_WB * bone.mesh.vertices[i];
      // The skin ends at the hip and above the ankle.
      if (bone.name != "patella" && bone.mesh.vertices[i].head<1>().norm() > 0.3) continue;
      EXPECT_LT(outline.closest(p_W).signed_distance, -0.001) << bone.name;
    }
}

TEST(KneeFlexion, BonesOfABentKneeAreThoseOfTheStretchedOne) {
  const GeneratedAnatomy straight = grown_with({}, false, kPoseCell_m);
  const GeneratedAnatomy bent = grown_with({{}, {{"flexion_deg", 70}}, ""}, false, kPoseCell_m);
  for (std::size_t i = 0; i < bent.bones.size(); ++i) {
    EXPECT_EQ(checks::hash_of(bent.bones[i].mesh), checks::hash_of(straight.bones[i].mesh));
    const Pose X = pose_in_femur(straight, bent.bones[i].name, 70);
    EXPECT_LT((bent.bones[i].X_WB.p - X.p).norm(), 1e-9);
    EXPECT_LT(bent.bones[i].X_WB.q.angularDistance(X.q), 1e-9);
  }
}

/// Landmarks go with their bones and lie where bands hold on.
TEST(KneeFlexion, LandmarksGoWithTheirBones) {
  const GeneratedAnatomy& knee = bent_patient();
  const GeneratedSoft& pcl = checks::soft_named(knee, "pcl");
  EXPECT_LT((landmark(knee, "pcl_femur") - pcl.attachments.at(0).p_W).norm(), 1e-6);
  EXPECT_LT((landmark(knee, "pcl_tibia") - pcl.attachments.at(1).p_W).norm(), 1e-6);
  const MeshDistance skin(checks::soft_named(knee, "skin").mesh_W);
  for (const char* name : {"portal_al", "portal_am"}) {
    EXPECT_LT(std::abs(skin.closest(landmark(knee, name)).signed_distance), 1.5e-4) << name;
    EXPECT_LT((landmark(knee, name) - landmark(knee, "acl_tibia")).norm(), 0.08) << name;
  }
}

TEST(KneeFlexion, BothSidesBendAlike) {
  const GeneratedAnatomy left = grown_with({{}, {{"flexion_deg", 60}}, "left"}, false, kPoseCell_m);
  for (std::size_t i = 0; i < left.bones.size(); ++i) {
    const GeneratedBone& bone = left.bones[i];
    const Pose X = bone.name == "femur" ? Pose{} : pose_in_femur(left, bone.name, 60);
    EXPECT_LT((X.p - bone.X_WB.p).norm(), 1e-9) << bone.name;
    EXPECT_LT(X.q.angularDistance(bone.X_WB.q), 1e-9) << bone.name;
  }
  EXPECT_GT(checks::bone_named(left, "tibia").X_WB.p.norm(), 0.005);
}

TEST(KneeFlexion, IsNeverDrawn) {
  const auto drawn =
      generate_varied(kAnatomyAssets / "knee.toml", kAnatomyAssets / "knee_variation.toml",
                      {42, {}, ""}, {.cell_m = 0.004, .soft_parts = false});
  ASSERT_TRUE(drawn);
  const ParameterValue& last = drawn->values.back();
  EXPECT_EQ(last.first, "flexion_deg");
  EXPECT_EQ(last.second, 0);
}

TEST(KneeFlexion, BeyondItsRangeIsRefused) {
  for (const double degrees : {-1.0, 131.0})
    EXPECT_FALSE(generate_varied(kAnatomyAssets / "knee.toml",
                                 kAnatomyAssets / "knee_variation.toml",
                                 {{}, {{"flexion_deg", degrees}}, ""}));
}

}  // namespace
}  // namespace osteon
