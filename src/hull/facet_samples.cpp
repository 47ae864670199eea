#include "facet_samples.h"

#include <cmath>

#include "osteon/mesh/longest_edge.h"

namespace osteon::hull {
namespace {

constexpr std::size_t kMostTerms = std::size_t{1} << 22;  // 32 MB

}  // namespace

void FacetSamples::add(const Corners& t, double& moment, Peak& peak) {
  if (terms_.size() > kMostTerms) forget();
  const auto [known, made] = known_.find_or_make(t);
  if (made) {
    known.first = terms_.size();
    halve(t, false, known.peak);
    known.count = terms_.size() - known.first;
  }
  // One by one, as without the memory: sums are rounded.
  for (std::size_t i = 0; i < known.count; ++i) moment += terms_[known.first + i];
  peak.raise(known.peak.need, known.peak.height, known.peak.at);
}

void FacetSamples::forget() {
  known_.clear();
  terms_.clear();
}

/// `near`: no part of the triangle can be deep inside.
void FacetSamples::halve(const Corners& t, bool near, Peak& peak) {
  const auto [longest, length2] = longest_edge(t);
  if (length2 <= spacing2_) return sample(t, peak);
  if (!near) {
    // Heights change by no more than the way: a triangle deep inside has nothing to say. The grid's
    // own heights are good to a part of a cell.
    const double reach = std::sqrt(length2);
    const double height = grid_.at((t[0] + t[1] + t[2]) / 3);
    if (height + reach < -grid_.cell()) return;
    // From the middle it is at most two thirds of the longest edge to any corner, and the grid's
    // heights rise by at most the square root of 3 on the way.
    constexpr double kMostFall = 1.16;
    near = height - kMostFall * reach > -grid_.cell();
  }
  const Vec3& a = t[longest];
  const Vec3& b = t[(longest + 1) % 3];
  const Vec3& c = t[(longest + 2) % 3];
  const Vec3 middle = 0.5 * (a + b);
  halve({a, middle, c}, near, peak);
  halve({middle, b, c}, near, peak);
}

void FacetSamples::sample(const Corners& t, Peak& peak) {
  const Vec3 p = (t[0] + t[1] + t[2]) / 3;
  const double height = grid_.at(p);
  if (height <= 0) return;
  const double need = height * value_.at(p);
  terms_.push_back(need * need * 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm());
  peak.raise(need, height, p);
}

}  // namespace osteon::hull
