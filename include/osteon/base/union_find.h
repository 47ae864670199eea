#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace osteon {

/// Disjoint sets of 0 .. n - 1 that grow together. A set's name is its lowest member, so names do
/// not depend on the order of the joins. Paths are halved (Tarjan and van Leeuwen 1984), so
/// `find` is near constant time.
class UnionFind {
 public:
  UnionFind() = default;
  explicit UnionFind(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }

  /// A new set of one member; returns its name.
  std::uint32_t add() {
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    return parent_.back();
  }

  /// The name of the set of `member`, which must be less than the count.
  std::uint32_t find(std::uint32_t member) {
    while (parent_[member] != member) member = parent_[member] = parent_[parent_[member]];
    return member;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  /// The name of every member's set.
  std::vector<std::uint32_t> names() {
    for (std::uint32_t i = 0; i < parent_.size(); ++i) parent_[i] = find(i);
    return parent_;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace osteon
