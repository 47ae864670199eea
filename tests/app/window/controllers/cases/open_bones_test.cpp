#include "window/controllers/cases/open_bones.h"

#include <gtest/gtest.h>

#include "mesh/shapes.h"
#include "osteon/scene/build_case.h"

namespace osteon {
namespace {

Case of_bones(int closed, int open) {
  CaseDef def;
  for (int i = 0; i < closed + open; ++i) {
    BoneDef bone;
    bone.name = "metacarpal_" + std::to_string(i + 1);
    bone.mesh = test::cube(0.01);
    if (i >= closed) bone.mesh.triangles.pop_back();
    def.bones.push_back(std::move(bone));
  }
  return build_case(std::move(def)).value();
}

TEST(OpenBones, ClosedOnesNeedNoNotice) {
  const Case the_case = of_bones(2, 0);
  EXPECT_EQ(open_bones(the_case), (std::vector<bool>{false, false}));
  EXPECT_EQ(open_bones_notice(the_case), "");
}

TEST(OpenBones, AreNamedAndCounted) {
  EXPECT_EQ(open_bones(of_bones(1, 1)), (std::vector<bool>{false, true}));
  const std::string one = open_bones_notice(of_bones(1, 1)),
                    many = open_bones_notice(of_bones(0, 5));
  EXPECT_EQ(one.find("A bone has an open surface"), 0u) << one;
  EXPECT_NE(one.find(": Metacarpal 2."), std::string::npos) << one;
  EXPECT_EQ(many.find("5 bones have an open surface"), 0u) << many;
  EXPECT_NE(many.find("Metacarpal 3 and 2 more."), std::string::npos) << many;
}

}  // namespace
}  // namespace osteon
