#include "excess.h"

#include <utility>

namespace osteon::hull {
namespace {

template <class Visit>
void for_each_facet(const Hull& hull, const Visit& visit) {
  for (const Triangle& t : hull.triangles)
    visit({hull.vertices[t[0]], hull.vertices[t[1]], hull.vertices[t[2]]});
}

}  // namespace

ExcessMeter::ExcessMeter(HeightGrid& grid, PlaceValue value, double spacing_m)
    : grid_(grid),
      value_(std::move(value)),
      fine_(grid, value_, spacing_m),
      sparse_(grid, value_, 2 * spacing_m) {}

void ExcessMeter::count_all_alike() {
  value_.on_shaft = 1;
  fine_.forget();
  sparse_.forget();
}

Excess ExcessMeter::sampled(const Hull& hull) {
  Excess out;
  for_each_facet(hull, [&](const Corners& t) { fine_.add(t, out.moment, out.peak); });
  return out;
}

std::optional<double> ExcessMeter::moment_below(const Hull& hull, double base, double limit) {
  Excess sum;
  for (const Triangle& t : hull.triangles) {
    sparse_.add({hull.vertices[t[0]], hull.vertices[t[1]], hull.vertices[t[2]]}, sum.moment,
                sum.peak);
    if (base + sum.moment >= limit) return std::nullopt;
  }
  return sum.moment;
}

Excess ExcessMeter::exact(const Hull& hull, const Excess& sampled, double floor, double enough) {
  Excess out = sampled;
  Peak& peak = out.peak;
  peak.height = grid_.exact().closest(peak.at).signed_distance;
  peak.need = peak.need > 0 ? peak.height * value_.at(peak.at) : 0;
  PeakSearch search(grid_, value_, heights_, floor, enough, peak);
  for_each_facet(hull, [&](const Corners& t) { search.search(t); });
  return out;
}

}  // namespace osteon::hull
