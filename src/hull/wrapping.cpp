#include "wrapping.h"

#include <optional>
#include <utility>

#include "first_edge.h"
#include "open_edges.h"
#include "pivot.h"
#include "polygon.h"
#include "predicates.h"

namespace osteon::hull {

void WrappedFacets::add(std::span<const std::uint32_t> polygon_corners) {
  corners.insert(corners.end(), polygon_corners.begin(), polygon_corners.end());
  starts.push_back(static_cast<std::uint32_t>(corners.size()));
}

namespace {

class Wrapper {
 public:
  Wrapper(const Cloud& survivors, const Shell& shell)
      : cloud_(survivors), pivot_(survivors, shell), open_(survivors.size()) {}

  WrappedFacets run() {
    const DirectedEdge first = first_edge(cloud_);
    add_facet(first.from, first.to, off_line(first));
    while (const std::optional<OpenEdges::Edge> edge = open_.next()) {
      add_facet(edge->to, edge->from, edge->beyond);
    }
    return std::move(facets_);
  }

 private:
  /// The facet in which the edge runs from `from` to `to`.
  void add_facet(std::uint32_t from, std::uint32_t to, std::uint32_t guess) {
    const Contact& contact = pivot_.turn(from, to, guess);
    std::vector<std::uint32_t>& polygon = polygon_;
    polygon.assign({from, to, contact.point});
    if (!contact.others.empty()) {
      polygon.insert(polygon.end(), contact.others.begin(), contact.others.end());
      polygon = wrap_polygon(cloud_, std::move(polygon), from, to, contact.point);
    }
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i) {
      open_.add({polygon[i], polygon[(i + 1) % n], polygon[(i + 2) % n]});
    }
    facets_.add(polygon);
  }

  std::uint32_t off_line(DirectedEdge edge) const {
    std::uint32_t i = 0;
    while (collinear(cloud_.raw(edge.from), cloud_.raw(edge.to), cloud_.raw(i))) ++i;
    return i;
  }

  const Cloud& cloud_;
  Pivot pivot_;
  OpenEdges open_;
  std::vector<std::uint32_t> polygon_;
  WrappedFacets facets_;
};

}  // namespace

WrappedFacets wrap(const Cloud& cloud, const Shell& shell) {
  const Cloud survivors(cloud, shell.points);
  WrappedFacets facets = Wrapper(survivors, shell).run();
  for (std::uint32_t& corner : facets.corners) corner = shell.points[corner];
  facets.exact_tests = survivors.exact_tests();
  return facets;
}

}  // namespace osteon::hull
