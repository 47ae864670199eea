#include "field_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace osteon {
namespace {

constexpr std::size_t kMostCells = 160;
constexpr std::size_t kMostCellsInHole = 64;  // of a carved bone, see field_contact
constexpr double kCoarse = 5e-6;        // m: how well the search over cells knows the lowest height
constexpr double kSteepestRise = 1.25;  // of a field, see field_contact
constexpr int kPolishSteps = 40;
constexpr double kPolished = 1e-9;  // m: a step so small ends the descent

// Part of the box, in its own frame.
// Not set to nothing at first: so many would take as long as dozens of looks at the field.
struct Cell {
  Vec3 middle, half;
};

// Of a cell: no point of it is lower. It stands for the cell in the heap, which moves it about.
struct CellBound {
  double bound;
  std::size_t cell;
};

class BoxSearch {
 public:
  BoxSearch(const FieldView& field, const Pose& X_AB, const Vec3& half, double far_m)
      : field_(field),
        X_AB_(X_AB),
        half_(half),
        far_(far_m),
        most_(field.is_carved() ? kMostCellsInHole : kMostCells),
        steps_(field.is_carved() ? kPolishSteps / 2 : kPolishSteps) {}

  // Branch and bound (Land and Doig, 1960): a field rises by no more than kSteepestRise a metre, so
  // that the height of a cell's middle bounds the whole cell. The cell of the lowest bound is
  // halved across its longest side until no bound lies below the lowest height by more than
  // kCoarse, or `most_` are looked at: then flat lies on flat, and every place is as low as its
  // neighbour.
  BoxLowest find() {
    add(Vec3::Zero(), half_);
    while (looked_ + 2 <= most_) {
      const CellBound lowest = heap_[0];
      if (!(lowest.bound < best_.field.distance - kCoarse)) break;
      if (lowest.bound > far_) return at_least(lowest.bound);
      std::pop_heap(heap_.begin(), heap_.begin() + count_, is_higher);
      --count_;
      const Cell& cell = cells_[lowest.cell];
      Eigen::Index axis = 0;
      cell.half.maxCoeff(&axis);
      Vec3 half = cell.half;
      half[axis] *= 0.5;
      const Vec3 step = half[axis] * Vec3::Unit(axis);
      add(cell.middle - step, half);
      add(cell.middle + step, half);
    }
    return polished();
  }

 private:
  FieldSample at(const Vec3& p_B) const { return field_.at(X_AB_ * p_B); }

  void add(const Vec3& middle, const Vec3& half) {
    const FieldSample sample = at(middle);
    const std::size_t cell = looked_++;
    if (sample.distance < best_.field.distance) {
      best_ = {middle, sample};
      size_ = half.norm();
    }
    cells_[cell] = {middle, half};
    heap_[static_cast<std::size_t>(count_++)] = {sample.distance - kSteepestRise * half.norm(),
                                                 cell};
    std::push_heap(heap_.begin(), heap_.begin() + count_, is_higher);
  }

  static bool is_higher(const CellBound& a, const CellBound& b) { return a.bound > b.bound; }

  BoxLowest at_least(double distance) const {
    BoxLowest out = best_;
    out.field.distance = distance;
    out.p = X_AB_ * out.p;
    return out;
  }

  // Down the slope within the box, in steps that are halved where they lead up: the lowest points
  // are corners and edges more often than not, and clamping reaches them exactly.
  BoxLowest polished() const {
    BoxLowest out = best_;
    double step = std::max(size_, kPolished);
    for (int i = 0; i < steps_ && step > kPolished; ++i) {
      const Vec3 down_B = -(X_AB_.q.conjugate() * out.field.gradient);
      const Vec3 p = (out.p + step * down_B).cwiseMax(-half_).cwiseMin(half_);
      const FieldSample sample = at(p);
      if (sample.distance < out.field.distance) {
        out = {p, sample};
      } else {
        step *= 0.4;
      }
    }
    out.p = X_AB_ * out.p;
    return out;
  }

  const FieldView& field_;
  const Pose& X_AB_;
  Vec3 half_;
  double far_;
  std::size_t most_;                        // cells
  int steps_;                               // of the descent
  std::array<Cell, kMostCells> cells_;      // in the order in which they were looked at
  std::array<CellBound, kMostCells> heap_;  // the lowest bound first
  std::ptrdiff_t count_ = 0;
  std::size_t looked_ = 0;
  double size_ = 0;  // of the cell of the lowest height
  BoxLowest best_{Vec3::Zero(), {std::numeric_limits<double>::infinity(), Vec3::Zero(), false}};
};

}  // namespace

BoxLowest lowest_of_box(const FieldView& field, const Pose& X_AB, const Vec3& half, double far_m) {
  return BoxSearch(field, X_AB, half, far_m).find();
}

}  // namespace osteon
