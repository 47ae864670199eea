#pragma once

#include <cstdint>
#include <span>

#include "osteon/scene/portal.h"
#include "osteon/scene/skin_contact.h"
#include "osteon/scene/soft_band.h"

namespace osteon {

/// Puts a portal that can be made where it is in this tick: open and on its bone, or shut. Null
/// `contacts`: nothing soft is felt, so none is made. `X_WB`: poses of the bones in World.
void see_made_portal(const BandContacts* contacts, std::span<const Pose> X_WB, Portal& portal);

/// The open one of `portals` through which a patch of skin lets the tool, kNoPortal: none.
/// `first_made`: the portals from there on are those that can be made.
std::uint32_t entered_portal(const BandContacts& contacts, std::span<const Portal> portals,
                             std::size_t first_made);

}  // namespace osteon
