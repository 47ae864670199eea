#include "scan_slab.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

constexpr double kQueryCell_m = 0.00055;
constexpr double kSkinCell_m = 0.0025;

double distance_to_box(const Vec3& p, const Aabb& box) {
  return (p - p.cwiseMax(box.lo).cwiseMin(box.hi)).norm();
}

}  // namespace

double ScanProfile::at(double distance_m) const {
  if (distance_m < -cortical_m) return cancellous_hu;
  if (distance_m < 0) return cortical_hu;
  return distance_m < flesh_m ? flesh_hu : air_hu;
}

double ScanProfile::mean(double distance_m, double width_m) const {
  const double lo = distance_m - 0.5 * width_m, hi = distance_m + 0.5 * width_m;
  const auto overlap = [&](double a, double b) {
    return std::max(0.0, std::min(hi, b) - std::max(lo, a));
  };
  const double far = 1e3;
  return (cancellous_hu * overlap(-far, -cortical_m) + cortical_hu * overlap(-cortical_m, 0) +
          flesh_hu * overlap(0, flesh_m) + air_hu * overlap(flesh_m, far)) /
         width_m;
}

bool ScanProfile::flat(double distance_m, double reach_m) const {
  return at(distance_m - reach_m) == at(distance_m + reach_m) &&
         (distance_m + reach_m < -cortical_m || distance_m - reach_m > -cortical_m) &&
         (distance_m + reach_m < 0 || distance_m - reach_m > 0);
}

SlabScanner::SlabScanner(const std::vector<ScanTarget>& targets, const ScanProfile& profile,
                         const GridFrame& frame, CellsPerVoxel cells)
    : targets_(targets), profile_(profile), frame_(frame), cells_(cells) {
  cell_m_ = frame.spacing_m.cwiseQuotient(Vec3(cells.in_slice, cells.in_slice, cells.along));
}

SlabScanner::Near SlabScanner::nearest(const Vec3& p_P) {
  // The bone that was nearest to the last point most likely is again, and rules out the others.
  const ScanTarget* of = &targets_[last_];
  ClosestPoint best = of->distance.closest(p_P);
  for (const ScanTarget& target : targets_) {
    if (&target == &targets_[last_] || distance_to_box(p_P, target.box) >= best.signed_distance)
      continue;
    const ClosestPoint closest = target.distance.closest(p_P);
    if (closest.signed_distance >= best.signed_distance) continue;
    best = closest;
    of = &target;
  }
  last_ = static_cast<std::size_t>(of - targets_.data());
  if (std::abs(best.signed_distance) > 1e-6)
    return {best.signed_distance, (p_P - best.point) / best.signed_distance};
  const TriMesh& mesh = of->distance.mesh();
  const Triangle& t = mesh.triangles[best.triangle];
  const Vec3 across =
      (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
  return {best.signed_distance, across.normalized()};
}

Vec3 SlabScanner::cell_center(double i, double j, double k) const {
  const Vec3 corner = frame_.point_P(Vec3(0, 0, slice_)) - 0.5 * frame_.spacing_m;
  return corner + cell_m_.cwiseProduct(Vec3(i + 0.5, j + 0.5, k + 0.5));
}

void SlabScanner::add(int i, int j, float hu) {
  sums_[static_cast<std::size_t>(j / cells_.in_slice) * static_cast<std::size_t>(frame_.size[0]) +
        static_cast<std::size_t>(i / cells_.in_slice)] += hu;
}

/// Cells i0 <= i < i1 and so on of the slice.
void SlabScanner::fill(int i0, int i1, int j0, int j1, int k0, int k1) {
  const Vec3 center = cell_center(0.5 * (i0 + i1 - 1), 0.5 * (j0 + j1 - 1), 0.5 * (k0 + k1 - 1));
  const Vec3 size = cell_m_.cwiseProduct(Vec3(i1 - i0, j1 - j0, k1 - k0));
  const Near near = nearest(center);
  const bool small = size.maxCoeff() < kQueryCell_m || (i1 - i0) * (j1 - j0) * (k1 - k0) == 1;
  // The skin's place does not matter to bone, so it may be coarse.
  const bool near_skin_only =
      size.maxCoeff() < kSkinCell_m && near.distance > 0.6 * profile_.flesh_m;
  if (small || near_skin_only || profile_.flat(near.distance, 0.5 * size.norm())) {
    const double width = std::cbrt(cell_m_.prod());
    for (int k = k0; k < k1; ++k)
      for (int j = j0; j < j1; ++j)
        for (int i = i0; i < i1; ++i) {
          const double d = near.distance + near.gradient.dot(cell_center(i, j, k) - center);
          add(i, j, static_cast<float>(profile_.mean(d, width)));
        }
    return;
  }
  const int ni = i1 - i0, nj = j1 - j0, nk = k1 - k0;
  if (ni >= nj && ni >= nk) {
    fill(i0, i0 + ni / 2, j0, j1, k0, k1);
    fill(i0 + ni / 2, i1, j0, j1, k0, k1);
  } else if (nj >= nk) {
    fill(i0, i1, j0, j0 + nj / 2, k0, k1);
    fill(i0, i1, j0 + nj / 2, j1, k0, k1);
  } else {
    fill(i0, i1, j0, j1, k0, k0 + nk / 2);
    fill(i0, i1, j0, j1, k0 + nk / 2, k1);
  }
}

void SlabScanner::scan(int k, std::int16_t* slice) {
  slice_ = k;
  const std::size_t count =
      static_cast<std::size_t>(frame_.size[0]) * static_cast<std::size_t>(frame_.size[1]);
  sums_.assign(count, 0);
  fill(0, frame_.size[0] * cells_.in_slice, 0, frame_.size[1] * cells_.in_slice, 0, cells_.along);
  const auto cells = static_cast<float>(cells_.in_slice * cells_.in_slice * cells_.along);
  for (std::size_t n = 0; n < count; ++n)
    slice[n] = static_cast<std::int16_t>(std::lround(sums_[n] / cells));
}

}  // namespace osteon
