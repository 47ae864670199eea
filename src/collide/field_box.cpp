#include "field_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace osteon {
namespace {

constexpr std::size_t kMostCells = 120;
constexpr std::size_t kMostCellsInHole = 64;  // of a carved bone, see field_contact
constexpr double kCoarse = 5e-6;  // m: how well the search over cells knows the lowest height
constexpr int kPolishSteps = 40;
constexpr double kPolished = 1e-8;  // m: a step so small ends the descent
constexpr double kApart = 0.5;      // share of the half diagonal: low places nearer are one

// Part of the box, in its own frame.
// Not set to nothing at first: so many would take as long as dozens of looks at the field.
struct Cell {
  Vec3 middle, half;
  double distance;  // of the middle
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
        R_AB_(X_AB.q.toRotationMatrix()),
        half_(half),
        far_(far_m),
        most_(field.is_carved() ? kMostCellsInHole : kMostCells),
        steps_(field.is_carved() ? kPolishSteps / 2 : kPolishSteps) {}

  // Branch and bound (Land and Doig, 1960): a field rises by no more than FieldView::kSteepest a
  // metre, so that the height of a cell's middle bounds the whole cell. The cell of the lowest
  // bound is halved across its longest side until no bound lies below the lowest height by more
  // than kCoarse, or `most_` are looked at: then flat lies on flat, and every place is as low as
  // its neighbour.
  BoxLowest find() {
    add(Vec3::Zero(), half_);
    while (looked_ + 2 <= most_) {
      const CellBound lowest = heap_[0];
      if (!(lowest.bound < best_.distance - kCoarse)) break;
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
    return polished(size_);
  }

  // The place that was found, and the lowest cells away from it and from each other.
  void note(const BoxLowest& lowest, LowPlaces& places) const {
    const double apart = kApart * half_.norm();
    places.X_AB = X_AB_;
    places.p_B[0] = X_AB_.inverse() * lowest.p;
    places.count = 1;
    while (places.count < places.p_B.size()) {
      const Cell* next = nullptr;
      for (std::size_t i = 0; i < looked_; ++i) {
        if (next && !(cells_[i].distance < next->distance)) continue;
        const auto known = std::span(places.p_B).first(places.count);
        const bool beside = std::any_of(known.begin(), known.end(), [&](const Vec3& p) {
          return (p - cells_[i].middle).norm() < apart;
        });
        if (!beside) next = &cells_[i];
      }
      if (!next) return;
      places.p_B[places.count++] = next->middle;
    }
  }

  // The lowest of places found before, and down from there by about as much as the box has moved.
  BoxLowest look_about(const LowPlaces& places, double moved) {
    for (std::uint32_t i = 0; i < places.count; ++i) {
      const double distance = field_.distance_at(in_A(places.p_B[i]));
      if (distance < best_.distance) best_ = {places.p_B[i], distance};
      if (i > 0 && best_.p == places.p_B[i]) size_ = 0.25 * half_.norm();
    }
    return polished(std::max(size_, 2 * moved));
  }

 private:
  struct Height {
    Vec3 p;
    double distance;
  };

  Vec3 in_A(const Vec3& p) const { return R_AB_ * p + X_AB_.p; }

  void add(const Vec3& middle, const Vec3& half) {
    const double distance = field_.distance_at(in_A(middle));
    const std::size_t cell = looked_++;
    if (distance < best_.distance) {
      best_ = {middle, distance};
      size_ = half.norm();
    }
    cells_[cell] = {middle, half, distance};
    heap_[static_cast<std::size_t>(count_++)] = {distance - FieldView::kSteepest * half.norm(),
                                                 cell};
    std::push_heap(heap_.begin(), heap_.begin() + count_, is_higher);
  }

  static bool is_higher(const CellBound& a, const CellBound& b) { return a.bound > b.bound; }

  // The search asks for distances alone, and for the slope of what it has found.
  BoxLowest found() const {
    BoxLowest out{best_.p, {best_.distance, Vec3::Zero(), false}};
    if (std::isfinite(best_.distance)) out.field = field_.again(in_A(best_.p));
    return out;
  }

  BoxLowest at_least(double distance) const {
    BoxLowest out = found();
    out.field.distance = distance;
    out.p = in_A(out.p);
    return out;
  }

  // Down the slope within the box, in steps that are halved where they lead up: the lowest points
  // are corners and edges more often than not, and clamping reaches them exactly.
  BoxLowest polished(double size) const {
    BoxLowest out = found();
    double step = std::max(size, kPolished);
    for (int i = 0; i < steps_ && step > kPolished; ++i) {
      const Vec3 down_B = -(X_AB_.q.conjugate() * out.field.gradient);
      const Vec3 p = (out.p + step * down_B).cwiseMax(-half_).cwiseMin(half_);
      if (p == out.p) break;  // in a corner, whatever the step
      const Vec3 p_A = in_A(p);
      if (field_.distance_at(p_A) < out.field.distance) {
        out = {p, field_.again(p_A)};
      } else {
        step *= 0.4;
      }
    }
    out.p = in_A(out.p);
    return out;
  }

  const FieldView& field_;
  const Pose& X_AB_;
  Mat3 R_AB_;
  Vec3 half_;
  double far_;
  std::size_t most_;                        // cells
  int steps_;                               // of the descent
  std::array<Cell, kMostCells> cells_;      // in the order in which they were looked at
  std::array<CellBound, kMostCells> heap_;  // the lowest bound first
  std::ptrdiff_t count_ = 0;
  std::size_t looked_ = 0;
  double size_ = 0;  // of the cell of the lowest height
  Height best_{Vec3::Zero(), std::numeric_limits<double>::infinity()};
};

}  // namespace

BoxLowest lowest_of_box(const FieldView& field, const Pose& X_AB, const Vec3& half, double far_m,
                        LowPlaces* places) {
  BoxSearch search(field, X_AB, half, far_m);
  if (!places) return search.find();
  const double turn = 2 * (places->X_AB.q.conjugate() * X_AB.q).vec().norm();
  const double moved = (X_AB.p - places->X_AB.p).norm() + turn * half.norm();
  places->looked_about = places->count > 0 && moved <= LowPlaces::kNearby_m;
  if (places->looked_about) return search.look_about(*places, moved);
  const BoxLowest lowest = search.find();
  places->count = 0;
  if (lowest.field.distance <= far_m) search.note(lowest, *places);
  return lowest;
}

}  // namespace osteon
