// A ball of a bone in a ball of skin is known by its radii.
#include "osteon/xray/case_body.h"

#include <gtest/gtest.h>

#include "phantoms.h"

namespace osteon {
namespace {

using namespace testing_xray;

constexpr double kBone_m = 0.012, kSkin_m = 0.030;

Case ball_case(bool with_skin) {
  Case made;
  made.name = "ball";
  Bone bone;
  bone.name = "ball";
  bone.X_WB.p = Vec3(0.001, 0, 0);
  bone.mesh = ball(Vec3(-0.001, 0, 0), kBone_m, 64);
  made.bones.push_back(bone);
  if (!with_skin) return made;
  SoftPart skin;
  skin.name = skin.kind = skin.tissue = "skin";
  skin.mesh_W = ball(Vec3::Zero(), kSkin_m, 40);
  made.softs.push_back(skin);
  return made;
}

double middle_of(const Case& from, const CaseBodyOptions& options = {}) {
  const auto body = CaseBody::create(from, *load_default_tissues(), options);
  EXPECT_TRUE(body) << body.error().message();
  const auto got = areal_density(body->at_rest(), view_from_above(33));
  EXPECT_TRUE(got);
  return static_cast<double>(got->total()[16 * 33 + 16]);
}

double density(const char* tissue) {
  return density_from_hu(load_default_tissues()->find(tissue)->hu.value);
}

TEST(CaseBody, LayersLieAtTheirDepths) {
  const double bone_cm = 2 * (0.12 * density("cortical_bone") + 1.08 * density("cancellous_bone"));
  const double flesh_cm =
      2 * (0.15 * density("skin") + 0.2 * density("fat") + (3 - 0.35 - 1.2) * density("muscle"));
  EXPECT_NEAR(middle_of(ball_case(true)), bone_cm + flesh_cm, 0.005 * (bone_cm + flesh_cm));
  const double bare_cm = bone_cm + 2 * 0.8 * density("muscle");
  EXPECT_NEAR(middle_of(ball_case(false)), bare_cm, 0.003 * bare_cm);
}

TEST(CaseBody, OneHuIsOneMaterialAndNothingElse) {
  CaseBodyOptions options;
  options.bones_hu = 800;
  const double want = 2.4 * density_from_hu(800);
  EXPECT_NEAR(middle_of(ball_case(true), options), want, 0.003 * want);
}

TEST(CaseBody, BonesStandWhereTheSnapshotPutsThem) {
  CaseBodyOptions options;
  options.bones_hu = 800;
  const Case from = ball_case(false);
  const auto body = CaseBody::create(from, *load_default_tissues(), options);
  ASSERT_TRUE(body);
  BoneSnapshot moved = rest_snapshot(from);
  moved.bones[0].X_WB.p += Vec3(0.01, 0, 0);
  const auto got = areal_density(body->posed(moved), view_from_above(33));
  ASSERT_TRUE(got);
  const XrayView view = view_from_above(33);
  const double chord = chord_in_ball(view.source_W, ray_W(view, 24, 16), Vec3(0.01, 0, 0), kBone_m);
  EXPECT_NEAR(got->total()[16 * 33 + 24], 100 * chord * density_from_hu(800),
              chord * density_from_hu(800));  // within 1 %
}

TEST(CaseBody, ASoftPartFollowsItsBones) {
  Case from = ball_case(true);
  from.softs[0].kind = "fat";
  from.softs[0].tissue = "fat";
  from.softs[0].bones = {BoneId{0}};
  CaseBodyOptions options;
  options.flesh_m = 0;
  const auto body = CaseBody::create(from, *load_default_tissues(), options);
  ASSERT_TRUE(body);
  BoneSnapshot moved = rest_snapshot(from);
  moved.bones[0].X_WB.p += Vec3(0.2, 0, 0);
  const auto got = areal_density(body->posed(moved), view_from_above(33));
  ASSERT_TRUE(got);
  EXPECT_EQ(got->total()[16 * 33 + 16], 0);
}

TEST(CaseBody, FleshGrowsAroundBoneThatReachesOutOfTheSkin) {
  Case from = ball_case(true);
  for (Vec3& v : from.softs[0].mesh_W.vertices) v += Vec3(0.2, 0, 0);
  const double want = 2 * (0.12 * density("cortical_bone") + 1.08 * density("cancellous_bone") +
                           0.8 * density("muscle"));
  EXPECT_NEAR(middle_of(from), want, 0.003 * want);
}

TEST(CaseBody, BadCasesAreRefusedByName) {
  const TissueTable tissues = *load_default_tissues();
  Case open = ball_case(true);
  open.bones[0].mesh.triangles.pop_back();
  auto got = CaseBody::create(open, tissues);
  ASSERT_FALSE(got);
  EXPECT_EQ(got.error().where, "bone 'ball'");
  Case open_skin = ball_case(true);
  open_skin.softs[0].mesh_W.triangles.pop_back();
  got = CaseBody::create(open_skin, tissues);
  ASSERT_FALSE(got);
  EXPECT_EQ(got.error().where, "soft part 'skin'");
  EXPECT_FALSE(CaseBody::create(Case{}, tissues));
  EXPECT_FALSE(CaseBody::create(ball_case(true), TissueTable{}));
  CaseBodyOptions thick;
  thick.cortical_m = -1;
  EXPECT_FALSE(CaseBody::create(ball_case(true), tissues, thick));
}

}  // namespace
}  // namespace osteon
