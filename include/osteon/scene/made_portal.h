#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "osteon/base/types.h"
#include "osteon/scene/skin_contact.h"

namespace osteon {

/// The most portals that can be made in one patch of skin.
inline constexpr std::size_t kMadePerPatch = 3;
inline constexpr std::size_t kMaxMade = kMaxSkins * kMadePerPatch;

/// A hole that was made in a patch of skin and holds shafts as a portal does: physics tells it to
/// every hand. By number: those of the first patch, those of the second, and so on.
struct MadePortal {
  bool open = false;
  bool pierced = false;         ///< else a cut let the shaft in
  bool bare = false;            ///< its patch is felt no more: any shaft goes in there
  std::uint32_t bone = 0;       ///< that it goes with
  Vec3 p_B = Vec3::Zero();      ///< on the skin at rest
  Vec3 nhat_B = Vec3::UnitZ();  ///< unit, out of the skin
  bool operator==(const MadePortal&) const = default;
};
using MadePortals = std::array<MadePortal, kMaxMade>;

}  // namespace osteon
