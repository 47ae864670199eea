#include "osteon/mesh/soft_selection.h"

#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace osteon {
namespace {

constexpr double kUnreached = std::numeric_limits<double>::infinity();

/// Distance at c from a front that reached a and b, over the triangle's plane: from the point
/// beyond ab that lies as far from both, where the straight way crosses ab between them; else
/// infinite.
double across(const Vec3& a, double at_a, const Vec3& b, double at_b, const Vec3& c) {
  const Vec3 ab = b - a;
  const double edge = ab.norm();
  if (!(edge > 0)) return kUnreached;
  const Vec3 along = ab / edge;
  const double from_x = (at_a * at_a - at_b * at_b + edge * edge) / (2 * edge);
  const double from_y2 = at_a * at_a - from_x * from_x;
  if (!(from_y2 >= 0)) return kUnreached;
  const double from_y = std::sqrt(from_y2);
  const double to_x = along.dot(c - a);
  const double to_y = (c - a - to_x * along).norm();
  if (!(from_y + to_y > 0)) return kUnreached;
  const double crosses = from_x + (to_x - from_x) * from_y / (from_y + to_y);
  if (crosses < 0 || crosses > edge) return kUnreached;
  const double dx = to_x - from_x, dy = to_y + from_y;
  return std::sqrt(dx * dx + dy * dy);
}

}  // namespace

std::string_view to_text(FallOff fall_off) {
  constexpr std::array<std::string_view, 4> kNames = {"smooth", "cone", "dome", "spike"};
  return kNames[static_cast<std::size_t>(fall_off)];
}

std::optional<FallOff> fall_off_from_text(std::string_view text) {
  for (const FallOff f : {FallOff::kSmooth, FallOff::kCone, FallOff::kDome, FallOff::kSpike})
    if (to_text(f) == text) return f;
  return std::nullopt;
}

double fall_off_weight(FallOff fall_off, double x) {
  if (!(x < 1)) return 0;
  if (!(x > 0)) return 1;
  switch (fall_off) {
    case FallOff::kSmooth:
      return 1 - x * x * (3 - 2 * x);
    case FallOff::kCone:
      return 1 - x;
    case FallOff::kDome:
      return std::sqrt(1 - x * x);
    case FallOff::kSpike:
      break;
  }
  return (1 - x) * (1 - x);
}

SurfaceWalk::SurfaceWalk(const TriMesh& mesh) : first_(mesh.vertices.size() + 1, 0) {
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) ++first_[v + 1];
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  triangle_.resize(3 * mesh.triangles.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) triangle_[next[v]++] = t;
}

std::vector<SoftWeight> SurfaceWalk::select(const TriMesh& mesh, std::uint32_t grabbed,
                                            const SoftSelection& selection) const {
  std::vector<double> distance(mesh.vertices.size(), kUnreached);
  std::vector<bool> done(mesh.vertices.size(), false);
  using Front = std::pair<double, std::uint32_t>;
  std::priority_queue<Front, std::vector<Front>, std::greater<>> open;
  const auto reach = [&](std::uint32_t v, double d) {
    if (d >= distance[v] || (d >= selection.radius_m && v != grabbed)) return;
    distance[v] = d;
    open.emplace(d, v);
  };
  std::vector<SoftWeight> out;
  reach(grabbed, 0);
  while (!open.empty()) {
    const auto [d, v] = open.top();
    open.pop();
    if (done[v]) continue;
    done[v] = true;
    const double x = selection.radius_m > 0 ? d / selection.radius_m : 0.0;
    out.push_back({v, d, fall_off_weight(selection.fall_off, x)});
    for (std::uint32_t i = first_[v]; i < first_[v + 1]; ++i) {
      const Triangle& t = mesh.triangles[triangle_[i]];
      const std::size_t k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
      const std::uint32_t a = t[(k + 1) % 3], b = t[(k + 2) % 3];
      const Vec3 &at_v = mesh.vertices[v], &at_a = mesh.vertices[a], &at_b = mesh.vertices[b];
      reach(a, d + (at_a - at_v).norm());
      reach(b, d + (at_b - at_v).norm());
      if (done[a]) reach(b, across(at_v, d, at_a, distance[a], at_b));
      if (done[b]) reach(a, across(at_v, d, at_b, distance[b], at_a));
    }
  }
  return out;
}

}  // namespace osteon
