// Symbols: x, along the straight way from a (0) to b (L); c, the cut; g, the gap. The near stump's
// points go from x to x (c - g/2) / c, the far one's alike from the other end. The triangles
// that cross c make a ring around each strand of the band; of a ring, the near points all become
// one, the middle of the near end, and the far points the middle of the far end, so that a crossing
// triangle has two equal corners and no area. The neighbours of the ring's points come to the
// plane of their end: what is left between them and the middle is the end's flat face. Which
// triangles there are stays as it is, so that a closed surface stays closed. One pass over
// points and two over triangles: it ends.
#include "soft/band_stumps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace osteon {
namespace {

constexpr double kLeastStumpGap_m = 0.0015;
constexpr double kLeastStump = 0.1;   // share of the whole length; the gap is no wider
constexpr double kLongestEdge = 0.5;  // of a stump
constexpr double kShortestBand_m = 1e-6;

struct StumpCut {
  double length, at, gap;
  Vec3 a_W, along;

  double x(const Vec3& p_W) const { return (p_W - a_W).dot(along); }
  bool is_far(const Vec3& p_W) const { return x(p_W) > at; }
  double end(bool far) const { return far ? at + 0.5 * gap : at - 0.5 * gap; }
  double longest(bool far) const { return kLongestEdge * (far ? length - at : at); }
  Vec3 drawn_back(const Vec3& p_W) const {
    const double from = x(p_W);
    if (from <= 0 || from >= length) return p_W;
    const double to = from > at ? length - (length - from) * (length - end(true)) / (length - at)
                                : from * end(false) / at;
    return p_W + (to - from) * along;
  }
  Vec3 on_end(const Vec3& p_W, bool far) const { return p_W + (end(far) - x(p_W)) * along; }
};

/// Which strand a point of a crossing triangle belongs to.
class StrandSets {
 public:
  explicit StrandSets(std::size_t points) : parent_(points), crosses_(points, 0) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  void join(const Triangle& t) {
    for (const std::uint32_t v : t) {
      crosses_[v] = 1;
      parent_[of(v)] = of(t[0]);
    }
  }
  bool crosses(std::uint32_t v) const { return crosses_[v] != 0; }
  std::uint32_t of(std::uint32_t v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<char> crosses_;
};

/// The points of a strand's ring, near and far.
struct StrandRing {
  std::array<Vec3, 2> sum{Vec3::Zero(), Vec3::Zero()};
  std::array<double, 2> count{};
  bool whole = false;  ///< too coarse to be cut
};

std::vector<StrandRing> rings_of(const TriMesh& mesh, const StumpCut& cut, StrandSets& strands) {
  std::vector<StrandRing> rings(mesh.vertices.size());
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!strands.crosses(v)) continue;
    const Vec3& p = mesh.vertices[v];
    const bool far = cut.is_far(p);
    StrandRing& ring = rings[strands.of(v)];
    ring.sum[far] += p;
    ring.count[far] += 1;
    ring.whole = ring.whole || std::abs(cut.x(p) - cut.at) > cut.longest(far);
  }
  return rings;
}

// To the plane of their end: those that share a triangle with a point of a ring.
void flatten_ends(const TriMesh& mesh, const StumpCut& cut, StrandSets& strands,
                  const std::vector<StrandRing>& rings, std::vector<Vec3>& out) {
  for (const Triangle& t : mesh.triangles) {
    const auto of_ring = [&](std::uint32_t v) {
      return strands.crosses(v) && !rings[strands.of(v)].whole;
    };
    if (std::none_of(t.begin(), t.end(), of_ring)) continue;
    for (const std::uint32_t v : t) {
      const Vec3& p = mesh.vertices[v];
      const bool far = cut.is_far(p);
      if (!strands.crosses(v) && std::abs(cut.x(p) - cut.at) < 2 * cut.longest(far))
        out[v] = cut.on_end(p, far);
    }
  }
}

}  // namespace

double stump_gap_m(const SoftBand& band, const BandSpan& rest_W) {
  const double length = (rest_W.b_W - rest_W.a_W).norm();
  double slackest = length + band.over_m;
  for (const BandFibres& fibres : band.fibres) slackest = std::min(slackest, fibres.slack_m);
  const double taut = length + band.over_m - slackest;
  return std::max(kLeastStumpGap_m, taut);
}

std::vector<Vec3> stump_points(const TriMesh& rest_W, const BandSpan& span_W, double share,
                               double gap_m) {
  std::vector<Vec3> out = rest_W.vertices;
  const Vec3 way = span_W.b_W - span_W.a_W;
  StumpCut cut{way.norm(), 0, gap_m, span_W.a_W, {}};
  if (!(cut.length > kShortestBand_m) || !std::isfinite(share) || !(gap_m >= 0)) return out;
  cut.along = way / cut.length;
  cut.at = cut.length * std::clamp(share, kLeastStump, 1 - kLeastStump);
  cut.gap = std::min(gap_m, kLeastStump * cut.length);
  StrandSets strands(out.size());
  for (const Triangle& t : rest_W.triangles) {
    const auto far = [&](std::uint32_t v) { return cut.is_far(rest_W.vertices[v]); };
    if (far(t[0]) != far(t[1]) || far(t[0]) != far(t[2])) strands.join(t);
  }
  const std::vector<StrandRing> rings = rings_of(rest_W, cut, strands);
  for (std::uint32_t v = 0; v < out.size(); ++v) {
    const bool far = cut.is_far(out[v]);
    const StrandRing& ring = rings[strands.of(v)];
    if (!strands.crosses(v))
      out[v] = cut.drawn_back(out[v]);
    else if (!ring.whole)
      out[v] = cut.on_end(ring.sum[far] / ring.count[far], far);
  }
  flatten_ends(rest_W, cut, strands, rings, out);
  return out;
}

}  // namespace osteon
