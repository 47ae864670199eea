#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "osteon/tissue/skin_sheet.h"

namespace osteon {

/// "" where the surface is a manifold whose only boundary is the sheet's straight rim; else why
/// not.
inline std::string why_no_manifold(const SkinSheet& sheet, const SplitSheet& split,
                                   const TriMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> ways;
  std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> fans;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
      if (a == b) return "a triangle with two corners in one";
      if (++ways[{a, b}] > 1) return "an edge that two triangles go along";
      fans[a][b] = c;
    }
  const auto on_rim = [&](std::uint32_t v) {
    return v < split.vertex.size() && sheet.is_rim(split.vertex[v]);
  };
  for (const auto& [way, n] : ways)
    if (!ways.count({way.second, way.first}) && !(on_rim(way.first) && on_rim(way.second)))
      return "a boundary inside of the sheet";
  // Of each vertex the triangles are one fan.
  for (const auto& [v, fan] : fans) {
    std::set<std::uint32_t> ends;
    for (const auto& [from, to] : fan) ends.insert(to);
    std::uint32_t at = fan.begin()->first;
    for (const auto& [from, to] : fan)
      if (!ends.count(from)) at = from;  // an open fan begins here
    std::size_t gone = 0;
    for (auto next = fan.find(at); next != fan.end() && gone < fan.size(); ++gone)
      next = fan.find(next->second);
    if (gone != fan.size()) return "a vertex with two fans";
  }
  return mesh.vertices.size() == fans.size() ? "" : "a vertex of no triangle";
}

/// Strokes the blade from point to point in small ways.
inline double stroke(const SkinSheet& sheet, SheetCuts& cuts, const std::vector<SheetPoint>& points,
                     double depth_m) {
  double opened = 0;
  begin_stroke(sheet, cuts, points.front());
  for (std::size_t i = 1; i < points.size(); ++i)
    for (int k = 1; k <= 50; ++k) {
      const SheetPoint p = points[i - 1] + (points[i] - points[i - 1]) * (k / 50.0);
      if (cuts.blade_in)
        opened += go_on(sheet, cuts, p, depth_m);
      else
        begin_stroke(sheet, cuts, p);
    }
  return opened + end_stroke(sheet, cuts, points.back(), depth_m);
}

}  // namespace osteon
