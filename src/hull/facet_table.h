#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "osteon/base/types.h"

namespace osteon::hull {

using Corners = std::array<Vec3, 3>;  ///< of a triangle

/// What is known of triangles, by the bits of their corners in their order. The hulls of a part and
/// of its halves share most of their facets, so that most are met again.
template <class Known>
class FacetTable {
 public:
  /// The entry, and true when it was made now.
  std::pair<Known&, bool> find_or_make(const Corners& t) {
    Key key{};
    for (std::size_t i = 0; i < key.size(); ++i)
      key[i] = std::bit_cast<std::uint64_t>(t[i / 3][static_cast<Eigen::Index>(i % 3)]);
    const auto [at, made] = entries_.try_emplace(key);
    return {at->second, made};
  }
  void clear() { entries_.clear(); }

 private:
  using Key = std::array<std::uint64_t, 9>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t h = 0;
      for (const std::uint64_t word : key) {
        h = (h ^ word) * 0x9e3779b97f4a7c15ull;  // Knuth's multiplicative hash, golden ratio
        h ^= h >> 32;
      }
      return static_cast<std::size_t>(h);
    }
  };
  std::unordered_map<Key, Known, Hash> entries_;  // never walked: its order is of no account
};

}  // namespace osteon::hull
