#include "osteon/scene/stumps.h"

#include <gtest/gtest.h>

#include "../../mesh/shapes.h"
#include "osteon/mesh/append_mesh.h"
#include "osteon/mesh/measure.h"
#include "osteon/scene/build_case.h"

namespace osteon {
namespace {

// Balls on two bones, 40 mm apart along x; the second bone's frame stands elsewhere.
Case with_ligament(const TriMesh& mesh_W, const std::string& kind = "ligament") {
  CaseDef def;
  def.name = "two";
  for (const double x : {0.0, 0.04}) {
    BoneDef bone;
    bone.name = x == 0 ? "a" : "b";
    bone.felt = Felt::kHull;
    bone.mesh = test::sphere(0.008, 12);
    bone.X_WB = {Vec3(x, 0, 0), Quat(Eigen::AngleAxisd(x * 20, Vec3::UnitZ()))};
    def.bones.push_back(bone);
  }
  SoftDef soft;
  soft.name = "band";
  soft.tissue = "ligament";
  soft.kind = kind;
  soft.mesh_W = mesh_W;
  soft.bones = {"a", "b"};
  soft.attachments = {{"foot", "a", Vec3(0.008, 0, 0)}, {"head", "b", Vec3(0.032, 0, 0)}};
  def.softs.push_back(soft);
  auto built = build_case(std::move(def));
  EXPECT_TRUE(built) << built.error().message();
  return std::move(*built);
}

TEST(TornStumps, AWholeLigamentHasNone) {
  EXPECT_TRUE(torn_stumps(with_ligament(test::sphere(0.006, 12, Vec3(0.02, 0, 0)))).empty());
}

TEST(TornStumps, OfOneInTwoThePartAtEachFootprintInItsBonesFrame) {
  TriMesh torn = test::sphere(0.003, 12, Vec3(0.029, 0, 0));
  append_mesh(torn, test::sphere(0.004, 12, Vec3(0.012, 0, 0)));
  append_mesh(torn, test::sphere(0.0005, 9, Vec3(0.009, 0, 0)));  // a shred right at the footprint
  const Case the_case = with_ligament(torn);
  const auto stumps = torn_stumps(the_case);
  ASSERT_EQ(stumps.size(), 2u);
  EXPECT_EQ(stumps[0].bone, the_case.find("a"));
  EXPECT_EQ(stumps[1].bone, the_case.find("b"));
  for (const auto& stump : stumps) {
    EXPECT_EQ(stump.soft, 0u);
    EXPECT_TRUE(topology(stump.mesh_B).closed());
    const double x = stump.bone == the_case.find("a") ? 0.012 : 0.029;
    const Vec3 middle_W = the_case.bone(stump.bone).X_WB * centroid(stump.mesh_B);
    EXPECT_LT((middle_W - Vec3(x, 0, 0)).norm(), 1e-5);
  }
  EXPECT_LT((the_case.bone(stumps[1].bone).X_WB * stumps[1].foot_B - Vec3(0.032, 0, 0)).norm(),
            1e-12);
}

// Two loose pieces at one end alone: that end has one stump, the other has the other piece.
TEST(TornStumps, APartServesOneFootprintOnly) {
  TriMesh torn = test::sphere(0.003, 12, Vec3(0.010, 0, 0));
  append_mesh(torn, test::sphere(0.003, 12, Vec3(0.018, 0, 0)));
  const auto stumps = torn_stumps(with_ligament(torn));
  ASSERT_EQ(stumps.size(), 2u);
  EXPECT_NE(centroid(stumps[0].mesh_B), centroid(stumps[1].mesh_B));
}

TEST(TornStumps, OtherPartsThatAreInTwoAreNoStumps) {
  TriMesh torn = test::sphere(0.003, 12, Vec3(0.029, 0, 0));
  append_mesh(torn, test::sphere(0.004, 12, Vec3(0.012, 0, 0)));
  EXPECT_TRUE(torn_stumps(with_ligament(torn, "fat")).empty());
}

}  // namespace
}  // namespace osteon
