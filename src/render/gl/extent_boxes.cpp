#include "gl/extent_boxes.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace osteon {
namespace {

constexpr int kAlongLongestSide = 8;

}  // namespace

std::vector<ExtentBox> extent_boxes(const TriMesh& mesh) {
  Aabb all;
  for (const Vec3& p : mesh.vertices)
    if (is_finite(p)) all.include(p);
  if (all.empty()) return {};
  const double cell_m = std::max(all.extent().maxCoeff() / kAlongLongestSide, 1e-9);
  const auto cell = [&](double from_lo_m) {
    return std::min(static_cast<int>(from_lo_m / cell_m), kAlongLongestSide - 1);
  };
  std::map<std::tuple<int, int, int>, Aabb> boxes;
  for (const Vec3& p : mesh.vertices) {
    if (!is_finite(p)) continue;
    const Vec3 at = p - all.lo;
    boxes[{cell(at.x()), cell(at.y()), cell(at.z())}].include(p);
  }
  std::vector<ExtentBox> out;
  for (const auto& [where, box] : boxes) out.push_back({box.center(), 0.5 * box.extent()});
  return out;
}

}  // namespace osteon
