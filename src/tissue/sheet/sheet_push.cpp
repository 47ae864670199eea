// Symbols: k stiffness of a slight push, s the share that the fat bears, H its thickness, m the
// most stiffness. F(d) = k d (1 - s + s / (1 - d / H)) has the slope k (1 - s + s / (1 - d / H)^2):
// the membrane carries in proportion, the fat stiffens as SheetBalance has it. The slope is m at
//   d* = H (1 - sqrt(s / (m / k - 1 + s))),
// and from there F goes straight on.

#include "osteon/tissue/sheet_push.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "osteon/tissue/sheet_balance.h"

namespace osteon {
namespace {

double steepest_at(const SheetPush& push) {
  const double over = push.most_n_per_m / push.stiffness_n_per_m - 1;
  if (!(over > 0)) return 0;
  if (!(push.share > 0)) return push.fat_m;
  return push.fat_m * (1 - std::sqrt(push.share / (over + push.share)));
}

}  // namespace

SheetTouch push_sheet(const SheetPush& push, double deep_m) {
  if (!(push.stiffness_n_per_m > 0)) return {};
  const double k = std::min(push.stiffness_n_per_m, push.most_n_per_m);
  if (!(deep_m > 0)) return {k * deep_m, k};
  const double bend = std::clamp(steepest_at(push), 0.0, 0.999 * push.fat_m);
  const double d = std::min(deep_m, bend), left = 1 - d / push.fat_m;
  SheetTouch out;
  out.force_n = k * d * (1 - push.share + push.share / left);
  out.stiffness_n_per_m = k * (1 - push.share + push.share / (left * left));
  if (deep_m > bend) {
    out.stiffness_n_per_m = push.most_n_per_m;
    out.force_n += push.most_n_per_m * (deep_m - bend);
  }
  return out;
}

// F rises everywhere, by at least k for each metre; halving ends at the last bit.
double pushed_by(const SheetPush& push, double force_n) {
  const double k = std::min(push.stiffness_n_per_m, push.most_n_per_m);
  if (!(force_n > 0) || !(k > 0)) return 0;
  double lo = 0, hi = force_n / k;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (lo + hi);
    (push_sheet(push, middle).force_n < force_n ? lo : hi) = middle;
  }
  return hi;
}

SheetPush over_cover(const SheetPush& push, double cover_m) {
  if (!(cover_m > 0) || cover_m == push.fat_m) return push;
  const double fat = push.share * push.fat_m / cover_m, all = 1 - push.share + fat;
  return {push.stiffness_n_per_m * all, fat / all, cover_m, push.most_n_per_m};
}

FatShare FatShare::of(const SkinSheet& sheet) {
  constexpr std::array kRadii_m{0.0005, 0.001, 0.0015, 0.002, 0.003, 0.004, 0.006, 0.009, 0.012};
  constexpr double kAt = 2.0 / 3;  // of the fat's thickness: where the law is exact
  const SheetBalance balance(sheet, split(sheet, whole_sheet(sheet)));
  const double fat_m = sheet.material().fat_m, deep_m = kAt * fat_m;
  FatShare out;
  for (const double radius_m : kRadii_m) {
    const SheetLoad load = load_on(balance.split(), {SheetPoint::Zero(), radius_m});
    if (load.copy.empty()) break;  // the sheet is smaller
    const double k = balance.stiffness(load);
    const double ratio = balance.pressed_by(load, deep_m).force_n / (k * deep_m);
    out.radii_m_.push_back(radius_m);
    out.fat_n_per_m_.push_back(k * std::clamp((ratio - 1) * (1 - kAt) / kAt, 0.0, 1.0));
  }
  return out;
}

double FatShare::at(double radius_m, double stiffness_n_per_m) const {
  if (radii_m_.empty() || !(stiffness_n_per_m > 0)) return 0;
  double fat = radius_m > radii_m_.front() ? fat_n_per_m_.back() : fat_n_per_m_.front();
  for (std::size_t i = 1; i < radii_m_.size(); ++i)
    if (radius_m > radii_m_[i - 1] && radius_m <= radii_m_[i]) {
      const double along = (radius_m - radii_m_[i - 1]) / (radii_m_[i] - radii_m_[i - 1]);
      fat = fat_n_per_m_[i - 1] + along * (fat_n_per_m_[i] - fat_n_per_m_[i - 1]);
    }
  return std::min(1.0, fat / stiffness_n_per_m);
}

}  // namespace osteon
