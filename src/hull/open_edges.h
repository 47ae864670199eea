#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <vector>

namespace osteon::hull {

/// Edges that have a facet on their left only, found by their first point.
class OpenEdges {
 public:
  struct Edge {
    std::uint32_t from, to;  ///< as it runs in its facet
    std::uint32_t beyond;    ///< another point of that facet, off the edge
  };

  explicit OpenEdges(std::uint32_t points) : first_(points, kNone) {}

  /// An edge of a new facet: closes its twin, or waits for it.
  void add(const Edge& edge) {
    if (remove(edge.to, edge.from)) return;
    items_.push_back({edge, first_[edge.from], true});
    first_[edge.from] = static_cast<std::uint32_t>(items_.size() - 1);
  }

  /// The newest edge still open; it stays open until its twin is added.
  std::optional<Edge> next() {
    while (!items_.empty() && !items_.back().open) items_.pop_back();
    if (items_.empty()) return std::nullopt;
    return items_.back().edge;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  struct Item {
    Edge edge;
    std::uint32_t next;  ///< with the same first point
    bool open;
  };

  bool remove(std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t* link = &first_[from]; *link != kNone; link = &items_[*link].next) {
      if (items_[*link].edge.to != to) continue;
      items_[*link].open = false;
      *link = items_[*link].next;
      return true;
    }
    return false;
  }

  std::vector<Item> items_;
  std::vector<std::uint32_t> first_;
};

}  // namespace osteon::hull
