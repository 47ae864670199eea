#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tunnel_patch.h"
#include "tunnel_prism.h"

namespace osteon::tunnel {

/// Where an edge goes through a side of the prism.
struct Crossing {
  double t = 0;             ///< along the edge from `lo` to `hi`
  int side = 0;             ///< of the prism
  std::uint32_t point = 0;  ///< of the patch, added for it
  bool entering = false;    ///< seen from `lo` to `hi`
};

struct CrossedEdge {
  EdgeKey key;
  std::uint8_t count = 0;
  std::array<Crossing, 2> crossings;  ///< by t
};

/// How the points and edges of a patch lie to the prism's sides. Every answer is given once, so
/// that the facets on both sides of an edge get the same.
class EdgeTable {
 public:
  /// Looks at the facets within the layer; adds a point to the patch for each crossing.
  EdgeTable(Patch& patch, const Prism& prism);

  /// False where rounding gave an edge an impossible way.
  bool sound() const { return sound_; }
  /// Least distance of a point from the prism's sides and of an edge from its columns.
  double clearance() const { return clearance_; }
  bool inside(std::uint32_t point) const { return inside_[point] != 0; }
  const CrossedEdge* find(std::uint32_t a, std::uint32_t b) const;
  std::span<const CrossedEdge> crossed() const { return crossed_; }

 private:
  void sort_points(const Patch& patch, const Prism& prism);
  std::vector<EdgeKey> edges_within(const Patch& patch) const;
  void cross(const Patch& patch, const Prism& prism, const EdgeKey& key);
  void keep_clear(const Prism& prism, int side, const Vec2& a, const Vec2& b);

  std::vector<std::uint8_t> inside_;
  std::vector<CrossedEdge> crossed_;  ///< by key
  double clearance_ = 0;
  bool sound_ = true;
};

}  // namespace osteon::tunnel
