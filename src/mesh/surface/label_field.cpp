#include "surface/label_field.h"

#include <algorithm>

namespace osteon {
namespace {

constexpr int kMargin = 2;
// Grey values this far from the threshold count as far inside or outside.
constexpr double kSpan_hu = 500;

/// -1 inside, 1 outside, between by the grey value where it tells.
double level(const Volume& volume, const LabelVolume& labels, std::uint16_t label, int i, int j,
             int k, double threshold_hu) {
  if (!labels.frame.contains(i, j, k)) return 1;
  const double above = (volume.at(i, j, k) - threshold_hu) / kSpan_hu;
  const bool inside = labels.at(i, j, k) == label;
  // Marrow inside and other bones outside have grey values that do not tell.
  if (inside) return above > 0 ? std::max(-1.0, -above - 0.02) : -1.0;
  return above < 0 ? std::min(1.0, -above + 0.02) : 0.5;
}

}  // namespace

LabelField::LabelField(const Volume& volume, const LabelVolume& labels, std::uint16_t label,
                       const VoxelBox& box, double threshold_hu) {
  field_.frame = labels.frame;
  for (std::size_t a = 0; a < 3; ++a) field_.frame.size[a] = box.hi[a] - box.lo[a] + 2 * kMargin;
  field_.values.reserve(field_.frame.count());
  first_V_ = labels.frame.spacing_m.cwiseProduct(
      Vec3(box.lo[0] - kMargin, box.lo[1] - kMargin, box.lo[2] - kMargin));
  const double reach_m = 0.5 * labels.frame.spacing_m.minCoeff();
  for (int k = box.lo[2] - kMargin; k < box.hi[2] + kMargin; ++k)
    for (int j = box.lo[1] - kMargin; j < box.hi[1] + kMargin; ++j)
      for (int i = box.lo[0] - kMargin; i < box.hi[0] + kMargin; ++i)
        field_.values.push_back(
            static_cast<float>(reach_m * level(volume, labels, label, i, j, k, threshold_hu)));
}

double LabelField::operator()(const Vec3& p_V) const {
  return sample_linear(field_, (p_V - first_V_).cwiseQuotient(field_.frame.spacing_m));
}

Aabb LabelField::box_V() const {
  const auto& n = field_.frame.size;
  const Vec3 last(n[0] - 1, n[1] - 1, n[2] - 1);
  return {first_V_, first_V_ + field_.frame.spacing_m.cwiseProduct(last)};
}

}  // namespace osteon
