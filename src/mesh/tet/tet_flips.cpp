#include "tet/tet_flips.h"

#include <algorithm>
#include <array>
#include <optional>

namespace osteon {
namespace {

constexpr std::size_t kMostCorners = 9;
constexpr double kBetterFlip = 1e-9;

/// The vertices around edge ab, each with the next in one element, in the sense in which (a, b,
/// ring[k], ring[k + 1]) is upright.
struct EdgeRing {
  std::vector<std::uint32_t> corner;
  bool closed = false;
};

/// The two corners of an element that are not a or b, in the sense of EdgeRing.
std::array<std::uint32_t, 2> others(const Tetrahedron& tet, std::uint32_t a, std::uint32_t b) {
  std::size_t at_a = 0, at_b = 0;
  std::array<std::size_t, 2> rest{};
  std::size_t count = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (tet[k] == a) at_a = k;
    if (tet[k] == b) at_b = k;
    if (tet[k] != a && tet[k] != b) rest[count++] = k;
  }
  // Parity of (a, b, rest) as a permutation of the element's corners.
  const std::array<std::size_t, 4> order{at_a, at_b, rest[0], rest[1]};
  int swaps = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) swaps += order[i] > order[j];
  if (swaps % 2 == 1) std::swap(rest[0], rest[1]);
  return {tet[rest[0]], tet[rest[1]]};
}

/// None when the elements around the edge do not make one fan, or too large a one.
std::optional<EdgeRing> ring_of(const TetWork& work, const std::vector<std::uint32_t>& tets,
                                std::uint32_t a, std::uint32_t b) {
  if (tets.empty() || tets.size() > kMostCorners) return std::nullopt;
  std::vector<std::array<std::uint32_t, 2>> steps;
  for (const std::uint32_t t : tets) steps.push_back(others(work.tet(t), a, b));
  // An open fan starts at the corner to which no step leads.
  std::uint32_t start = steps[0][0];
  bool closed = true;
  for (const auto& step : steps) {
    const bool led_to = std::any_of(steps.begin(), steps.end(),
                                    [&](const auto& other) { return other[1] == step[0]; });
    if (!led_to) {
      start = step[0];
      closed = false;
    }
  }
  EdgeRing ring{{start}, closed};
  for (std::size_t n = 0; n < steps.size(); ++n) {
    const auto next = std::find_if(steps.begin(), steps.end(),
                                   [&](const auto& step) { return step[0] == ring.corner.back(); });
    if (next == steps.end()) return std::nullopt;
    ring.corner.push_back((*next)[1]);
  }
  if (closed) {
    if (ring.corner.back() != start) return std::nullopt;
    ring.corner.pop_back();
  }
  std::vector<std::uint32_t> sorted = ring.corner;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return std::nullopt;
  return ring;
}

/// Best triangulation of the polygon around an edge: Klincsek's dynamic programme, whose triangle
/// (i, k, j) stands for the two elements from it to a and to b.
class RingTriangulation {
 public:
  RingTriangulation(const TetWork& work, std::uint32_t a, std::uint32_t b,
                    const std::vector<std::uint32_t>& ring)
      : work_(work), a_(a), b_(b), ring_(ring) {
    const std::size_t n = ring.size();
    for (std::size_t width = 2; width < n; ++width)
      for (std::size_t i = 0; i + width < n; ++i) choose(i, i + width);
  }
  double worth() const { return ring_.size() < 3 ? 2.0 : best_[0][ring_.size() - 1]; }

  void elements(std::size_t i, std::size_t j, std::vector<Tetrahedron>& out) const {
    if (j < i + 2) return;
    const std::size_t k = middle_[i][j];
    out.push_back({ring_[i], ring_[k], ring_[j], b_});
    out.push_back({ring_[j], ring_[k], ring_[i], a_});
    elements(i, k, out);
    elements(k, j, out);
  }

 private:
  void choose(std::size_t i, std::size_t j) {
    best_[i][j] = -2;
    for (std::size_t k = i + 1; k < j; ++k) {
      double worth = std::min(work_.worth_of({ring_[i], ring_[k], ring_[j], b_}),
                              work_.worth_of({ring_[j], ring_[k], ring_[i], a_}));
      if (k > i + 1) worth = std::min(worth, best_[i][k]);
      if (k + 1 < j) worth = std::min(worth, best_[k][j]);
      if (worth <= best_[i][j]) continue;
      best_[i][j] = worth;
      middle_[i][j] = k;
    }
  }

  const TetWork& work_;
  std::uint32_t a_, b_;
  const std::vector<std::uint32_t>& ring_;
  std::array<std::array<double, kMostCorners + 1>, kMostCorners + 1> best_{};
  std::array<std::array<std::size_t, kMostCorners + 1>, kMostCorners + 1> middle_{};
};

/// Whether the boundary may run along r-s in place of a-b: it must not pass there yet, and the
/// middle of the new edge must lie near the surface.
bool boundary_may_flip(const TetWork& work, std::uint32_t a, std::uint32_t b, std::uint32_t r,
                       std::uint32_t s, const DistanceToSurface& distance, double slack_m) {
  const std::vector<std::uint32_t> there = work.around_edge(r, s);
  const bool lone = std::any_of(there.begin(), there.end(), [&](std::uint32_t t) {
    return names(work.tet(t), a) && names(work.tet(t), b);
  });
  if (!there.empty() && !lone) return false;
  if (lone) {
    const auto ring = ring_of(work, there, r, s);
    if (!ring || !ring->closed) return false;
  }
  const double now = distance(0.5 * (work.place(a) + work.place(b)));
  return distance(0.5 * (work.place(r) + work.place(s))) <= now + slack_m;
}

}  // namespace

bool remove_edge(TetWork& work, std::uint32_t a, std::uint32_t b, const DistanceToSurface& distance,
                 double slack_m) {
  const std::vector<std::uint32_t> old = work.around_edge(a, b);
  const auto ring = ring_of(work, old, a, b);
  if (!ring || (ring->closed && ring->corner.size() < 3)) return false;
  double worth = 2;
  for (const std::uint32_t t : old) worth = std::min(worth, work.worth(t));
  const RingTriangulation made(work, a, b, ring->corner);
  if (made.worth() <= worth + kBetterFlip) return false;
  if (!ring->closed &&
      !boundary_may_flip(work, a, b, ring->corner.front(), ring->corner.back(), distance, slack_m))
    return false;
  // A vertex that loses its last element would leave a hole in the boundary.
  if (!ring->closed && (work.around(a).size() <= old.size() || work.around(b).size() <= old.size()))
    return false;
  std::vector<Tetrahedron> elements;
  made.elements(0, ring->corner.size() - 1, elements);
  for (const std::uint32_t t : old) work.remove(t);
  for (const Tetrahedron& tet : elements) work.add(tet);
  return true;
}

bool remove_face(TetWork& work, std::uint32_t t, std::size_t face) {
  const std::uint32_t other = work.across(t, face);
  if (other == TetWork::kNone) return false;
  const Tetrahedron tet = work.tet(t);
  const std::uint32_t apex = tet[face];
  const std::array<std::uint32_t, 3> f{tet[kTetFaces[face][0]], tet[kTetFaces[face][1]],
                                       tet[kTetFaces[face][2]]};
  std::uint32_t far = apex;
  for (const std::uint32_t v : work.tet(other))
    if (v != f[0] && v != f[1] && v != f[2]) far = v;
  if (!work.around_edge(apex, far).empty()) return false;
  const double worth = std::min(work.worth(t), work.worth(other));
  std::array<Tetrahedron, 3> made{};
  for (std::size_t k = 0; k < 3; ++k) {
    made[k] = {apex, far, f[k], f[(k + 1) % 3]};
    if (work.worth_of(made[k]) <= worth + kBetterFlip) return false;
  }
  work.remove(t);
  work.remove(other);
  for (const Tetrahedron& m : made) work.add(m);
  return true;
}

}  // namespace osteon
