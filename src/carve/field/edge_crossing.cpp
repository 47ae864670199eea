#include "field/edge_crossing.h"

#include <algorithm>

namespace osteon {
namespace {

using Values = std::array<std::int16_t, NodeWindow::kCount>;

constexpr int kNodeRow = NodeWindow::kSpan, kNodeLayer = NodeWindow::kSpan * NodeWindow::kSpan;

/// Central differences of a node, of values that are cut off where they are only bounds.
Vec3 slope(const Values& values, double most, int node) {
  const auto at = [&](int n) {
    return std::clamp(static_cast<double>(values[static_cast<std::size_t>(n)]), -most, most);
  };
  return {at(node + 1) - at(node - 1), at(node + kNodeRow) - at(node - kNodeRow),
          at(node + kNodeLayer) - at(node - kNodeLayer)};
}

/// Share of the way from a node inside, at which a value that rises from `in` to `out` is 0; more
/// than 1: nowhere.
double share(double in, double out) { return out < 0 ? 2 : in / (in - out); }

}  // namespace

EdgeCrossing edge_crossing(const NodeWindow& window, double cell_um, int node, int stride) {
  const bool from_left = window.left(node);
  const int in = from_left ? node : node + stride, out = from_left ? node + stride : node;
  const double most = 3 * cell_um;
  const auto height = [&](int n) { return double(window.height[static_cast<std::size_t>(n)]); };
  const auto depth = [&](int n) {  // of the cut's wall over the node: negative in what is left
    return -std::min(most, double(window.cut[static_cast<std::size_t>(n)]));
  };
  const double bone = share(height(in), height(out)), cut = share(depth(in), depth(out));
  const double way = std::min(bone, cut);
  const bool is_bone = bone <= cut;
  const Values& values = is_bone ? window.height : window.cut;
  Vec3 normal = (1 - way) * slope(values, most, in) + way * slope(values, most, out);
  if (!is_bone) normal = -normal;
  const double length = normal.norm();
  normal = length > 0 ? Vec3(normal / length) : Vec3(Vec3::Zero());
  return {from_left ? way : 1 - way, normal};
}

}  // namespace osteon
