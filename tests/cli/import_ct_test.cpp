// From a case with a known truth through the virtual scanner's DICOM files back to a case, with all
// soft parts in their skin. The scanned hands are other hands than the one that names are taken
// from.
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "osteon/anatomy/generate.h"
#include "osteon/mesh/distance.h"
#include "osteon/mesh/measure.h"
#include "osteon/scene/case_io.h"
#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

/// Another patient: longer, narrower, bent and, where wanted, of the left hand.
Vec3 other_patient(const Vec3& p, bool left) {
  const double bend = 1.2 * p.x() * p.x();  // up to 8 mm at 80 mm from the capitate
  const Vec3 q(1.07 * p.x(), 0.95 * p.y() + bend, 1.04 * p.z() + 0.04 * p.y());
  return Vec3(q.x(), left ? -q.y() : q.y(), q.z());
}

TriMesh other_mesh(TriMesh mesh, const Pose& X_W, bool left) {
  for (Vec3& v : mesh.vertices) v = other_patient(X_W * v, left);
  if (left)
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

CaseDef other_wrist(bool left) {
  const auto anatomy = generate_anatomy(fs::path(OSTEON_SOURCE_DIR) / "assets/anatomy/wrist.toml");
  EXPECT_TRUE(anatomy);
  CaseDef def;
  def.name = "other";
  def.side = left ? "left" : "right";
  for (const GeneratedBone& grown : anatomy->bones) {
    BoneDef bone;
    bone.name = grown.name;
    bone.mesh = other_mesh(grown.mesh, grown.X_WB, left);
    def.bones.push_back(std::move(bone));
  }
  for (const GeneratedSoft& grown : anatomy->softs) {
    SoftDef soft;
    soft.name = grown.name;
    soft.kind = grown.kind;
    soft.tissue = grown.tissue;
    soft.mesh_W = other_mesh(grown.mesh_W, {}, left);
    def.softs.push_back(std::move(soft));
  }
  return def;
}

Pose pose_of(const nlohmann::json& json) {
  const auto p = json["position_m"], q = json["rotation_wxyz"];
  return {Vec3(p[0], p[1], p[2]), Quat(q[0], q[1], q[2], q[3])};
}

/// Mean distance of the surface of a to that of b, by the middles of triangles and their areas.
double one_way_m(const TriMesh& a, const MeshDistance& b) {
  double sum = 0, total = 0;
  for (const Triangle& t : a.triangles) {
    const Vec3 &p = a.vertices[t[0]], &q = a.vertices[t[1]], &r = a.vertices[t[2]];
    const double part = 0.5 * (q - p).cross(r - p).norm();
    sum += part * std::abs(b.closest((p + q + r) / 3).signed_distance);
    total += part;
  }
  return sum / total;
}

TriMesh moved(const TriMesh& mesh, const Pose& X) {
  TriMesh out = mesh;
  for (Vec3& v : out.vertices) v = X * v;
  return out;
}

class ImportCt : public CliTest {
 protected:
  struct Limits {
    double each_m, all_m;
  };
  /// Scans and imports; each bone's mean surface error and that of all must stay below the limits.
  void expect_same_bones(const std::string& scan_options, bool left, const Limits& limits) {
    const CaseDef truth = other_wrist(left);
    ASSERT_TRUE(save_case(truth, file("truth")));
    const Ran scanned =
        run_osteon("scan " + file("truth") + " --out " + file("dicom") + " " + scan_options);
    ASSERT_EQ(scanned.exit_code, 0) << scanned.output;
    const Ran imported = run_osteon("import ct " + file("dicom") + " --out " + file("case") +
                                    " --json " + file("found.json"));
    ASSERT_EQ(imported.exit_code, 0) << imported.output;
    const auto found = nlohmann::json::parse(std::ifstream(file("found.json")));
    const auto def = load_case(file("case"));
    ASSERT_TRUE(def) << def.error().message();
    EXPECT_EQ(def->side, truth.side);
    EXPECT_EQ(def->bones.size(), 15u);
    // Scanner: x_P = y_W, y_P = z_W, z_P = x_W.
    Mat3 R_PT;
    R_PT << 0, 1, 0, 0, 0, 1, 1, 0, 0;
    const Pose X_TP = Pose{Vec3::Zero(), Quat(R_PT)}.inverse();
    const Pose X_TW = X_TP * pose_of(found["world_from_patient"]).inverse();
    compare(truth, *def, X_TW, limits);
  }
  static void compare(const CaseDef& truth, const CaseDef& def, const Pose& X_TW,
                      const Limits& limits) {
    double sum = 0;
    for (const BoneDef& bone : truth.bones) {
      const auto same = std::find_if(def.bones.begin(), def.bones.end(),
                                     [&](const BoneDef& b) { return b.name == bone.name; });
      ASSERT_NE(same, def.bones.end()) << bone.name;
      EXPECT_TRUE(topology(same->mesh).closed()) << bone.name;
      const TriMesh mesh = moved(same->mesh, X_TW * same->X_WB);
      const double there = one_way_m(mesh, MeshDistance(bone.mesh));
      const double back = one_way_m(bone.mesh, MeshDistance(mesh));
      std::printf("%-14s %.3f mm, back %.3f mm, %zu triangles, %zu parts\n", bone.name.c_str(),
                  there * 1000, back * 1000, mesh.triangles.size(), topology(mesh).components);
      EXPECT_LT(there, limits.each_m) << bone.name;
      EXPECT_LT(back, limits.each_m) << bone.name;
      sum += 0.5 * (there + back);
    }
    const double all = sum / static_cast<double>(truth.bones.size());
    std::printf("mean %.3f mm\n", all * 1000);
    EXPECT_LT(all, limits.all_m);
  }
};

TEST_F(ImportCt, FineSlicesGiveTheBonesBackWithinAThirdOfAVoxel) {
  if (!std::getenv("OSTEON_LONG"))
    GTEST_SKIP() << "thick slices are tried; fine ones: OSTEON_LONG=1";
  expect_same_bones("--spacing 0.5 --slice 0.5 --noise 30", false, {0.0005 / 3, 0.0005 / 3});
}

// A voxel is 0.5 x 0.5 x 2 mm: all bones together stay within its smallest side, each within half
// of its largest.
TEST_F(ImportCt, ThickSlicesOfALeftHandGiveTheBonesBackWithinAVoxel) {
  expect_same_bones("--spacing 0.5 --slice 2 --noise 30", true, {0.001, 0.0005});
}

}  // namespace
}  // namespace osteon::testing_cli
