#include "osteon/scene/portal.h"

#include <gtest/gtest.h>

#include "mesh/shapes.h"

namespace osteon {
namespace {

Case ball_case(bool with_skin) {
  Case out;
  Bone bone;
  bone.name = "bone";
  bone.mesh = test::cube(0.004);
  out.bones.push_back(bone);
  if (with_skin) {
    SoftPart skin;
    skin.kind = "skin";
    skin.mesh_W = test::sphere(0.03, 40);
    out.softs.push_back(skin);
  }
  out.landmarks = {{"lister_tubercle", Vec3::Zero()},
                   {"portal_3_4", 0.03 * Vec3(1, 2, 2) / 3},
                   {"portal_mcr", Vec3(0, 0, -0.03)},
                   {"portal_", Vec3::Zero()}};
  return out;
}

TEST(FindPortals, AreTheLandmarksOfThatName) {
  const std::vector<Portal> portals = find_portals(ball_case(true));
  ASSERT_EQ(portals.size(), 2u);
  EXPECT_EQ(portals[0].title, "3-4");
  EXPECT_EQ(portals[1].title, "MCR");
  EXPECT_EQ(portals[1].landmark, 2u);
  EXPECT_EQ(find_portal(portals, "3-4"), &portals[0]);
  EXPECT_EQ(find_portal(portals, "portal_mcr"), &portals[1]);
  EXPECT_EQ(find_portal(portals, "6R"), nullptr);
  EXPECT_TRUE(find_portals(Case()).empty());
}

TEST(FindPortals, GoInAgainstTheSkin) {
  for (const Portal& portal : find_portals(ball_case(true)))
    EXPECT_GT(portal.nhat_W.dot(-portal.p_W.normalized()), 0.999) << portal.name;
  // Without skin towards the bone, which is the same for a small one in the middle.
  for (const Portal& portal : find_portals(ball_case(false)))
    EXPECT_GT(portal.nhat_W.dot(-portal.p_W.normalized()), 0.9) << portal.name;
}

TEST(FindPortals, TheSkinIsThatOfTheTissueTable) {
  const auto tissues = load_default_tissues();
  ASSERT_TRUE(tissues);
  const Tissue* skin = tissues->find("skin");
  ASSERT_NE(skin, nullptr);
  const PortalSkin out = portal_skin(*skin);
  EXPECT_EQ(out.stiffness_n_per_m, skin->stiffness_n_per_m.value);
  EXPECT_EQ(out.static_friction, skin->static_friction.value);
  EXPECT_EQ(find_portals(ball_case(true), out)[0].skin.dynamic_friction,
            skin->dynamic_friction.value);
  EXPECT_NE(hash_of(find_portals(ball_case(true))), hash_of(find_portals(ball_case(false))));
}

}  // namespace
}  // namespace osteon
