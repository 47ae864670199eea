// Marks that are pressed: on bone, and on a meniscus that is felt.
#include "exercises/tunnel_watch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/procedure/tunnel_events.h"
#include "osteon/scene/build_case.h"

namespace osteon {
namespace {

TriMesh felt_block(const Vec3& half_m, const Vec3& middle_m) {
  TriMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(middle_m + Vec3((i & 1) ? half_m.x() : -half_m.x(),
                                            (i & 2) ? half_m.y() : -half_m.y(),
                                            (i & 4) ? half_m.z() : -half_m.z()));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

// A tibia, a meniscus on it, a mark on each, and a tibial tunnel that nobody drills.
class TunnelWatchMarks : public ::testing::Test {
 protected:
  static constexpr std::uint32_t kHorn = 0, kPlateau = 1;
  static Case knee() {
    CaseDef def;
    def.name = "block with a meniscus";
    BoneDef bone;
    bone.name = "tibia";
    bone.mesh = felt_block({0.02, 0.02, 0.01}, Vec3::Zero());
    def.bones = {bone};
    SoftDef soft;
    soft.name = "medial_meniscus";
    soft.tissue = soft.kind = "meniscus";
    soft.mesh_W = felt_block({0.006, 0.006, 0.002}, {0, 0, 0.012});
    soft.bones = {"tibia"};
    def.softs = {soft};
    def.landmarks = {{"horn", {0, 0, 0.014}, Vec3::Zero(), "tibia"},
                     {"plateau", {0.012, 0, 0.010}, Vec3::Zero(), "tibia"}};
    auto made = build_case(std::move(def));
    EXPECT_TRUE(made) << made.error().message();
    return std::move(*made);
  }
  static ScenarioPlan plan() {
    ScenarioPlan out;
    out.goals.emplace_back().emplace_back();
    out.goals[0][0].rule.kind = "felt";
    out.goals[0][0].bones = {kHorn, kPlateau};
    return out;
  }
  // At the tip, a tick in which marks are looked at.
  std::vector<Event> pressed(const Vec3& p_W, bool on_bone, double soft_n, double force_n = 0.5) {
    ToolState tool;
    tool.tick = tick_ += 10;
    tool.X_WP.p = p_W;
    tool.force_W = {0, 0, force_n};
    tool.contact_count = on_bone ? 1 : 0;
    bones_.softs.touches[0] = {0, soft_n};
    const ToolState* const all[] = {&tool};
    std::vector<Event> events;
    watch_.add(all, bones_, events);
    return events;
  }
  Case case_ = knee();
  ScenarioPlan plan_ = plan();
  BoneSnapshot bones_ = rest_snapshot(case_);
  std::uint64_t tick_ = 0;
  TunnelWatch watch_{plan_, case_, TunnelSources{"builtin:knee", {}}, {0}, {0.0}, 0.001};
};

TEST_F(TunnelWatchMarks, AMarkOnAMeniscusIsFeltThereAndNotOnBone) {
  EXPECT_TRUE(pressed({0, 0, 0.014}, false, 0).empty());
  const auto soft = pressed({0.003, 0, 0.014}, false, 0.4);
  ASSERT_EQ(soft.size(), 1u);
  EXPECT_EQ(soft[0].kind, kMarkFelt);
  EXPECT_EQ(soft[0].subject, kHorn);
  EXPECT_NEAR(soft[0].values[0], 3, 1e-9);
  EXPECT_NEAR(soft[0].values[1], 0.5, 1e-12);
  const auto bone = pressed({0.003, 0, 0.014}, true, 0);
  ASSERT_EQ(bone.size(), 1u);
  EXPECT_EQ(bone[0].subject, kPlateau);
  EXPECT_EQ(pressed({0.003, 0, 0.014}, true, 0.4).size(), 2u);
}

TEST_F(TunnelWatchMarks, AnotherSoftPartIsNotTheMeniscus) {
  ToolState tool;
  tool.tick = 10;
  tool.X_WP.p = {0, 0, 0.014};
  bones_.softs.touches[0] = {7, 0.4};
  const ToolState* const all[] = {&tool};
  std::vector<Event> events;
  watch_.add(all, bones_, events);
  EXPECT_TRUE(events.empty());
}

TEST_F(TunnelWatchMarks, ANumberThatIsNoneIsNotFelt) {
  EXPECT_TRUE(pressed({0, 0, 0.014}, false, 0.4, std::nan("")).empty());
}

}  // namespace
}  // namespace osteon
