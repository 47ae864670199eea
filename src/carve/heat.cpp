#include "osteon/carve/heat.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace osteon {
namespace {

/// Of the largest stable step h^2 / (6 a).
constexpr double kStepShare = 0.8;

}  // namespace

Result<HeatGrid> HeatGrid::make(const Aabb& box, double cell_m, const HeatMaterial& material) {
  const bool finite = is_finite(box.lo) && is_finite(box.hi) && std::isfinite(cell_m);
  if (!finite || box.empty() || !(cell_m > 0))
    return fail("has no size", "the grid of temperatures", "Give a box and a cell above zero");
  if (!(material.diffusivity_m2_per_s() > 0) || !std::isfinite(material.diffusivity_m2_per_s()))
    return fail("does not conduct", "the material of the grid of temperatures",
                "Give conductivity, density and heat capacity above zero");
  HeatGrid grid;
  double cells = 1;
  for (std::size_t k = 0; k < 3; ++k)
    cells *= std::ceil(box.extent()[static_cast<Eigen::Index>(k)] / cell_m) + 1;
  if (cells > static_cast<double>(kMostCells))
    return fail("would have " + std::to_string(cells) + " cells", "the grid of temperatures",
                "Choose larger cells or a smaller box");
  for (std::size_t k = 0; k < 3; ++k)
    grid.size_[k] = static_cast<std::size_t>(
        std::max(3.0, std::ceil(box.extent()[static_cast<Eigen::Index>(k)] / cell_m) + 1));
  grid.material_ = material;
  grid.origin_ = box.lo;
  grid.cell_m_ = cell_m;
  const std::size_t n = grid.size_[0] * grid.size_[1] * grid.size_[2];
  grid.above_body_.assign(n, 0);
  grid.next_.assign(n, 0);
  grid.gone_.assign(n, 0);
  for (auto& hot : grid.hot_s_) hot.assign(n, 0);
  return grid;
}

void HeatGrid::add_heat(const Vec3& p, double joules) {
  const Vec3 at = (p - origin_) / cell_m_;
  if (!is_finite(at) || !std::isfinite(joules)) return;
  std::array<std::size_t, 3> low{};
  std::array<double, 3> part{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = at[static_cast<Eigen::Index>(k)];
    if (x < 0 || x >= static_cast<double>(size_[k] - 1)) return;
    low[k] = static_cast<std::size_t>(x);
    part[k] = x - static_cast<double>(low[k]);
  }
  std::array<double, 8> shares{};
  std::array<std::size_t, 8> cells{};
  double all = 0;
  for (std::size_t c = 0; c < 8; ++c) {
    const std::size_t i = c & 1, j = c >> 1 & 1, k = c >> 2;
    cells[c] = index(low[0] + i, low[1] + j, low[2] + k);
    shares[c] = gone_[cells[c]] ? 0
                                : (i ? part[0] : 1 - part[0]) * (j ? part[1] : 1 - part[1]) *
                                      (k ? part[2] : 1 - part[2]);
    all += shares[c];
  }
  if (!(all > 0)) return;
  const double rise = joules / (material_.density_kg_per_m3 * material_.heat_capacity_j_per_kg_k *
                                cell_m_ * cell_m_ * cell_m_);
  for (std::size_t c = 0; c < 8; ++c) above_body_[cells[c]] += shares[c] / all * rise;
}

void HeatGrid::step(double dt_s) {
  if (!(dt_s > 0) || !std::isfinite(dt_s)) return;
  const double most = kStepShare * cell_m_ * cell_m_ / (6 * material_.diffusivity_m2_per_s());
  const int steps = std::max(1, static_cast<int>(std::ceil(std::min(dt_s / most, 1e6))));
  for (int i = 0; i < steps; ++i) conduct(dt_s / steps);
  time_s_ += dt_s;
  note_heat(dt_s);
}

void HeatGrid::conduct(double dt_s) {
  const double share = material_.diffusivity_m2_per_s() * dt_s / (cell_m_ * cell_m_);
  const std::size_t row = size_[0], sheet = size_[0] * size_[1];
  for (std::size_t k = 1; k + 1 < size_[2]; ++k)
    for (std::size_t j = 1; j + 1 < size_[1]; ++j)
      for (std::size_t i = 1; i + 1 < size_[0]; ++i) {
        const std::size_t c = index(i, j, k);
        if (gone_[c]) continue;
        const double here = above_body_[c];
        double flow = 0;
        for (const std::size_t n : {c - 1, c + 1, c - row, c + row, c - sheet, c + sheet})
          if (!gone_[n]) flow += above_body_[n] - here;
        next_[c] = here + share * flow;
      }
  above_body_.swap(next_);
}

void HeatGrid::note_heat(double dt_s) {
  const auto& rules = material_.necrosis;
  for (std::size_t r = 0; r < rules.size(); ++r) {
    const double limit = rules[r].above_c - material_.body_c;
    for (std::size_t c = 0; c < above_body_.size(); ++c)
      if (above_body_[c] >= limit && !gone_[c]) hot_s_[r][c] += dt_s;
  }
}

void HeatGrid::open(const Vec3& from, const Vec3& to, double radius_m) {
  const Vec3 along = to - from;
  const double length2 = along.squaredNorm();
  for (std::size_t k = 0; k < size_[2]; ++k)
    for (std::size_t j = 0; j < size_[1]; ++j)
      for (std::size_t i = 0; i < size_[0]; ++i) {
        const Vec3 p = origin_ + cell_m_ * Vec3(static_cast<double>(i), static_cast<double>(j),
                                                static_cast<double>(k));
        const double t = length2 > 0 ? std::clamp((p - from).dot(along) / length2, 0.0, 1.0) : 0;
        if ((p - from - t * along).squaredNorm() > radius_m * radius_m) continue;
        const std::size_t c = index(i, j, k);
        gone_[c] = 1;
        above_body_[c] = next_[c] = 0;
      }
}

// A cell of bone loses h A (T - water) through each face towards what is open; solved implicitly,
// so that a large step ends at the water's temperature, not beyond it.
void HeatGrid::irrigate(const Irrigation& water, double dt_s) {
  if (!(dt_s > 0)) return;
  const double capacity =
      material_.density_kg_per_m3 * material_.heat_capacity_j_per_kg_k * cell_m_;
  const double cold = water.water_c - material_.body_c;
  const std::size_t row = size_[0], sheet = size_[0] * size_[1];
  for (std::size_t k = 1; k + 1 < size_[2]; ++k)
    for (std::size_t j = 1; j + 1 < size_[1]; ++j)
      for (std::size_t i = 1; i + 1 < size_[0]; ++i) {
        const std::size_t c = index(i, j, k);
        const int faces = gone_[c - 1] + gone_[c + 1] + gone_[c - row] + gone_[c + row] +
                          gone_[c - sheet] + gone_[c + sheet];
        if (gone_[c] || faces == 0) continue;
        const double rate = water.transfer_w_per_m2_k * faces / capacity;
        above_body_[c] = (above_body_[c] + rate * dt_s * cold) / (1 + rate * dt_s);
      }
}

double HeatGrid::temperature_at(const Vec3& p) const {
  const Vec3 at = (p - origin_) / cell_m_;
  std::array<std::size_t, 3> low{};
  std::array<double, 3> part{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = at[static_cast<Eigen::Index>(k)];
    if (!(x >= 0) || x >= static_cast<double>(size_[k] - 1)) return material_.body_c;
    low[k] = static_cast<std::size_t>(x);
    part[k] = x - static_cast<double>(low[k]);
  }
  double sum = 0;
  for (std::size_t c = 0; c < 8; ++c) {
    const std::size_t i = c & 1, j = c >> 1 & 1, k = c >> 2;
    sum += (i ? part[0] : 1 - part[0]) * (j ? part[1] : 1 - part[1]) * (k ? part[2] : 1 - part[2]) *
           above_body_[index(low[0] + i, low[1] + j, low[2] + k)];
  }
  return material_.body_c + sum;
}

double HeatGrid::hottest_c() const {
  double most = 0;
  for (std::size_t c = 0; c < above_body_.size(); ++c)
    if (!gone_[c]) most = std::max(most, above_body_[c]);
  return material_.body_c + most;
}

double HeatGrid::necrosis_m3(std::size_t rule) const {
  if (rule >= hot_s_.size()) return 0;
  const double for_s = material_.necrosis[rule].for_s;
  std::size_t dead = 0;
  for (std::size_t c = 0; c < gone_.size(); ++c)
    dead += !gone_[c] && hot_s_[rule][c] >= for_s ? 1 : 0;
  return static_cast<double>(dead) * cell_m_ * cell_m_ * cell_m_;
}

double HeatGrid::energy_j() const {
  double sum = 0;
  for (const double rise : above_body_) sum += rise;
  return sum * material_.density_kg_per_m3 * material_.heat_capacity_j_per_kg_k * cell_m_ *
         cell_m_ * cell_m_;
}

double point_source_rise(const HeatMaterial& material, double joules, double distance_m,
                         double t_s) {
  if (!(t_s > 0)) return 0;
  const double spread = 4 * material.diffusivity_m2_per_s() * t_s;
  return joules / (material.density_kg_per_m3 * material.heat_capacity_j_per_kg_k) /
         std::pow(M_PI * spread, 1.5) * std::exp(-distance_m * distance_m / spread);
}

double moving_source_rise(const HeatMaterial& material, double watts, double speed_m_per_s,
                          const Vec3& from_source) {
  const double r = from_source.norm();
  return watts / (4 * M_PI * material.conductivity_w_per_m_k * r) *
         std::exp(-speed_m_per_s * (r + from_source.x()) / (2 * material.diffusivity_m2_per_s()));
}

}  // namespace osteon
