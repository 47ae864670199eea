#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"

namespace osteon {

/// Bone dies where it was so hot for so long.
struct NecrosisRule {
  double above_c = 47;
  double for_s = 60;
};

/// How bone conducts heat, and when it dies of it; degrees are Celsius.
struct HeatMaterial {
  double conductivity_w_per_m_k = 0.5;
  double density_kg_per_m3 = 1900;
  double heat_capacity_j_per_kg_k = 1300;
  double body_c = 37;
  std::array<NecrosisRule, 2> necrosis = {NecrosisRule{47, 60}, {50, 30}};
  double diffusivity_m2_per_s() const {
    return conductivity_w_per_m_k / (density_kg_per_m3 * heat_capacity_j_per_kg_k);
  }
};

/// Water on the bone: it draws heat from the cells that it reaches.
struct Irrigation {
  double water_c = 20;
  double transfer_w_per_m2_k = 2000;
};

/// A grid of temperatures about a cut, by explicit finite differences of the heat equation. The box
/// is as warm as the body at its rim.
class HeatGrid {
 public:
  static constexpr std::size_t kMostCells = 4'000'000;

  /// Fails on a box or cell that is unusable and where there would be more cells than kMostCells.
  static Result<HeatGrid> make(const Aabb& box, double cell_m, const HeatMaterial& material = {});

  /// Adds heat at a point, shared by the cells of bone of the eight about it; none outside the
  /// grid.
  void add_heat(const Vec3& p, double joules);
  /// Conducts for `dt_s`, in as many steps as stability asks for.
  void step(double dt_s);
  /// What lies within `radius_m` of the segment is gone: it conducts no heat, and is open to water.
  void open(const Vec3& from, const Vec3& to, double radius_m);
  /// The faces of bone towards what is open are cooled.
  void irrigate(const Irrigation& water, double dt_s);

  double temperature_at(const Vec3& p) const;  ///< C, trilinear; body's outside
  double hottest_c() const;                    ///< of bone now
  /// Volume of bone that a rule calls dead, m^3; 0 and 1 as the material counts them.
  double necrosis_m3(std::size_t rule) const;
  double energy_j() const;  ///< above the body's
  std::size_t cells() const { return above_body_.size(); }
  double time_s() const { return time_s_; }

 private:
  HeatGrid() = default;
  std::size_t index(std::size_t i, std::size_t j, std::size_t k) const {
    return (k * size_[1] + j) * size_[0] + i;
  }
  void conduct(double dt_s);
  void note_heat(double dt_s);

  HeatMaterial material_;
  Vec3 origin_ = Vec3::Zero();  ///< of the first cell's middle
  double cell_m_ = 0;
  std::array<std::size_t, 3> size_{};
  std::vector<double> above_body_;  ///< K, of each cell
  std::vector<double> next_;
  std::vector<std::uint8_t> gone_;
  std::array<std::vector<double>, 2> hot_s_;  ///< how long each cell was above each rule's limit
  double time_s_ = 0;
};

/// Rise of temperature that heat let out at one point and moment leaves after `t_s` at a distance,
/// K: Q / (rho c (4 pi a t)^(3/2)) exp(-r^2 / (4 a t)) (Carslaw and Jaeger 1959, 10.2).
double point_source_rise(const HeatMaterial& material, double joules, double distance_m,
                         double t_s);

/// Rise about a steady point source that has always moved along +x at `speed_m_per_s`, K, at
/// `from_source`: q / (4 pi k r) exp(-v (r + x) / (2 a)) (Rosenthal 1946).
double moving_source_rise(const HeatMaterial& material, double watts, double speed_m_per_s,
                          const Vec3& from_source);

}  // namespace osteon
