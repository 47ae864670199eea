#include "osteon/physics/skin_state.h"

#include <cmath>

namespace osteon {

SkinCuts cuts_to_keep(const SkinSheet& sheet, const SheetCuts& cuts) {
  SkinCuts out;
  for (std::uint32_t v = 0; v < cuts.points.size(); ++v)
    if (cuts.points[v] != sheet.points()[v]) out.moved.push_back({v, cuts.points[v]});
  for (std::uint32_t e = 0; e < cuts.depth_m.size(); ++e)
    if (cuts.depth_m[e] > 0) out.cut.push_back({e, cuts.depth_m[e]});
  out.blade_in = cuts.blade_in;
  out.blade_at = cuts.blade_at;
  return out;
}

bool fits(const SkinSheet& sheet, const SkinCuts& cuts) {
  for (const SkinCuts::Moved& moved : cuts.moved)
    if (moved.vertex >= sheet.points().size() || sheet.is_rim(moved.vertex) ||
        !sheet.is_on(moved.p))
      return false;
  for (const SkinCuts::Cut& cut : cuts.cut)
    if (cut.edge >= sheet.edges().size() || !(cut.depth_m > 0) || !std::isfinite(cut.depth_m))
      return false;
  return cuts.blade_at < sheet.points().size();
}

SheetCuts kept_cuts(const SkinSheet& sheet, const SkinCuts& cuts) {
  SheetCuts out = whole_sheet(sheet);
  for (const SkinCuts::Moved& moved : cuts.moved) out.points[moved.vertex] = moved.p;
  for (const SkinCuts::Cut& cut : cuts.cut) out.depth_m[cut.edge] = cut.depth_m;
  out.blade_in = cuts.blade_in;
  out.blade_at = cuts.blade_at;
  return out;
}

}  // namespace osteon
