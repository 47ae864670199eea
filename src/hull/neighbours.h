#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloud.h"
#include "shell.h"

namespace osteon::hull {

/// For each corner `a` of the hull, survivors among which every edge of the hull at `a` finds a
/// point on its line beyond `a`: mostly the edge's other end, else a point between.
///
/// Why it holds. Let P be the shell and P_a the hull of P and a (P itself for a vertex of P). An
/// edge a b of the hull is an extreme ray of its cone at a. If b is above no facet of P_a at a, the
/// ray lies in the cone of P_a, so it is an edge of P_a and passes through a vertex of P next to a.
/// Else b is above such a facet, a cone facet over an edge of the horizon between a facet g that a
/// sees and a facet h that it does not; its normal is a combination of those of g and h with
/// weights >= 0, so b is above g or h. It is enough therefore to take the facets at a (for a vertex
/// of P) or those that a sees and the next ones (otherwise), their vertices, and all survivors that
/// see them.
class Neighbours {
 public:
  /// The cloud holds the shell's survivors, in their order. Both outlive the neighbours.
  Neighbours(const Cloud& survivors, const Shell& shell);

  std::span<const std::uint32_t> of(std::uint32_t point);

 private:
  struct Range {
    std::uint32_t begin = 0, end = 0;
  };

  void look_around();
  void look_from(std::uint32_t point, std::uint32_t facet);
  void turn_round();
  bool sees(std::uint32_t point, std::uint32_t facet) const;
  void find(std::uint32_t point);
  void facets_around_vertex(std::uint32_t vertex);
  void facets_around_outside_point(std::uint32_t point);
  void add_facet(std::uint32_t facet);
  void add_point(std::uint32_t point, std::uint32_t centre);

  const Cloud& survivors_;
  const Shell& shell_;
  std::vector<std::uint32_t> facet_at_;     ///< a facet of each vertex of the shell
  std::vector<Range> seen_;                 ///< by each point outside, in seen_facets_
  std::vector<std::uint32_t> seen_facets_;  ///< facets that the point is above
  std::vector<Range> watchers_;             ///< of each facet, in watching_points_
  std::vector<std::uint32_t> watching_points_;
  std::vector<std::uint32_t> facet_mark_, point_mark_;  ///< last centre for which it was taken
  std::uint32_t centre_ = 0;
  std::vector<std::uint32_t> facets_;  ///< around the point in hand
  std::vector<Range> found_;           ///< of each point, in pool_; empty until asked for
  std::vector<std::uint32_t> pool_;
};

}  // namespace osteon::hull
