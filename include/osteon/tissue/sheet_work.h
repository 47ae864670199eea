#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "osteon/tissue/sheet_balance.h"
#include "osteon/tissue/skin_sheet.h"

namespace osteon {

/// What is reckoned with anew in each question, so that none allocates.
struct SheetScratch {
  std::vector<double> load;
  std::vector<std::uint32_t> near;
};

class ProfileMatrix;

/// A force on a copy of a vertex, in the plane of the sheet.
struct SheetPull {
  std::uint32_t copy = 0;
  SheetPoint force_n = SheetPoint::Zero();
};

/// How a cut sheet gives way to slight pushes: as SheetBalance has it, made by SheetWork.
class SheetYield {
 public:
  const SplitSheet& split() const { return split_; }
  /// Way of each copy in the plane: how far the lips stand apart.
  std::span<const SheetPoint> ways() const { return ways_; }
  /// N/m of a slight push, spread evenly on what of the disc is on the sheet; 0: nothing is.
  /// Allocates nothing once `scratch` has been used.
  double stiffness(const SheetDisc& disc, SheetScratch& scratch) const;
  /// The dent's shape: how far each copy goes down for each newton.
  std::vector<double> dent(const SheetDisc& disc) const;
  /// Way of each copy in the plane under those forces, over that by which the lips stand apart;
  /// zero of a sheet without a lip.
  std::vector<SheetPoint> pulled(std::span<const SheetPull> pulls) const;
  /// The way of `copies` under one newton on `copy` along x or y (`axis` 0 or 1). Allocates nothing
  /// once `scratch` has been used.
  void pull_one(std::uint32_t copy, int axis, std::span<const std::uint32_t> copies,
                SheetScratch& scratch, std::span<SheetPoint> out) const;

 private:
  friend class SheetWork;
  bool put_load(const SheetDisc& disc, SheetScratch& scratch) const;

  SplitSheet split_;
  double edge_m_ = 0;
  std::vector<SheetPoint> ways_;
  std::vector<int> at_;                       ///< of each copy: its unknown; -1: held
  std::vector<std::uint32_t> first_, start_;  ///< of each row: its first column, and where it lies
  std::vector<double> rows_, pivots_;
  std::shared_ptr<const ProfileMatrix> plane_;  ///< factored; null: no lip is open
};

/// Finds the balance of a cut sheet in pieces of bounded work: one a call, so that a loop with a
/// period can do it beside other things. A function of the sheet and its cuts, bit by bit.
class SheetWork {
 public:
  /// `sheet` must outlive it.
  SheetWork(const SkinSheet& sheet, const SheetCuts& cuts);
  ~SheetWork();
  /// True: it is done, and `take` gives it.
  bool step();
  std::unique_ptr<const SheetYield> take();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace osteon
