#include "case/soft_parts.h"

#include <gtest/gtest.h>

#include "../../mesh/shapes.h"
#include "osteon/scene/case_io.h"

namespace osteon {
namespace {

CaseDef two_balls() {
  CaseDef def;
  def.name = "two";
  for (const double x : {0.0, 0.02}) {
    BoneDef bone;
    bone.name = x == 0 ? "a" : "b";
    bone.felt = Felt::kHull;
    bone.mesh = test::sphere(0.008, 12);
    bone.X_WB.p = Vec3(x, 0, 0);
    def.bones.push_back(bone);
  }
  return def;
}

SoftDef ball_between() {
  SoftDef soft;
  soft.name = "disc";
  soft.tissue = "meniscus";
  soft.kind = "disc";
  soft.mesh_W = test::sphere(0.0015, 9, Vec3(0.01, 0, 0));
  soft.bones = {"a", "b"};
  soft.attachments = {{"rim", "a", Vec3(0.008, 0, 0)}};
  return soft;
}

CaseDef with(const SoftDef& soft) {
  CaseDef def = two_balls();
  def.softs.push_back(soft);
  return def;
}

TEST(SoftParts, ARunIsTheSameWithAndWithoutThem) {
  const auto plain = build_case(two_balls());
  const auto soft = build_case(with(ball_between()));
  ASSERT_TRUE(plain && soft);
  EXPECT_EQ(soft->softs[0].bones[1].index, 1u);
  EXPECT_EQ(plain->hash, soft->hash);
}

TEST(SoftParts, WhatDoesNotFitTheCaseIsRefused) {
  const auto refused = [](const SoftDef& soft, const char* word) {
    const auto built = build_case(with(soft));
    ASSERT_FALSE(built) << word;
    EXPECT_NE(built.error().message().find(word), std::string::npos) << built.error().message();
  };
  SoftDef soft = ball_between();
  soft.bones = {"c"};
  refused(soft, "'c'");
  soft = ball_between();
  soft.attachments[0].bone = "c";
  refused(soft, "'c'");
  soft = ball_between();
  soft.kind = "jelly";
  refused(soft, "jelly");
  soft = ball_between();
  soft.mesh_W = {};
  refused(soft, "triangles");
  CaseDef twice = with(ball_between());
  twice.softs.push_back(ball_between());
  EXPECT_FALSE(build_case(twice));
}

TEST(SoftParts, TheCheckFindsHolesDepthAndAttachmentsOffTheBone) {
  EXPECT_TRUE(check_softs(with(ball_between())).empty());
  SoftDef soft = ball_between();
  soft.mesh_W.triangles.pop_back();
  EXPECT_EQ(check_softs(with(soft)).size(), 1u);
  soft = ball_between();
  for (Vec3& v : soft.mesh_W.vertices) v.x() += 0.0025;  // 2 mm into b
  const auto deep = check_softs(with(soft));
  ASSERT_EQ(deep.size(), 1u);
  EXPECT_NE(deep[0].find("into the b"), std::string::npos) << deep[0];
  soft = ball_between();
  soft.attachments[0].p_W.x() += 0.003;
  const auto off = check_softs(with(soft));
  ASSERT_EQ(off.size(), 1u);
  EXPECT_NE(off[0].find("'rim'"), std::string::npos) << off[0];
  soft = ball_between();
  soft.bones = {"c"};
  EXPECT_EQ(check_softs(with(soft)).size(), 1u);
}

}  // namespace
}  // namespace osteon
