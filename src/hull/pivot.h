#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cloud.h"
#include "neighbours.h"
#include "point_tree.h"
#include "shell.h"

namespace osteon::hull {

/// A facet turned about an edge until no point lies above it.
struct Contact {
  std::uint32_t point = 0;            ///< spans the facet with the edge
  std::vector<std::uint32_t> others;  ///< the facet's further points, and all on the edge's line
};

/// The wrapping step. About an edge of the hull all points lie in a wedge narrower than pi, so
/// "above the plane of the best point so far" orders them by angle.
///
/// A linear function that is not largest at a corner grows along some edge there, so a plane
/// through the edge supports the hull once none of the first corner's neighbours is above. If, in
/// addition, none of both corners' neighbours is on the plane but the one point, the facet is their
/// triangle. Only when some are, the whole facet is gathered, with a tree over all survivors.
class Pivot {
 public:
  /// The cloud holds the shell's survivors, in their order. Both outlive the pivot.
  Pivot(const Cloud& survivors, const Shell& shell)
      : survivors_(survivors), shell_(shell), neighbours_(survivors, shell) {}

  /// The facet in which the hull's edge runs from `from` to `to`, both corners. `guess` is any
  /// point off the edge's line. The result holds until the next call.
  const Contact& turn(std::uint32_t from, std::uint32_t to, std::uint32_t guess);

 private:
  enum class Finding { kAllBelow, kTurned, kOnPlane };

  void take(std::uint32_t point);
  bool is_mine(std::uint32_t p) const { return p == from_ || p == to_ || p == contact_.point; }
  std::uint32_t foremost(std::span<const std::uint32_t> points) const;
  Finding settle(std::span<const std::uint32_t> points);
  bool turn_to_triangle();

  void gather();
  void scan(const PointTree::Node& leaf);
  bool may_reach(double highest) const { return !(highest < -plane_.bound); }

  const Cloud& survivors_;
  const Shell& shell_;
  Neighbours neighbours_;
  std::optional<PointTree> tree_;  ///< made when first needed
  std::uint32_t from_ = 0, to_ = 0;
  FilterPlane plane_;
  std::uint32_t turns_ = 0;  ///< how often the plane has moved
  Contact contact_;
  struct Waiting {
    std::uint32_t node;
    std::uint32_t turns;  ///< when the node was found to reach the plane
  };
  std::vector<Waiting> stack_;
};

}  // namespace osteon::hull
