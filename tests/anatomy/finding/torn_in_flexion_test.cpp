// What is torn in a stretched knee is torn in a bent one, and in the same place of it. Pieces are
// counted here by a flood over shared edges, apart from the code that keeps the largest ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "anatomy/anatomy_assets.h"
#include "anatomy/soft/soft_checks.h"
#include "anatomy/surface_probe.h"
#include "bone/grow.h"
#include "bone/placed_bones.h"
#include "finding/apply_findings.h"
#include "joint/roll_glide.h"
#include "mesh/surface_checks.h"
#include "osteon/base/file.h"
#include "osteon/base/random.h"
#include "soft/soft_grow.h"
#include "vary/vary.h"

namespace osteon {
namespace {

constexpr double kFlexions_deg[] = {0, 30, 70, 90, 120};

template <class T>
T value_or_throw(Result<T> r) {
  if (!r) throw std::runtime_error(r.error().message());
  return std::move(*r);
}

/// A patient drawn as the tables say, and on the left where the seed is odd. Its bones grow once,
/// with the long ones cut 60 mm from the joint; findings of soft parts alone leave them as they
/// are.
class Knee {
 public:
  explicit Knee(std::uint64_t seed)
      : left_(seed % 2 == 1),
        table_(value_or_throw(load_variation(kAnatomyAssets / "knee_variation.toml"))),
        findings_(value_or_throw(load_findings(kAnatomyAssets / "knee_findings.toml"))) {
    Random random(seed);
    for (const VariationRule& rule : table_.rules) {
      const VariationParameter& p = rule.parameter;
      const double drawn = std::clamp(random.normal(p.mean, p.sd), p.min, p.max);
      values_.push_back(seed == 0 ? p.built_in : drawn);
    }
    const AnatomyDescription anatomy = described({}, 0);
    at_rest_ = value_or_throw(grow_bones(anatomy, {}, "knee"));
    placed_ = PlacedBones(at_rest_, {});
  }

  /// Bent, with these findings and soft parts alone.
  GeneratedAnatomy bent(double degrees, const std::vector<FindingChoice>& findings,
                        const std::set<std::string>& softs) const {
    AnatomyDescription anatomy = described(findings, degrees);
    GeneratedAnatomy grown = at_rest_;
    if (auto ok = bend_joints(anatomy, "knee", placed_, grown); !ok)
      throw std::runtime_error(ok.error().message());
    std::erase_if(anatomy.softs, [&](const auto& soft) { return !softs.contains(soft.name); });
    if (auto ok = grow_soft_parts(anatomy, {}, "knee", grown); !ok)
      throw std::runtime_error(ok.error().message());
    if (left_) mirror(grown);
    return grown;
  }

 private:
  AnatomyDescription described(const std::vector<FindingChoice>& findings, double degrees) const {
    const auto file = kAnatomyAssets / "knee.toml";
    AnatomyDescription anatomy =
        value_or_throw(parse_description(read_file(file, 1 << 22).value(), file.string()));
    value_or_throw(apply_findings(findings_, findings, anatomy));
    if (auto ok = vary(anatomy, table_, values_); !ok)
      throw std::runtime_error(ok.error().message());
    anatomy.joints.at(0).at_deg = degrees;
    anatomy.landmarks.clear();
    for (BoneDescription& bone : anatomy.bones) cut_shaft(bone);
    return anatomy;
  }

  static void cut_shaft(BoneDescription& bone) {
    bone.cell_m = 0.002;
    const double side = bone.name == "femur" ? 1 : bone.name == "tibia" ? -1 : 0;
    if (side == 0) return;
    Part shaft;
    shaft.operation = Operation::kCut;
    shaft.primitive = HalfSpace{bone.R_WB.transpose() * (Vec3(-0.06 * side, 0, 0) - bone.p_WB),
                                bone.R_WB.transpose() * Vec3(side, 0, 0)};
    bone.solid.parts.push_back(shaft);
  }

  bool left_;
  VariationTable table_;
  FindingTable findings_;
  std::vector<double> values_;
  GeneratedAnatomy at_rest_;
  PlacedBones placed_;
};

/// Closed pieces of a mesh, by the edges that their triangles share; largest first.
std::vector<TriMesh> parts_of(const TriMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> on_edge;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      on_edge[std::minmax(mesh.triangles[i][k], mesh.triangles[i][(k + 1) % 3])].push_back(i);
  std::vector<bool> seen(mesh.triangles.size(), false);
  std::vector<TriMesh> parts;
  for (std::size_t first = 0; first < seen.size(); ++first) {
    if (seen[first]) continue;
    TriMesh part;
    part.vertices = mesh.vertices;
    seen[first] = true;
    for (std::vector<std::size_t> next{first}; !next.empty();) {
      const Triangle t = mesh.triangles[next.back()];
      next.pop_back();
      part.triangles.push_back(t);
      for (std::size_t k = 0; k < 3; ++k)
        for (const std::size_t i : on_edge.at(std::minmax(t[k], t[(k + 1) % 3])))
          if (!seen[i]) {
            seen[i] = true;
            next.push_back(i);
          }
    }
    parts.push_back(std::move(part));
  }
  std::sort(parts.begin(), parts.end(), [](const TriMesh& a, const TriMesh& b) {
    return checks::signed_volume(a) > checks::signed_volume(b);
  });
  return parts;
}

double mm3(const TriMesh& mesh) { return 1e9 * checks::signed_volume(mesh); }

/// From a place to the part's nearest vertex.
double reach_mm(const TriMesh& part, const Vec3& p) {
  double least = 1;
  for (const Triangle& t : part.triangles)
    for (const std::uint32_t v : t) least = std::min(least, (part.vertices[v] - p).norm());
  return 1e3 * least;
}

double apart_of_mm(const TriMesh& a, const TriMesh& b) {
  const MeshDistance surface(b);
  double least = 1;
  for (const Triangle& t : a.triangles)
    least = std::min(least, surface.closest(a.vertices[t[0]]).signed_distance);
  return 1e3 * least;
}

/// A torn ligament: femoral stump first.
struct Tear {
  std::size_t parts = 0;
  TriMesh femoral, tibial;
  double femoral_share = 0;  ///< of what is left, in the stump at the femur
  double gone_mm3 = 0;
};

Tear torn_acl(const Knee& knee, double degrees, const std::string& grade, double whole_mm3) {
  const GeneratedAnatomy grown = knee.bent(degrees, {{"acl_tear", grade}}, {"acl"});
  const GeneratedSoft& acl = checks::soft_named(grown, "acl");
  EXPECT_TRUE(checks::is_closed_manifold(acl.mesh_W));
  std::vector<TriMesh> parts = parts_of(acl.mesh_W);
  Tear tear;
  tear.parts = parts.size();
  if (parts.size() != 2) return tear;
  const Vec3 femur = acl.attachments.at(0).p_W, tibia = acl.attachments.at(1).p_W;
  if (reach_mm(parts[1], femur) < reach_mm(parts[0], femur)) std::swap(parts[0], parts[1]);
  tear.femoral = parts[0];
  tear.tibial = parts[1];
  EXPECT_LT(reach_mm(tear.femoral, femur), 3.5) << "at its footprint";
  EXPECT_LT(reach_mm(tear.tibial, tibia), 3.5) << "at its footprint";
  const double left_mm3 = mm3(tear.femoral) + mm3(tear.tibial);
  tear.femoral_share = mm3(tear.femoral) / left_mm3;
  tear.gone_mm3 = whole_mm3 - left_mm3;
  return tear;
}

class TornInFlexion : public testing::TestWithParam<std::uint64_t> {};

TEST_P(TornInFlexion, TheCruciateLigamentFallsInTwoWhereverTheKneeIsBent) {
  const Knee knee(GetParam());
  for (const auto& [grade, apart_mm] :
       {std::pair<std::string, double>{"femoral", 6}, {"midsubstance", 8}}) {
    double share_at_rest = 0;
    for (const double degrees : kFlexions_deg) {
      SCOPED_TRACE(grade + " at " + std::to_string(degrees));
      const GeneratedAnatomy sound = knee.bent(degrees, {}, {"acl"});
      const TriMesh& whole = checks::soft_named(sound, "acl").mesh_W;
      ASSERT_EQ(parts_of(whole).size(), 1u);
      const Tear tear = torn_acl(knee, degrees, grade, mm3(whole));
      EXPECT_EQ(tear.parts, 2u);
      if (tear.parts != 2) continue;
      const double gap = apart_of_mm(tear.femoral, tear.tibial);
      std::printf("seed %d, %s, %3.0f deg: %.0f mm3, %.0f gone, %.0f + %.0f left, %.1f mm apart\n",
                  static_cast<int>(GetParam()), grade.c_str(), degrees, mm3(whole), tear.gone_mm3,
                  mm3(tear.femoral), mm3(tear.tibial), gap);
      if (degrees == 0) share_at_rest = tear.femoral_share;
      EXPECT_NEAR(tear.femoral_share, share_at_rest, 0.12) << "the same place of the ligament";
      EXPECT_GT(gap, 0.5 * apart_mm);
      EXPECT_LT(gap, 1.25 * apart_mm);
      EXPECT_GT(tear.gone_mm3, 0.05 * mm3(whole));
      EXPECT_LT(tear.gone_mm3, 0.45 * mm3(whole));
    }
  }
}

/// The meniscus goes with the tibia as it is: its tears stay open where they are in it.
TEST(MeniscusTornInFlexion, IsOpenWhereItsGradeSays) {
  const Knee knee(0);
  const std::set<std::string> softs = {"femoral_cartilage", "medial_tibial_plateau",
                                       "medial_meniscus"};
  struct Grade {
    const char* name;
    Vec3 middle_mm;  ///< of its tear, in the stretched knee
    long euler;
  };
  const Vec3 rim_mm(7.5, 36.5, -3);
  for (const Grade& grade :
       {Grade{"radial", {7.5, 32, -3}, 2}, Grade{"bucket_handle", {7.6, 33.3, -10.2}, 0}})
    for (const double degrees : {0.0, 70.0, 120.0}) {
      SCOPED_TRACE(std::string(grade.name) + " at " + std::to_string(degrees));
      const GeneratedAnatomy grown = knee.bent(degrees, {{"meniscal_tear", grade.name}}, softs);
      const TriMesh& mesh = checks::soft_named(grown, "medial_meniscus").mesh_W;
      EXPECT_EQ(parts_of(mesh).size(), 1u);
      EXPECT_EQ(checks::euler_number(mesh), grade.euler);
      const Pose& X_WT = checks::bone_named(grown, "tibia").X_WB;
      const MeshDistance surface(mesh);
      const auto free_mm = [&](const Vec3& p_mm) {
        return 1e3 * surface.closest(X_WT * Vec3(1e-3 * p_mm)).signed_distance;
      };
      std::printf("%s at %3.0f: %.2f mm free in the tear, %.2f beside it\n", grade.name, degrees,
                  free_mm(grade.middle_mm), free_mm(rim_mm));
      EXPECT_NEAR(free_mm(grade.middle_mm), 0.5, 0.1);
      EXPECT_LT(free_mm(rim_mm), -0.5);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, TornInFlexion, testing::Values(0, 1, 2, 3, 4, 5));

}  // namespace
}  // namespace osteon
