#include "sheet/membrane.h"

namespace osteon {

SheetElement element_of(const SplitSheet& split, const Triangle& t) {
  SheetElement out;
  const SheetPoint &a = split.point[t[0]], &b = split.point[t[1]], &c = split.point[t[2]];
  const double twice = (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
  const auto slope = [twice](const SheetPoint& from, const SheetPoint& to) {
    const SheetPoint way = to - from;
    return SheetPoint(-way.y() / twice, way.x() / twice);
  };
  out.slope = {slope(b, c), slope(c, a), slope(a, b)};
  out.area = 0.5 * twice;
  return out;
}

std::array<double, 3> pulling_part(const std::array<double, 3>& n) {
  const double mean = 0.5 * (n[0] + n[1]), half = 0.5 * (n[0] - n[1]);
  const double radius = std::sqrt(half * half + n[2] * n[2]);
  if (mean >= radius) return n;
  if (mean <= -radius) return {0, 0, 0};
  const double pull = 0.5 * (mean + radius);  // along one direction alone
  return {pull * (1 + half / radius), pull * (1 - half / radius), pull * n[2] / radius};
}

}  // namespace osteon
