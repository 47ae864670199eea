#pragma once

#include <compare>
#include <cstdint>

namespace osteon {

/// Index with a type: an Id<Bone> cannot be passed where an Id<Tool> is meant.
template <class Tag>
struct Id {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::uint32_t index = kNone;

  bool valid() const { return index != kNone; }
  auto operator<=>(const Id&) const = default;
};

using BoneId = Id<struct BoneTag>;

}  // namespace osteon
