#include "scan/scan_slab.h"

#include <algorithm>
#include <cmath>

namespace osteon {

SlabScanner::SlabScanner(const ScanParts& parts, double air_hu, const GridFrame& frame,
                         CellsPerVoxel cells)
    : parts_(parts), air_hu_(air_hu), frame_(frame), cells_(cells), nearest_(parts.surfaces) {
  cell_size_m_ = frame.spacing_m.cwiseQuotient(Vec3(cells.in_slice, cells.in_slice, cells.along));
  cell_width_m_ = std::cbrt(cell_size_m_.prod());
}

Vec3 SlabScanner::cell_center(double i, double j, double k) const {
  const Vec3 corner = frame_.point_P(Vec3(0, 0, slice_)) - 0.5 * frame_.spacing_m;
  return corner + cell_size_m_.cwiseProduct(Vec3(i + 0.5, j + 0.5, k + 0.5));
}

void SlabScanner::add(int i, int j, float hu) {
  sums_[static_cast<std::size_t>(j / cells_.in_slice) * static_cast<std::size_t>(frame_.size[0]) +
        static_cast<std::size_t>(i / cells_.in_slice)] += hu;
}

/// How large a block may be over which the open parts' distances are continued.
double SlabScanner::cell_m(std::size_t first) const {
  double least = 1;
  for (std::size_t n = first; n < open_.size(); ++n)
    least = std::min(least, parts_.parts[open_[n].part].cell_m);
  return least;
}

/// Of the open parts first to last, those whose borders may cross the block are kept, and what lies
/// behind them is found: that of the first part which fills the whole block, else `behind_hu`.
void SlabScanner::fill(const Block& b, std::size_t first, std::size_t last, double behind_hu) {
  const Vec3 center =
      cell_center(0.5 * (b.i0 + b.i1 - 1), 0.5 * (b.j0 + b.j1 - 1), 0.5 * (b.k0 + b.k1 - 1));
  const Vec3 size = cell_size_m_.cwiseProduct(Vec3(b.i1 - b.i0, b.j1 - b.j0, b.k1 - b.k0));
  const double reach = 0.5 * size.norm();
  const std::size_t mine = open_.size();
  std::size_t known = parts_.surfaces.size();
  NearSurface near;
  for (std::size_t n = first; n < last; ++n) {
    const std::size_t at = open_[n].part;
    const ScanPart& part = parts_.parts[at];
    if (nearest_.at_least_m(part.surfaces, center) > reach + part.profile.outside_m()) continue;
    // Parts that share their surfaces follow one another often enough.
    if (known != part.surfaces) near = nearest_.find(part.surfaces, center);
    known = part.surfaces;
    NearSurface seen = near;
    if (part.is_shell && seen.distance < 0) seen = {-seen.distance, -seen.gradient};
    if (!part.profile.flat(seen.distance, reach)) {
      open_.push_back({at, seen});
    } else if (const ScanLayer* layer = part.profile.at(seen.distance)) {
      behind_hu = layer->hu;
      break;
    }
  }
  const bool small = b.single() || size.maxCoeff() < cell_m(mine);
  if (small)
    paint(b, mine, behind_hu);
  else
    halve(b, mine, open_.size(), behind_hu);
  open_.resize(mine);
}

void SlabScanner::halve(const Block& b, std::size_t first, std::size_t last, double behind_hu) {
  Block low = b, high = b;
  const int ni = b.i1 - b.i0, nj = b.j1 - b.j0, nk = b.k1 - b.k0;
  if (ni >= nj && ni >= nk)
    low.i1 = high.i0 = b.i0 + ni / 2;
  else if (nj >= nk)
    low.j1 = high.j0 = b.j0 + nj / 2;
  else
    low.k1 = high.k0 = b.k0 + nk / 2;
  fill(low, first, last, behind_hu);
  fill(high, first, last, behind_hu);
}

void SlabScanner::paint(const Block& b, std::size_t first, double behind_hu) {
  if (first == open_.size()) {
    for (int k = b.k0; k < b.k1; ++k)
      for (int j = b.j0; j < b.j1; ++j)
        for (int i = b.i0; i < b.i1; ++i) add(i, j, static_cast<float>(behind_hu));
    return;
  }
  const Vec3 center =
      cell_center(0.5 * (b.i0 + b.i1 - 1), 0.5 * (b.j0 + b.j1 - 1), 0.5 * (b.k0 + b.k1 - 1));
  for (int k = b.k0; k < b.k1; ++k)
    for (int j = b.j0; j < b.j1; ++j)
      for (int i = b.i0; i < b.i1; ++i)
        add(i, j,
            static_cast<float>(
                cell_mean(cell_center(i, j, k) - center, cell_width_m_, true, first, behind_hu)));
}

/// Mean over the cell at this way from where the open parts' distances are known; one that two
/// borders cross is looked at in parts, where `closer` says so.
double SlabScanner::cell_mean(const Vec3& from_center, double width_m, bool closer,
                              std::size_t first, double behind_hu) const {
  double hu = 0, left = 1;
  for (std::size_t n = first; n < open_.size(); ++n) {
    const ScanProfile& profile = parts_.parts[open_[n].part].profile;
    const double distance = open_[n].near.at(from_center);
    const ScanShare share = profile.mean(distance, width_m);
    if (share.part <= 0) continue;
    if (closer && left < 1 && !profile.flat(distance, 0.5 * width_m))
      return mean_of_parts(from_center, width_m, first, behind_hu);
    hu += left * share.hu;
    left -= left * share.part;
    if (left < 1e-9) return hu;
  }
  return hu + left * behind_hu;
}

double SlabScanner::mean_of_parts(const Vec3& from_center, double width_m, std::size_t first,
                                  double behind_hu) const {
  constexpr int kParts = 4, kAll = kParts * kParts * kParts;
  double sum = 0;
  for (int n = 0; n < kAll; ++n) {
    const Vec3 at(n % kParts, n / kParts % kParts, n / (kParts * kParts));
    const Vec3 aside = (at + Vec3::Constant(0.5)) / kParts - Vec3::Constant(0.5);
    sum += cell_mean(from_center + cell_size_m_.cwiseProduct(aside), width_m / kParts, false, first,
                     behind_hu);
  }
  return sum / kAll;
}

void SlabScanner::scan(int k, std::int16_t* slice) {
  slice_ = k;
  const std::size_t count =
      static_cast<std::size_t>(frame_.size[0]) * static_cast<std::size_t>(frame_.size[1]);
  sums_.assign(count, 0);
  open_.clear();
  for (std::size_t part = 0; part < parts_.parts.size(); ++part) open_.push_back({part, {}});
  fill({0, frame_.size[0] * cells_.in_slice, 0, frame_.size[1] * cells_.in_slice, 0, cells_.along},
       0, open_.size(), air_hu_);
  const auto cells = static_cast<float>(cells_.in_slice * cells_.in_slice * cells_.along);
  for (std::size_t n = 0; n < count; ++n)
    slice[n] = static_cast<std::int16_t>(std::lround(sums_[n] / cells));
}

}  // namespace osteon
