#include "cases/felt_choice.h"

#include <gtest/gtest.h>

#include "mesh/shapes.h"

namespace osteon {
namespace {

CaseDef two_bones() {
  CaseDef def;
  def.bones.resize(2);
  def.bones[0].name = "lunate";
  def.bones[1].name = "capitate";
  return def;
}

TEST(FeltChoice, ACaseWithoutOneIsLeftAlone) {
  const auto choice = parse_felt_choice("builtin:wrist");
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->source, "builtin:wrist");
  EXPECT_TRUE(choice->of_bone.empty());
  EXPECT_EQ(to_text(*choice), "builtin:wrist");
}

TEST(FeltChoice, NonsenseIsAnError) {
  EXPECT_FALSE(parse_felt_choice("x#soft"));
  EXPECT_FALSE(parse_felt_choice("x#lunate="));
  EXPECT_FALSE(parse_felt_choice("x#lunate=hull,,"));
  CaseDef def = two_bones();
  EXPECT_FALSE(apply(parse_felt_choice("x#femur=hull").value(), def));
}

TEST(FeltChoice, OneBoneAndAllOthers) {
  const auto choice = parse_felt_choice("a#b#field,lunate=hull");
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->source, "a#b");
  CaseDef def = two_bones();
  ASSERT_TRUE(apply(*choice, def));
  EXPECT_EQ(def.bones[0].felt, Felt::kHull);
  EXPECT_EQ(def.bones[1].felt, Felt::kField);
  EXPECT_EQ(to_text(*choice), "a#b#field,lunate=hull");
}

TEST(FeltChoice, AKneeMayEndNearItsJoint) {
  const auto choice = parse_felt_choice("builtin:knee:3#femur=field,flexion=120,near=100");
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->near_mm, 100);
  EXPECT_FALSE(choice->bent.contains("near"));
  EXPECT_EQ(to_text(*choice), "builtin:knee:3#femur=field,flexion=120,near=100");
  EXPECT_FALSE(parse_felt_choice("builtin:knee#near=10"));
  EXPECT_FALSE(parse_felt_choice("builtin:knee#near=500"));
}

TEST(FeltChoice, AJointMayBeginOtherwiseBent) {
  const std::string spec = "builtin:knee:3#femur=field,flexion=120,begin_flexion=80,near=100";
  const auto choice = parse_felt_choice(spec);
  ASSERT_TRUE(choice) << choice.error().message();
  EXPECT_EQ(choice->bent.at("flexion"), 120);
  EXPECT_EQ(choice->begins.at("flexion"), 80);
  EXPECT_EQ(to_text(*choice), spec);
  CaseDef def;
  def.bones.resize(1);
  def.bones[0].name = "femur";
  EXPECT_FALSE(apply(*choice, def));  // it has no such joint
  def.joints.emplace_back();
  def.joints[0].name = "flexion";
  ASSERT_TRUE(apply(*choice, def));
  EXPECT_EQ(def.joints[0].begin_deg, 80);
}

TEST(FeltChoice, PortalsMayBeElsewhere) {
  const std::string spec = "builtin:knee#flexion=120,portal_al=31.5/-20/4/0/0.5/-0.5";
  const auto choice = parse_felt_choice(spec);
  ASSERT_TRUE(choice) << choice.error().message();
  EXPECT_FALSE(choice->bent.contains("portal_al"));
  ASSERT_TRUE(choice->portals.contains("portal_al"));
  EXPECT_LT((choice->portals.at("portal_al").p_W - Vec3(0.0315, -0.020, 0.004)).norm(), 1e-12);
  EXPECT_NEAR(choice->portals.at("portal_al").inwards_W.norm(), 1, 1e-12);
  const auto again = parse_felt_choice(to_text(*choice));
  ASSERT_TRUE(again);
  EXPECT_EQ(to_text(*again), to_text(*choice));
  CaseDef def = two_bones();
  EXPECT_FALSE(apply(*choice, def));
  def.landmarks.push_back({"portal_al", Vec3::Zero()});
  def.landmarks.push_back({"portal_am", Vec3::Zero()});
  ASSERT_TRUE(apply(*choice, def));
  EXPECT_EQ(def.landmarks[0].p_W, choice->portals.at("portal_al").p_W);
  EXPECT_EQ(def.landmarks[0].inwards_W, choice->portals.at("portal_al").inwards_W);
  EXPECT_EQ(def.landmarks[1].p_W, Vec3::Zero());
  for (const char* bad :
       {"portal_al=", "portal_al=1", "portal_al=1/2/3/0/0", "portal_al=1/2/3/0/0/0",
        "portal_al=1/2/nan/0/0/1", "portal_al=1/2/1e9/0/0/1", "portal_al=1/2/3/0/0/1/1",
        "portal_al=a/2/3/0/0/1"})
    EXPECT_FALSE(parse_felt_choice("builtin:knee#" + std::string(bad))) << bad;
}

TEST(FeltChoice, SomethingMayLieBesideIt) {
  const auto choice = parse_felt_choice("builtin:knee#femur=field,near=100,beside=graft_bench");
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->beside, "graft_bench");
  EXPECT_EQ(to_text(*choice), "builtin:knee#femur=field,near=100,beside=graft_bench");
}

TEST(FeltChoice, AJointIsBentBesideWhatIsFelt) {
  const auto choice = parse_felt_choice("knee#hull,flexion=72.5");
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->bent.at("flexion"), 72.5);
  EXPECT_EQ(choice->of_bone.at(""), Felt::kHull);
  EXPECT_EQ(to_text(*choice), "knee#hull,flexion=72.5");
  EXPECT_EQ(bent_spec("knee", "flexion", 30).value(), "knee#flexion=30");
  EXPECT_EQ(bent_spec("knee#hull,flexion=72.5", "flexion", 0).value(), "knee#hull,flexion=0");
  EXPECT_FALSE(parse_felt_choice("knee#flexion=nan"));
  EXPECT_FALSE(parse_felt_choice("knee#72"));
}

}  // namespace
}  // namespace osteon
