#include <algorithm>

#include "osteon/base/union_find.h"
#include "osteon/tissue/skin_sheet.h"

namespace osteon {
namespace {

std::uint32_t corner_of(const SkinSheet& sheet, std::uint32_t triangle, std::uint32_t vertex) {
  const Triangle& t = sheet.triangles()[triangle];
  return 3 * triangle + (t[0] == vertex ? 0U : t[1] == vertex ? 1U : 2U);
}

void add_walls(const SkinSheet& sheet, const SheetEdge& edge, SplitSheet& out) {
  const auto copy = [&](std::size_t side, std::uint32_t vertex) {
    return out.triangles[edge.triangle[side]][corner_of(sheet, edge.triangle[side], vertex) % 3];
  };
  if (copy(0, edge.a) == copy(1, edge.a) && copy(0, edge.b) == copy(1, edge.b)) return;
  for (std::size_t side = 0; side < 2; ++side) {
    const std::uint32_t corner = corner_of(sheet, edge.triangle[side], edge.a);
    const bool forward = sheet.triangles()[edge.triangle[side]][(corner + 1) % 3] == edge.b;
    const SheetWall wall{copy(side, edge.a), copy(side, edge.b), edge.a, edge.b};
    out.walls.push_back(forward ? wall
                                : SheetWall{wall.to, wall.from, wall.to_base, wall.from_base});
  }
}

double cross(const SheetPoint& u, const SheetPoint& v) { return u.x() * v.y() - u.y() * v.x(); }

}  // namespace

SplitSheet split(const SkinSheet& sheet, const SheetCuts& cuts) {
  SplitSheet out;
  // Corners of triangles, joined where they stay one vertex.
  UnionFind corners(3 * sheet.triangles().size());
  const auto is_open = [&](std::size_t e) {
    return cuts.depth_m[e] > 0 && cuts.depth_m[e] >= sheet.material().thickness_m;
  };
  for (std::size_t e = 0; e < sheet.edges().size(); ++e) {
    const SheetEdge& edge = sheet.edges()[e];
    if (edge.triangles < 2 || is_open(e)) continue;
    for (const std::uint32_t v : {edge.a, edge.b})
      corners.join(corner_of(sheet, edge.triangle[0], v), corner_of(sheet, edge.triangle[1], v));
  }
  out.copies.assign(sheet.points().size(), 0);
  out.groove_m.assign(sheet.points().size(), 0);
  std::vector<std::uint32_t> copy(3 * sheet.triangles().size());
  for (std::uint32_t c = 0; c < copy.size(); ++c) {
    const std::uint32_t first = corners.find(c), vertex = sheet.triangles()[c / 3][c % 3];
    if (first == c) {
      copy[c] = static_cast<std::uint32_t>(out.vertex.size());
      out.vertex.push_back(vertex);
      out.point.push_back(cuts.points[vertex]);
      ++out.copies[vertex];
    } else {
      copy[c] = copy[first];
    }
  }
  for (std::uint32_t t = 0; t < sheet.triangles().size(); ++t)
    out.triangles.push_back({copy[3 * t], copy[3 * t + 1], copy[3 * t + 2]});
  for (std::size_t e = 0; e < sheet.edges().size(); ++e) {
    const SheetEdge& edge = sheet.edges()[e];
    if (edge.triangles < 2 || !is_open(e)) continue;
    add_walls(sheet, edge, out);
    for (const std::uint32_t v : {edge.a, edge.b})
      if (out.copies[v] > 1) out.groove_m[v] = std::max(out.groove_m[v], cuts.depth_m[e]);
  }
  return out;
}

// The bottom of a groove is in the middle of its lips, so deep as it was cut. At the groove's end,
// where the vertex is one, bottom and lips meet in it.
TriMesh sheet_surface(const SplitSheet& split, std::span<const SheetPoint> ways,
                      std::span<const double> down) {
  TriMesh out;
  out.triangles = split.triangles;
  for (std::size_t i = 0; i < split.point.size(); ++i) {
    const SheetPoint p = ways.empty() ? split.point[i] : SheetPoint(split.point[i] + ways[i]);
    out.vertices.emplace_back(p.x(), p.y(), down.empty() ? 0.0 : -down[i]);
  }
  std::vector<Vec3> bottom(split.copies.size(), Vec3::Zero());
  std::vector<std::uint32_t> at(split.copies.size());
  for (std::uint32_t i = 0; i < split.vertex.size(); ++i) {
    bottom[split.vertex[i]] += out.vertices[i] / split.copies[split.vertex[i]];
    at[split.vertex[i]] = i;
  }
  for (std::size_t v = 0; v < bottom.size(); ++v) {
    if (split.copies[v] < 2) continue;
    at[v] = static_cast<std::uint32_t>(out.vertices.size());
    out.vertices.push_back(bottom[v] - split.groove_m[v] * Vec3::UnitZ());
  }
  for (const SheetWall& wall : split.walls) {
    const std::uint32_t from = at[wall.from_base], to = at[wall.to_base];
    if (from != wall.from) out.triangles.push_back({wall.to, wall.from, from});
    if (to != wall.to) out.triangles.push_back({wall.to, from, to});
  }
  return out;
}

double groove_volume(const SplitSheet& split, const TriMesh& surface) {
  double sum = 0;
  for (std::size_t t = split.triangles.size(); t < surface.triangles.size(); ++t) {
    const Vec3 &a = surface.vertices[surface.triangles[t][0]],
               &b = surface.vertices[surface.triangles[t][1]],
               &c = surface.vertices[surface.triangles[t][2]];
    sum -= 0.5 * (b - a).cross(c - a).z() * (a.z() + b.z() + c.z()) / 3;
  }
  return sum;
}

double widest(const SplitSheet& split, std::span<const SheetPoint> ways) {
  double most = 0;
  std::vector<std::vector<std::uint32_t>> of(split.copies.size());
  for (std::uint32_t i = 0; i < split.vertex.size(); ++i) {
    for (const std::uint32_t j : of[split.vertex[i]])
      most = std::max(most, (ways[i] - ways[j]).norm());
    of[split.vertex[i]].push_back(i);
  }
  return most;
}

double sheet_area(const SplitSheet& split) { return -open_area(split, {}); }

// By Green's theorem the area within the rim is a sum over its edges; here the rim at rest counts
// for nothing, for it does not move: what lips enclose is what the triangles have lost.
double open_area(const SplitSheet& split, std::span<const SheetPoint> ways) {
  double rest = 0, now = 0;
  for (const Triangle& t : split.triangles) {
    const auto at = [&](std::uint32_t i) {
      return ways.empty() ? split.point[i] : SheetPoint(split.point[i] + ways[i]);
    };
    rest +=
        0.5 * cross(split.point[t[1]] - split.point[t[0]], split.point[t[2]] - split.point[t[0]]);
    now += 0.5 * cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
  }
  return ways.empty() ? -rest : rest - now;
}

}  // namespace osteon
