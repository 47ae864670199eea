// What the hand feels where convex pieces meet: the distance field of the same mesh is the truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <vector>

#include "mesh/shapes.h"
#include "osteon/base/random.h"
#include "osteon/hull/decompose.h"
#include "osteon/mesh/isosurface.h"
#include "osteon/mesh/mesh_io.h"
#include "osteon/mesh/repair.h"
#include "stroke.h"
#include "test_scene.h"

namespace osteon {
namespace {

// Two balls of 4 mm with a waist between, as the capitate has one.
const TriMesh& peanut() {
  static const TriMesh mesh = [] {
    IsosurfaceOptions options;
    options.cell_m = 0.0006;
    const ScalarField field = [](const Vec3& p) {
      const double a = (p - Vec3(-0.0035, 0, 0)).norm() - 0.004;
      const double b = (p - Vec3(0.0035, 0, 0)).norm() - 0.004;
      const double blend = std::max(0.0, 1 - std::abs(a - b) / 0.002);
      return std::min(a, b) - 0.25 * 0.002 * blend * blend;
    };
    return std::move(
        isosurface(field, {Vec3::Constant(-0.009), Vec3::Constant(0.009)}, options).value());
  }();
  return mesh;
}

Bone in_pieces(const TriMesh& mesh) {
  Bone bone = test::bone_of(std::move(decompose(mesh)->pieces));
  bone.mesh = mesh;
  return bone;
}

std::shared_ptr<const Case> alone(Bone bone) { return test::Rig::make_case({std::move(bone)}); }

struct Two {
  std::shared_ptr<const Case> pieces, field;
};

const Two& two_peanuts() {
  static const Two cases{alone(in_pieces(peanut())), alone(test::field_bone(peanut()))};
  return cases;
}

// A tick moves the hand by 20 um, which is 2 % of what it is drawn in; the rest is the curvature's.
TEST(Click, AFieldHasNone) {
  const auto tool = std::make_shared<const Tool>(make_wrist_probe());
  const auto& the_case = two_peanuts().field;
  const auto stroke =
      test::stroke_over(*the_case->bones[0].field, Vec3(-0.004, 0, 0.0055), Vec3::UnitX());
  ASSERT_TRUE(stroke);
  const auto felt = test::feel(the_case, tool, *stroke);
  EXPECT_EQ(felt.lost, 0u);
  EXPECT_GT(test::mean_force(felt), 1.0);
  EXPECT_LT(test::worst_jump(felt), 0.03);
}

// Over the waist, where pieces meet.
TEST(Click, PiecesStayBelowFivePercentOfTheForce) {
  const auto tool = std::make_shared<const Tool>(make_wrist_probe());
  const Two& cases = two_peanuts();
  ASSERT_GT(cases.pieces->bones[0].pieces.size(), 1u);
  double worst = 0;
  for (const double turn : {0.0, 0.3, 0.6}) {
    const Vec3 way(std::cos(turn), std::sin(turn), 0);
    const auto stroke =
        test::stroke_over(*cases.field->bones[0].field, Vec3(-0.004, 0, 0.0055), way);
    ASSERT_TRUE(stroke);
    const auto truth = test::feel(cases.field, tool, *stroke);
    const auto felt = test::feel(cases.pieces, tool, *stroke);
    EXPECT_EQ(felt.lost, 0u);
    worst = std::max(worst, test::worst_click(felt, truth));
  }
  RecordProperty("click_percent", std::to_string(100 * worst));
  EXPECT_LT(worst, 0.05);
}

TEST(Click, PiecesOfARealBoneStayBelowFivePercentOfTheForce) {
  const auto file = test::shared_folder() / "anatomy/wrist/lunate.stl";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "needs " << file;
  auto mesh = load_mesh(file, 1);
  ASSERT_TRUE(mesh);
  repair(*mesh);
  const auto tool = std::make_shared<const Tool>(make_wrist_probe());
  const Two cases{alone(in_pieces(*mesh)), alone(test::field_bone(*mesh))};
  const DistanceField& field = *cases.field->bones[0].field;
  double worst = 0;
  for (Eigen::Index k = 0; k < 3; ++k) {
    Vec3 start = field.box().center();
    start[k] = field.box().hi[k] + 0.0005;
    const auto stroke = test::stroke_over(field, start, Vec3::Unit((k + 1) % 3));
    ASSERT_TRUE(stroke);
    const auto truth = test::feel(cases.field, tool, *stroke);
    worst = std::max(worst, test::worst_click(test::feel(cases.pieces, tool, *stroke), truth));
  }
  RecordProperty("click_percent", std::to_string(100 * worst));
  EXPECT_LT(worst, 0.05);
}

// The hand goes through the surface to places on faces deep in the bone, where pieces meet. The
// proxy must rest on the outside, against the outside.
TEST(Click, FacesBetweenPiecesAreNeverFelt) {
  const MeshDistance mesh(peanut());
  const Bone bone = in_pieces(peanut());
  std::vector<Vec3> inner;
  for (const Hull& piece : bone.pieces)
    for (const Triangle& t : piece.triangles) {
      const Vec3 p = (piece.vertices[t[0]] + piece.vertices[t[1]] + piece.vertices[t[2]]) / 3;
      if (mesh.closest(p).signed_distance < -0.0005) inner.push_back(p);
    }
  ASSERT_GT(inner.size(), 3u);
  const double most = 0.0003;  // that pieces stand over the mesh, and more
  test::Rig rig({bone});
  Random random(7);
  int contacts = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 goal = inner[static_cast<std::size_t>(random.next() % inner.size())];
    const Vec3 direction = random.direction();
    const Vec3 from = goal + 0.015 * direction;
    rig.loop.reset();
    rig.at(from);
    test::go(rig, from, goal, 150);
    for (int k = 0; k < 30; ++k) rig.at(goal);
    const ToolState& s = rig.at(goal);
    ASSERT_GT(s.contact_count, 0u) << i;
    ASSERT_GT(mesh.closest(s.X_WP.p).signed_distance, 0.0005) << i;
    for (std::uint32_t k = 0; k < s.contact_count; ++k) {
      const ClosestPoint at = mesh.closest(s.contacts[k].p_W);
      EXPECT_GT(at.signed_distance, -most) << i;
      const Vec3 outwards = (s.X_WP.p - mesh.closest(s.X_WP.p).point).normalized();
      // Within what a tip of 0.75 mm touches of a waist made of pieces; a face between them looks
      // along it.
      EXPECT_GT(s.contacts[k].nhat_BT_W.dot(outwards), 0.3) << i;
      ++contacts;
    }
  }
  EXPECT_GT(contacts, 199);
}

}  // namespace
}  // namespace osteon
