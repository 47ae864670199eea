// Incision by duplicating vertices (vKASS: Simplified vertex duplication, section 4.2).
//
// The stroke goes from vertex to vertex along edges. Of the vertices about the one that it has
// reached, the one in whose direction the blade lies most nearly is drawn onto the straight way to
// the blade, and the edge to it is cut. A vertex that is on a cut already, or on the rim, stays
// where it is; one that would squeeze a triangle below a quarter of its size is drawn a part of
// the way only. So triangles never turn over, the rim stays, and the area of the sheet is exact.
// It ends: with c the edge's way along the stroke and s < c - n the vertex's miss of its place
// there, the new distance to the blade is at most s + (far - c) < far - n, for a fixed n.

#include <algorithm>
#include <cmath>
#include <optional>

#include "osteon/tissue/skin_sheet.h"

namespace osteon {
namespace {

constexpr double kLeastShare = 0.25;  // of an equilateral triangle's area that is left
constexpr double kReached = 0.5;      // edges: so near to the blade the stroke waits
constexpr double kNearer = 0.05;      // edges: what a cut edge brings nearer at least
constexpr double kBegins = 1.5;       // edges: so far a vertex is drawn under a blade at most

double twice_area(const SheetPoint& a, const SheetPoint& b, const SheetPoint& c) {
  const SheetPoint u = b - a, v = c - a;
  return u.x() * v.y() - u.y() * v.x();
}

bool on_cut(const SkinSheet& sheet, const SheetCuts& cuts, std::uint32_t v) {
  const auto edges = sheet.edges_at(v);
  return std::any_of(edges.begin(), edges.end(),
                     [&](std::uint32_t e) { return cuts.depth_m[e] > 0; });
}

bool fits(const SkinSheet& sheet, const SheetCuts& cuts, std::uint32_t v, const SheetPoint& p) {
  const double least = kLeastShare * 0.5 * std::sqrt(3.0) * sheet.edge_m() * sheet.edge_m();
  const auto at = [&](std::uint32_t w) { return w == v ? p : cuts.points[w]; };
  for (const std::uint32_t t : sheet.triangles_at(v)) {
    const Triangle& tri = sheet.triangles()[t];
    if (!(twice_area(at(tri[0]), at(tri[1]), at(tri[2])) > least)) return false;
  }
  return true;
}

// As far as the triangles about the vertex let it go on its way to `p`.
SheetPoint as_far(const SkinSheet& sheet, const SheetCuts& cuts, std::uint32_t v,
                  const SheetPoint& p) {
  const SheetPoint here = cuts.points[v];
  for (const double share : {1.0, 0.75, 0.5, 0.25}) {
    const SheetPoint there = here + share * (p - here);
    if (fits(sheet, cuts, v, there)) return there;
  }
  return here;
}

// Where the vertex comes when it is drawn to `p`, as far as it goes.
SheetPoint drawn(const SkinSheet& sheet, const SheetCuts& cuts, std::uint32_t v,
                 const SheetPoint& p) {
  if (sheet.is_rim(v) || on_cut(sheet, cuts, v)) return cuts.points[v];
  return as_far(sheet, cuts, v, p);
}

struct Next {
  std::uint32_t edge = 0, vertex = 0;
  SheetPoint place = SheetPoint::Zero();
};

// `last`: the blade goes no further, so the stroke ends under it.
std::optional<Next> next_edge(const SkinSheet& sheet, const SheetCuts& cuts, const SheetPoint& p,
                              bool last) {
  const SheetPoint here = cuts.points[cuts.blade_at];
  const double far = (p - here).norm();
  if (!(far > kReached * sheet.edge_m())) return {};
  const SheetPoint way = (p - here) / far;
  std::optional<Next> best;
  double best_cos = 0, best_along = 0;
  for (const std::uint32_t e : sheet.edges_at(cuts.blade_at)) {
    const SheetEdge& edge = sheet.edges()[e];
    const std::uint32_t v = edge.a == cuts.blade_at ? edge.b : edge.a;
    if (sheet.is_rim(v)) continue;
    const SheetPoint to = cuts.points[v] - here;
    const double cosine = to.dot(way) / to.norm();
    if (!(cosine > best_cos)) continue;
    const double along = last ? std::min(to.dot(way), far) : to.dot(way);
    const SheetPoint aim = here + along * way, place = drawn(sheet, cuts, v, aim);
    if (!((place - aim).norm() < along - kNearer * sheet.edge_m())) continue;
    best = Next{e, v, place};
    best_cos = cosine;
    best_along = along;
  }
  // The blade must have passed it, or the vertices ahead would crowd under a slow blade.
  if (best_along > far) return {};
  return best;
}

double cut_on(const SkinSheet& sheet, SheetCuts& cuts, const SheetPoint& p, double depth_m,
              bool last) {
  if (!cuts.blade_in || !(depth_m > 0) || !std::isfinite(depth_m)) return 0;
  cuts.blade_in = sheet.is_on(p);
  if (!cuts.blade_in) return 0;
  double opened_m = 0;
  while (const auto next = next_edge(sheet, cuts, p, last)) {
    const SheetPoint from = cuts.points[cuts.blade_at];
    cuts.points[next->vertex] = next->place;
    double& depth = cuts.depth_m[next->edge];
    const double thick = sheet.material().thickness_m;
    if (depth < thick && depth_m >= thick) opened_m += (next->place - from).norm();
    depth = std::max(depth, depth_m);
    cuts.blade_at = next->vertex;
  }
  return opened_m;
}

// The end of a groove, less than half an edge behind the blade, is drawn under it. Returns by how
// much the groove is longer.
double stretch_end(const SkinSheet& sheet, SheetCuts& cuts, const SheetPoint& p) {
  std::optional<std::uint32_t> last;
  for (const std::uint32_t e : sheet.edges_at(cuts.blade_at)) {
    if (!(cuts.depth_m[e] > 0)) continue;
    if (last) return 0;  // of another groove too
    last = e;
  }
  SheetPoint& here = cuts.points[cuts.blade_at];
  if (!last || !((p - here).norm() <= kReached * sheet.edge_m())) return 0;
  const SheetEdge& edge = sheet.edges()[*last];
  const SheetPoint from = cuts.points[edge.a == cuts.blade_at ? edge.b : edge.a];
  const double before = (here - from).norm();
  here = as_far(sheet, cuts, cuts.blade_at, p);
  return cuts.depth_m[*last] < sheet.material().thickness_m ? 0 : (here - from).norm() - before;
}

}  // namespace

SheetCuts whole_sheet(const SkinSheet& sheet) {
  SheetCuts cuts;
  cuts.points.assign(sheet.points().begin(), sheet.points().end());
  cuts.depth_m.assign(sheet.edges().size(), 0);
  return cuts;
}

void begin_stroke(const SkinSheet& sheet, SheetCuts& cuts, const SheetPoint& p) {
  cuts.blade_in = false;
  if (!sheet.is_on(p)) return;
  double nearest = kBegins * sheet.edge_m();
  for (std::uint32_t v = 0; v < cuts.points.size(); ++v) {
    const double far = (cuts.points[v] - p).norm();
    if (sheet.is_rim(v) || !(far < nearest)) continue;
    nearest = far;
    cuts.blade_at = v;
    cuts.blade_in = true;
  }
  if (cuts.blade_in) cuts.points[cuts.blade_at] = drawn(sheet, cuts, cuts.blade_at, p);
}

double go_on(const SkinSheet& sheet, SheetCuts& cuts, const SheetPoint& p, double depth_m) {
  return cut_on(sheet, cuts, p, depth_m, false);
}

double end_stroke(const SkinSheet& sheet, SheetCuts& cuts, const SheetPoint& p, double depth_m) {
  double opened_m = cut_on(sheet, cuts, p, depth_m, true);
  if (cuts.blade_in) opened_m += stretch_end(sheet, cuts, p);
  cuts.blade_in = false;
  return opened_m;
}

double slit_under(const SkinSheet& sheet, const SheetCuts& cuts, const SheetPoint& p,
                  double radius_m) {
  const auto is_open = [&](std::uint32_t e) {
    return cuts.depth_m[e] > 0 && cuts.depth_m[e] >= sheet.material().thickness_m;
  };
  const auto length = [&](std::uint32_t e) {
    return (cuts.points[sheet.edges()[e].b] - cuts.points[sheet.edges()[e].a]).norm();
  };
  std::vector<std::uint32_t> found;
  double nearest = radius_m;
  for (std::uint32_t e = 0; e < sheet.edges().size(); ++e) {
    if (!is_open(e)) continue;
    const SheetPoint a = cuts.points[sheet.edges()[e].a], way = cuts.points[sheet.edges()[e].b] - a;
    const double share = std::clamp((p - a).dot(way) / way.squaredNorm(), 0.0, 1.0);
    const double far = (p - a - share * way).norm();
    if (!(far < nearest)) continue;
    nearest = far;
    found = {e};
  }
  double sum = 0;
  std::vector<bool> seen(sheet.edges().size(), false);
  if (!found.empty()) seen[found[0]] = true;
  while (!found.empty()) {
    const std::uint32_t e = found.back();
    found.pop_back();
    sum += length(e);
    for (const std::uint32_t v : {sheet.edges()[e].a, sheet.edges()[e].b})
      for (const std::uint32_t next : sheet.edges_at(v)) {
        if (seen[next] || !is_open(next)) continue;
        seen[next] = true;
        found.push_back(next);
      }
  }
  return sum;
}

}  // namespace osteon
