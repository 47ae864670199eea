#include "neighbours.h"

#include <algorithm>

namespace osteon::hull {

namespace {
constexpr std::uint32_t kNone = 0xffffffffu;
}

Neighbours::Neighbours(const Cloud& survivors, const Shell& shell)
    : survivors_(survivors),
      shell_(shell),
      facet_at_(shell.vertices),
      seen_(shell.points.size()),
      watchers_(shell.facets.size()),
      facet_mark_(shell.facets.size(), kNone),
      point_mark_(shell.points.size(), kNone),
      found_(shell.points.size()) {
  for (std::uint32_t f = 0; f < shell.facets.size(); ++f) {
    for (const std::uint32_t v : shell.facets[f].v) facet_at_[v] = f;
  }
  look_around();
  turn_round();
  std::fill(facet_mark_.begin(), facet_mark_.end(), kNone);
}

bool Neighbours::sees(std::uint32_t point, std::uint32_t facet) const {
  const Shell::Facet& f = shell_.facets[facet];
  const double h = f.plane.height(survivors_.scaled(point));
  if (h > f.plane.bound) return true;
  if (h < -f.plane.bound) return false;
  return survivors_.exact_side(f.v[0], f.v[1], f.v[2], point) > 0;
}

void Neighbours::look_around() {
  for (std::uint32_t f = 0; f < shell_.facets.size(); ++f) {
    const Shell::Facet& facet = shell_.facets[f];
    for (std::uint32_t p = facet.outside_begin; p < facet.outside_end; ++p) look_from(p, f);
  }
}

/// The facets that a point sees hang together.
void Neighbours::look_from(std::uint32_t point, std::uint32_t facet) {
  const auto begin = static_cast<std::uint32_t>(seen_facets_.size());
  seen_facets_.push_back(facet);
  facet_mark_[facet] = point;
  for (std::uint32_t k = begin; k < seen_facets_.size(); ++k) {
    for (const std::uint32_t n : shell_.facets[seen_facets_[k]].adjacent) {
      if (facet_mark_[n] == point) continue;
      facet_mark_[n] = point;
      if (sees(point, n)) seen_facets_.push_back(n);
    }
  }
  seen_[point] = {begin, static_cast<std::uint32_t>(seen_facets_.size())};
}

/// From "point sees facet" to "facet is seen by point": counting sort.
void Neighbours::turn_round() {
  for (const std::uint32_t f : seen_facets_) ++watchers_[f].end;
  std::uint32_t total = 0;
  for (Range& range : watchers_) {
    const std::uint32_t count = range.end;
    range = {total, total};
    total += count;
  }
  watching_points_.resize(total);
  for (std::uint32_t p = shell_.vertices; p < seen_.size(); ++p) {
    for (std::uint32_t k = seen_[p].begin; k < seen_[p].end; ++k) {
      watching_points_[watchers_[seen_facets_[k]].end++] = p;
    }
  }
}

std::span<const std::uint32_t> Neighbours::of(std::uint32_t point) {
  if (found_[point].end == 0) find(point);
  return {pool_.data() + found_[point].begin, found_[point].end - found_[point].begin};
}

void Neighbours::find(std::uint32_t point) {
  centre_ = point;
  facets_.clear();
  if (point < shell_.vertices) {
    facets_around_vertex(point);
  } else {
    facets_around_outside_point(point);
  }
  const auto begin = static_cast<std::uint32_t>(pool_.size());
  for (const std::uint32_t f : facets_) {
    for (const std::uint32_t v : shell_.facets[f].v) add_point(v, point);
    for (std::uint32_t k = watchers_[f].begin; k < watchers_[f].end; ++k) {
      add_point(watching_points_[k], point);
    }
  }
  found_[point] = {begin, static_cast<std::uint32_t>(pool_.size())};
}

void Neighbours::add_point(std::uint32_t point, std::uint32_t centre) {
  if (point == centre || point_mark_[point] == centre) return;
  point_mark_[point] = centre;
  pool_.push_back(point);
}

void Neighbours::facets_around_vertex(std::uint32_t vertex) {
  std::uint32_t f = facet_at_[vertex];
  do {
    facets_.push_back(f);
    const Shell::Facet& facet = shell_.facets[f];
    const auto side = std::find(facet.v.begin(), facet.v.end(), vertex) - facet.v.begin();
    f = facet.adjacent[static_cast<std::size_t>(side)];
  } while (f != facet_at_[vertex]);
}

void Neighbours::facets_around_outside_point(std::uint32_t point) {
  for (std::uint32_t k = seen_[point].begin; k < seen_[point].end; ++k) {
    add_facet(seen_facets_[k]);
    for (const std::uint32_t n : shell_.facets[seen_facets_[k]].adjacent) add_facet(n);
  }
}

void Neighbours::add_facet(std::uint32_t facet) {
  if (facet_mark_[facet] == centre_) return;
  facet_mark_[facet] = centre_;
  facets_.push_back(facet);
}

}  // namespace osteon::hull
