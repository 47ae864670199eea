#include "made_portals.h"

#include <algorithm>

namespace osteon {

void see_made_portal(const BandContacts* contacts, std::span<const Pose> X_WB, Portal& portal) {
  const MadePortal made = contacts ? contacts->made[portal.made] : MadePortal{};
  portal.open = made.open && made.bone < X_WB.size();
  if (!portal.open) return;
  portal.pierced = made.pierced;
  portal.bare = made.bare;
  portal.p_W = X_WB[made.bone] * made.p_B;
  portal.nhat_W = -(X_WB[made.bone].q * made.nhat_B);
}

std::uint32_t entered_portal(const BandContacts& contacts, std::span<const Portal> portals,
                             std::size_t first_made) {
  const std::size_t skins = std::min<std::size_t>(contacts.skin_count, kMaxSkins);
  for (std::size_t s = 0; s < skins; ++s) {
    const SkinContact& skin = contacts.skins[s];
    const std::size_t portal = first_made + skin.made;
    if (skin.through && skin.made != kNotMade && portal < portals.size() && portals[portal].open)
      return static_cast<std::uint32_t>(portal);
  }
  return kNoPortal;
}

}  // namespace osteon
