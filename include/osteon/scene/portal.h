#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/image/tissue.h"
#include "osteon/scene/case.h"
#include "osteon/scene/skin_contact.h"
#include "osteon/scene/state.h"

namespace osteon {

/// How the skin about a portal answers a shaft.
struct PortalSkin {
  double stiffness_n_per_m = 400;  ///< sideways, until the hole gives no more
  double static_friction = 0.4;
  double dynamic_friction = 0.3;
  double squeeze_n = 1.5;  ///< with which it presses a shaft that passes straight; own default
};

/// A hole in the skin through which a shaft passes.
struct Portal {
  std::string name;              ///< of its landmark: "portal_3_4"
  std::string title;             ///< "3-4"
  std::uint32_t landmark = 0;    ///< in Case::landmarks; of a made one the place it is meant for
  Vec3 p_W = Vec3::Zero();       ///< on the skin; of a made one nothing before it is made
  Vec3 nhat_W = -Vec3::UnitZ();  ///< unit, into the body
  PortalSkin skin;
  /// Number among those that a student can make in patches of skin (MadePortal).
  std::uint32_t made = kNotMade;
  bool open = true;  ///< a made one: not before it is made
  bool pierced = false;
  bool bare = false;  ///< a made one: entered like one of the case, its skin is felt no more
};

/// Those of a case: its landmarks whose names begin with "portal_", so that they lie where they
/// belong in any patient grown from a description. Inwards is as the
/// landmark says; where it does not, against the skin's normal about it; in a case without skin,
/// towards the nearest bone.
std::vector<Portal> find_portals(const Case& the_case, const PortalSkin& skin = {});

/// Room for those that can be made about a place: `first`: number of the first one. They are shut.
/// `landmark`: kNoSubject where the place is none.
std::vector<Portal> room_to_make(std::string_view place, std::uint32_t landmark,
                                 std::uint32_t first, const PortalSkin& skin);

/// From the tissue table's skin.
PortalSkin portal_skin(const Tissue& skin);

/// Null: no portal has that name or title.
const Portal* find_portal(const std::vector<Portal>& portals, std::string_view name);

/// Over all that a tick depends on.
std::uint64_t hash_of(const std::vector<Portal>& portals);

/// Where a shaft is in the portals of its case; part of a session's state.
struct PortalHold {
  static constexpr std::uint32_t kNone = kNoPortal;
  std::uint32_t portal = kNone;  ///< index of the one that it passes through
  double anchor_m = 0;           ///< depth at which the skin's friction holds it
  bool sliding = false;
  double grip = 0;         ///< 0 to 1: how far the skin has closed about it
  double tip_depth_m = 0;  ///< of the nearest portal, at the last tick
  std::uint32_t nearest = kNone;
};

}  // namespace osteon
