#include "made_portals.h"

#include <gtest/gtest.h>

#include <array>

namespace osteon {
namespace {

Portal room() {
  Portal portal;
  portal.made = 1;
  portal.open = false;
  return portal;
}

BandContacts one_made(std::uint32_t bone) {
  BandContacts contacts;
  contacts.made[1].open = true;
  contacts.made[1].pierced = true;
  contacts.made[1].bone = bone;
  contacts.made[1].p_B = Vec3(0, 0.02, 0);
  contacts.made[1].nhat_B = Vec3::UnitZ();
  return contacts;
}

TEST(MadePortals, NoneIsOpenBeforeItIsMadeOrOnABoneThatIsNotThere) {
  const std::array<Pose, 1> X_WB{};
  Portal portal = room();
  portal.open = true;
  see_made_portal(nullptr, X_WB, portal);
  EXPECT_FALSE(portal.open);
  const BandContacts nowhere = one_made(1);
  see_made_portal(&nowhere, X_WB, portal);
  EXPECT_FALSE(portal.open);
}

TEST(MadePortals, OneGoesWithItsBoneAndLeadsIntoTheBody) {
  std::array<Pose, 1> X_WB{};
  X_WB[0].p = Vec3(0.1, 0, 0);
  X_WB[0].q = Quat(0, 1, 0, 0);  // half a turn about x
  const BandContacts contacts = one_made(0);
  Portal portal = room();
  see_made_portal(&contacts, X_WB, portal);
  EXPECT_TRUE(portal.open && portal.pierced);
  EXPECT_LT((portal.p_W - Vec3(0.1, -0.02, 0)).norm(), 1e-15);
  EXPECT_LT((portal.nhat_W - Vec3::UnitZ()).norm(), 1e-15);
}

TEST(MadePortals, AShaftEntersThatOfItsPatchWhileItIsOpen) {
  BandContacts contacts;
  std::array<Portal, 3> portals{Portal{}, Portal{}, room()};
  EXPECT_EQ(entered_portal(contacts, portals, 1), kNoPortal);
  contacts.skin_count = 1;
  contacts.skins[0].through = true;
  contacts.skins[0].made = kNotMade;
  EXPECT_EQ(entered_portal(contacts, portals, 1), kNoPortal);
  contacts.skins[0].made = 1;
  EXPECT_EQ(entered_portal(contacts, portals, 1), kNoPortal) << "shut";
  portals[2].open = true;
  EXPECT_EQ(entered_portal(contacts, portals, 1), 2u);
  contacts.skins[0].through = false;
  EXPECT_EQ(entered_portal(contacts, portals, 1), kNoPortal);
}

}  // namespace
}  // namespace osteon
