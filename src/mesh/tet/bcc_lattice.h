#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "osteon/mesh/stuffing.h"

namespace osteon {

/// Side of the surface that a lattice point lies on.
enum class LatticeSide : std::int8_t { kInside = -1, kOn = 0, kOutside = 1 };

/// Points of a body-centred cubic lattice around a box: the corners of cubes and their centres, and
/// on which side of a surface each lies. A point is named by one number: corners first.
class BccLattice {
 public:
  static Result<BccLattice> sample(const ScalarField& field, const Aabb& box,
                                   const StuffingOptions& options);

  std::uint32_t point_count() const { return static_cast<std::uint32_t>(sides_.size()); }
  int size(int axis) const { return n_[axis]; }
  std::uint32_t corner(int x, int y, int z) const {
    return (static_cast<std::uint32_t>(z) * static_cast<std::uint32_t>(n_[1]) +
            static_cast<std::uint32_t>(y)) *
               static_cast<std::uint32_t>(n_[0]) +
           static_cast<std::uint32_t>(x);
  }
  std::uint32_t center(int x, int y, int z) const { return half() + corner(x, y, z); }
  Vec3 place(std::uint32_t point) const;
  LatticeSide side(std::uint32_t point) const { return sides_[point]; }
  void put_on_surface(std::uint32_t point) { sides_[point] = LatticeSide::kOn; }
  double cell() const { return cell_; }

  /// The six points a cell away, then the eight at the other ends of short edges. The point must
  /// not lie on the rim.
  std::array<std::uint32_t, 14> neighbours(std::uint32_t point) const;
  static constexpr std::size_t kLongEdges = 6;
  /// True when both are corners or both centres.
  bool same_kind(std::uint32_t a, std::uint32_t b) const { return (a < half()) == (b < half()); }

 private:
  std::uint32_t half() const { return static_cast<std::uint32_t>(sides_.size() / 2); }
  void fill(const ScalarField& field, const StuffingOptions& options, const std::array<int, 3>& lo,
            const std::array<int, 3>& hi);
  void sample_points(const ScalarField& field, const std::array<int, 3>& lo,
                     const std::array<int, 3>& hi);
  bool rim_is_outside() const;
  void set(std::uint32_t point, double value);

  std::array<int, 3> n_{};
  Vec3 origin_ = Vec3::Zero();
  double cell_ = 0;
  bool all_finite_ = true;
  bool any_inside_ = false;
  std::vector<LatticeSide> sides_;
};

}  // namespace osteon
