#include "tunnel_cut.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "tunnel_edges.h"
#include "tunnel_rims.h"

namespace osteon::tunnel {
namespace {

constexpr double kClear_m = 0.1e-6;
constexpr int kPlacings = 48;
constexpr double kGolden = 0.6180339887498949;

/// The i-th placing to try: first others turn, then the radius and the ends change as well. The
/// radius by little first: where a side lies along the bone, a micrometre is much of a shallow cut.
Placing placing_at(int i, const Placing& like) {
  if (i == 0) return like;
  Placing p = like;
  const double turn = like.phase + i * kGolden;
  p.phase = turn - std::floor(turn);
  // Ends first move where a face lies in one of them, which no turning helps.
  if (i >= 4) p.end_shift = 0.5e-6 * (1 + i % 4);
  constexpr double kPairs = (kPlacings - 8) / 2 - 1;
  if (i >= 8)
    p.radius_shift = (i % 2 == 0 ? 1 : -1) * 1e-6 * (0.12 + 0.88 * ((i - 8) / 2) / kPairs);
  return p;
}

/// The rims as chains of points, closed but where an end cuts them.
std::vector<std::vector<std::uint32_t>> chains(const Rims& rims) {
  std::vector<Side> sides;
  for (const auto& side : rims.on_sides) sides.insert(sides.end(), side.begin(), side.end());
  std::sort(sides.begin(), sides.end());
  std::vector<Side> back;
  for (const Side& s : sides) back.push_back({s.second, s.first});
  std::sort(back.begin(), back.end());
  std::vector<bool> used(sides.size(), false);
  std::vector<std::vector<std::uint32_t>> out;
  const auto follow = [&](std::size_t at) {
    std::vector<std::uint32_t> chain;
    while (!used[at]) {
      used[at] = true;
      chain.push_back(sides[at].first);
      const std::uint32_t to = sides[at].second;
      const auto next = std::lower_bound(sides.begin(), sides.end(), Side{to, 0});
      if (next == sides.end() || next->first != to) {
        chain.push_back(to);
        break;
      }
      at = static_cast<std::size_t>(next - sides.begin());
    }
    out.push_back(std::move(chain));
  };
  for (std::size_t i = 0; i < sides.size(); ++i) {  // first those that begin at an end
    const auto before = std::lower_bound(back.begin(), back.end(), Side{sides[i].first, 0});
    if (before == back.end() || before->first != sides[i].first) follow(i);
  }
  for (std::size_t i = 0; i < sides.size(); ++i)
    if (!used[i]) follow(i);
  return out;
}

double area(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const Triangle& t : triangles)
    sum += 0.5 * (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).norm();
  return sum;
}

/// One try. None when it is no clearer than `least` or does not fit together.
std::optional<CutPatch> try_cut(Patch patch, const Drill& drill, const Placing& placing,
                                const InBone& in_bone, double least) {
  const Prism prism(drill.radius, drill.start, drill.end, placing);
  double clear = split_at(patch, prism.start);
  clear = std::min(clear, split_at(patch, prism.end));
  if (clear <= least) return std::nullopt;
  sort_into_layers(patch, prism.start, prism.end);
  const EdgeTable edges(patch, prism);
  clear = std::min(clear, edges.clearance());
  if (!edges.sound() || clear <= least) return std::nullopt;
  Rims rims;
  Wall wall;
  if (!cut_facets(patch, prism, edges, rims) || !make_wall(patch, prism, rims, in_bone, wall))
    return std::nullopt;
  CutPatch out;
  out.rims = chains(rims);
  out.bottom_m2 = area(patch.points_A, wall.ends);
  out.triangles = std::move(rims.kept);
  out.triangles.insert(out.triangles.end(), wall.wall.begin(), wall.wall.end());
  out.triangles.insert(out.triangles.end(), wall.ends.begin(), wall.ends.end());
  out.points_A = std::move(patch.points_A);
  out.clearance = clear;
  out.placing = placing;
  out.sides = prism.sides();
  return out;
}

}  // namespace

CutPatch cut_patch(const Patch& patch, const Drill& drill, const Placing& like,
                   const InBone& in_bone) {
  CutPatch best;
  for (int i = 0; i < kPlacings && best.clearance < kClear_m; ++i)
    if (auto cut = try_cut(patch, drill, placing_at(i, like), in_bone, best.clearance))
      best = std::move(*cut);
  return best;
}

}  // namespace osteon::tunnel
