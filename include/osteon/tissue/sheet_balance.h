#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "osteon/tissue/skin_sheet.h"

namespace osteon {

/// A push down on the sheet, spread evenly on a disc.
struct SheetDisc {
  SheetPoint p = SheetPoint::Zero();  ///< at rest
  double radius_m = 0.0025;
};

/// What of the disc's force each vertex copy bears: 1 in all. The same weights give the mean way
/// of the disc. Empty where some of the disc is outside of the sheet.
struct SheetLoad {
  std::vector<std::uint32_t> copy;
  std::vector<double> weight;
};
SheetLoad load_on(const SplitSheet& split, const SheetDisc& disc);

/// A dent: how far each copy is pressed down, and the force on the disc.
struct SheetDent {
  std::vector<double> down_m;
  double force_n = 0;
  double mean_m = 0;  ///< mean way of the disc
};

/// The balance of a sheet with its cuts. In the plane it is linear: the tension that cuts have set
/// free draws the lips apart. Across it the tension that is left carries dents, with fat that
/// stiffens. Everything is a function of what is cut alone.
class SheetBalance {
 public:
  /// `sheet` must outlive it.
  SheetBalance(const SkinSheet& sheet, SplitSheet split);
  ~SheetBalance();

  const SplitSheet& split() const { return split_; }
  /// Way of each copy in the plane.
  std::span<const SheetPoint> ways() const { return ways_; }
  /// Tension of each triangle, N/m: xx, yy, xy. No part of it pushes: skin folds instead.
  const std::vector<std::array<double, 3>>& tension() const { return tension_; }

  /// Pressed by `force_n`, from a dent near it. `from` may be a flat sheet's.
  SheetDent pressed(const SheetLoad& load, double force_n, const SheetDent& from = {}) const;
  /// Pressed until the disc's mean way is `mean_m`, less than the fat is thick.
  SheetDent pressed_by(const SheetLoad& load, double mean_m, const SheetDent& from = {}) const;
  /// N/m of a slight push.
  double stiffness(const SheetLoad& load) const;

 private:
  struct Impl;
  SheetDent solve(const SheetLoad& load, std::optional<double> force_n, double mean_m,
                  const SheetDent& from) const;
  const SkinSheet* sheet_;
  SplitSheet split_;
  std::vector<SheetPoint> ways_;
  std::vector<std::array<double, 3>> tension_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace osteon
