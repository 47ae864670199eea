#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "osteon/base/types.h"

namespace osteon {

/// Where the tool's origin may be: n.x >= c, |n| = 1.
struct FreeHalfSpace {
  Vec3 n = Vec3::UnitZ();
  double c = 0;
};

/// How far outside a half-space a result may lie, m.
inline constexpr double kPlaneTolerance = 1e-9;

struct NearestPoint {
  bool found = false;  ///< false: the half-spaces have no common point, or precision ran out
  Vec3 x = Vec3::Zero();
  std::uint32_t active_count = 0;
  /// Half-spaces that hold x, with x - wanted = sum of weight_i n_i, weight_i > 0, m.
  std::array<std::uint32_t, 3> active{};
  std::array<double, 3> weight{};
};

/// The point of all half-spaces that is nearest to `wanted`: a quadratic programme in three
/// unknowns, solved by the dual active-set method (Goldfarb and Idnani, Math. Programming 27, 1983;
/// here with every basis of at most three planes tried outright). Allocates nothing. The result is
/// checked: it lies in every half-space within kPlaneTolerance.
NearestPoint nearest_point(std::span<const FreeHalfSpace> planes, const Vec3& wanted);

/// The same, plane by plane, for a caller that works planes out only where they matter: it lets the
/// plane that `at` violates most enter until it violates none.
class NearestSearch {
 public:
  static constexpr int kMaxSteps = 64;

  /// `planes` must stay where it is; only planes that have entered are read.
  NearestSearch(std::span<const FreeHalfSpace> planes, const Vec3& wanted);
  const Vec3& at() const { return at_.x; }  ///< the result so far
  /// False: what has entered and this have no common point, or precision ran out.
  bool enter(std::uint32_t plane);
  NearestPoint result() const;

 private:
  struct Basis {
    std::uint32_t count = 0;
    std::array<std::uint32_t, 3> plane{};
  };
  struct Projection {
    bool sound = false;
    Vec3 x = Vec3::Zero();
    std::array<double, 3> weight{};
  };
  Projection project(const Basis& basis) const;
  bool holds(const Basis& set, const Vec3& x) const;
  static Basis subset(const Basis& from, unsigned mask, std::uint32_t extra);

  std::span<const FreeHalfSpace> planes_;
  Vec3 wanted_;
  Basis basis_;
  Projection at_;
};

}  // namespace osteon
