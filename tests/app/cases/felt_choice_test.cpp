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
