#pragma once

#include <vector>

#include "osteon/tissue/skin_sheet.h"

namespace osteon {

/// A round tip pressed into a sheet: how its force goes on from a slight push.
struct SheetPush {
  double stiffness_n_per_m = 400;  ///< of a slight push, as SheetYield has it
  double share = 0.2;              ///< of it, what the fat below bears, which stiffens
  double fat_m = 0.012;
  double most_n_per_m = 2000;  ///< the hand is to meet nothing stiffer: from there on it is this
};
struct SheetTouch {
  double force_n = 0, stiffness_n_per_m = 0;
};
/// F = k d (1 - s + s / (1 - d / H)), and straight on from where its slope is the most. Below 0 the
/// line of a slight push.
SheetTouch push_sheet(const SheetPush& push, double deep_m);
/// How deep it is pressed by a force, at least 0.
double pushed_by(const SheetPush& push, double force_n);

/// The same where the fat is `cover_m` thick instead: what it bears of a slight push goes as one
/// over its thickness, what the membrane bears stays.
SheetPush over_cover(const SheetPush& push, double cover_m);

/// The share of the fat for tips of any radius: measured once for a sheet, in its middle, by
/// SheetBalance, and between its radii a straight line.
class FatShare {
 public:
  static FatShare of(const SkinSheet& sheet);
  /// Of a slight push's stiffness `stiffness_n_per_m`: beside a cut the membrane bears less, and
  /// the fat the same.
  double at(double radius_m, double stiffness_n_per_m) const;

 private:
  std::vector<double> radii_m_, fat_n_per_m_;
};

}  // namespace osteon
