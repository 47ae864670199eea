#include "skin/skin_slits.h"

#include <algorithm>

#include "osteon/base/union_find.h"

namespace osteon {

void SkinSlits::find(const SkinSheet& sheet, const SheetCuts& cuts) {
  edges_.clear();
  std::vector<std::uint32_t> open;
  UnionFind joined(sheet.points().size());
  for (std::uint32_t e = 0; e < cuts.depth_m.size(); ++e) {
    if (!(cuts.depth_m[e] > 0 && cuts.depth_m[e] >= sheet.material().thickness_m)) continue;
    open.push_back(e);
    joined.join(sheet.edges()[e].a, sheet.edges()[e].b);
  }
  std::vector<double> length(sheet.points().size(), 0);
  for (const std::uint32_t e : open) {
    const SheetPoint a = cuts.points[sheet.edges()[e].a];
    edges_.push_back({a, cuts.points[sheet.edges()[e].b] - a, cuts.depth_m[e], 0});
    length[joined.find(sheet.edges()[e].a)] += edges_.back().way.norm();
  }
  for (std::size_t i = 0; i < open.size(); ++i)
    edges_[i].length_m = length[joined.find(sheet.edges()[open[i]].a)];
}

SkinSlits::Here SkinSlits::near(const SheetPoint& p, double reach_m) const {
  Here out;
  double nearest = reach_m;
  for (const Edge& edge : edges_) {
    const double share = std::clamp((p - edge.a).dot(edge.way) / edge.way.squaredNorm(), 0.0, 1.0);
    const double far = (p - edge.a - share * edge.way).norm();
    if (!(far < nearest)) continue;
    nearest = far;
    out = {edge.length_m, edge.depth_m};
  }
  return out;
}

}  // namespace osteon
