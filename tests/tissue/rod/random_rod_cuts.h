#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "osteon/tissue/rod_cut.h"

namespace osteon::testing {

struct RodSums {
  double mass_kg = 0, length_m = 0, elastic_j = 0;
  Vec3 momentum = Vec3::Zero();
  std::size_t segments = 0;
};

inline void add_to(RodSums& sums, const RodPart& part, const RodStepper& stepper) {
  for (std::size_t i = 0; i < part.rod.mass_kg.size(); ++i) {
    sums.mass_kg += part.rod.mass_kg[i];
    sums.momentum += part.rod.mass_kg[i] * part.state.velocity_m_per_s[i];
  }
  for (const double length : part.rod.length_m) sums.length_m += length;
  sums.elastic_j += stepper.energy(part.state).strain_j;
  sums.segments += part.rod.segments();
}

/// A rod that swings under its weight and is cut again and again, as numbers from -1 to 1 say.
class RandomRodCuts {
 public:
  using Numbers = std::function<double()>;

  /// Empty: no such rod can be made.
  bool begin(const Numbers& next) {
    parts_.clear();
    RodDef def;
    Vec3 at = Vec3::Zero();
    for (int i = 0; i < 5; ++i) {
      def.points_W.push_back(at);
      const double y = next();
      const double z = next();
      at += Vec3(0.02, 0.006 * y, 0.006 * z);
    }
    def.radius_m = 0.001 + 0.0005 * next();
    def.segments = 18 + static_cast<int>(8 * next());
    def.straight_at_rest = next() > 0.5;
    def.material.young_pa = 1e6;
    def.material.poisson = 0.4;
    def.material.density_kg_per_m3 = 1100;
    def.material.damping_per_s = 2;
    auto rod = make_rod(def);
    if (!rod) return false;
    RodPart whole;
    whole.rod = std::move(*rod);
    whole.supports.gravity_m_per_s2 = {0, 0, -9.81};
    whole.supports.grips.emplace_back();
    if (next() > -0.5)
      for (std::uint32_t axis = 0; axis < 3; ++axis) whole.supports.axes.push_back({0, axis, 0});
    whole.state = RodStepper(whole.rod, whole.supports, kStep_s).start_state();
    for (Vec3& v : whole.state.velocity_m_per_s) v.x() = 0.05 * next();
    parts_.push_back(std::move(whole));
    step();
    return true;
  }
  bool can_cut() const {
    for (const RodPart& part : parts_)
      if (part.rod.segments() > 1) return true;
    return false;
  }
  /// What went wrong; empty: nothing.
  std::string cut(const Numbers& next) {
    std::size_t which =
        static_cast<std::size_t>(0.5 * (next() + 1) * 0.999 * static_cast<double>(parts_.size()));
    while (parts_[which].rod.segments() < 2) which = (which + 1) % parts_.size();
    const double inner = static_cast<double>(parts_[which].rod.segments() - 1);
    const auto node = 1 + static_cast<std::size_t>(0.5 * (next() + 1) * 0.999 * inner);
    const RodSums before = sums();
    auto two = cut_rod(parts_[which].rod, parts_[which].supports, parts_[which].state, node);
    if (!two) return "it was not cut";
    parts_[which] = std::move(two->first);
    parts_.push_back(std::move(two->second));
    const RodSums after = sums();
    if (after.segments != before.segments) return "another number of segments";
    if (std::abs(after.mass_kg / before.mass_kg - 1) > 1e-12) return "another mass";
    if (std::abs(after.length_m / before.length_m - 1) > 1e-12) return "another length";
    if ((after.momentum - before.momentum).norm() > 1e-12 * before.mass_kg) return "a push";
    if (after.elastic_j > before.elastic_j * (1 + 1e-9) + 1e-15) return "energy from nowhere";
    step();
    return why_unsound();
  }
  std::size_t parts() const { return parts_.size(); }

 private:
  static constexpr double kStep_s = 5e-4;

  RodSums sums() const {
    RodSums out;
    for (const RodPart& part : parts_)
      add_to(out, part, RodStepper(part.rod, part.supports, kStep_s));
    return out;
  }
  void step() {
    for (RodPart& part : parts_) {
      RodStepper stepper(part.rod, part.supports, kStep_s);
      for (int i = 0; i < 3; ++i) stepper.step(part.state);
    }
  }
  std::string why_unsound() const {
    for (const RodPart& part : parts_) {
      if (find_lost(part.rod, part.state)) return "a segment was lost";
      for (const Quat& q : part.state.R_WS)
        if (!(std::abs(q.norm() - 1) < 1e-9)) return "a frame is no turn";
      for (const Vec3& v : part.state.velocity_m_per_s)
        if (!is_finite(v)) return "a speed is no number";
      const RodSurface skin = rod_surface(part.rod, part.state.at_W, part.state.R_WS);
      if (!is_closed(skin)) return "its surface is open";
    }
    return {};
  }
  // Each edge once in each direction.
  static bool is_closed(const RodSurface& skin) {
    std::vector<std::uint64_t> ways;
    for (std::size_t t = 0; t < skin.triangles.size(); t += 3)
      for (std::size_t k = 0; k < 3; ++k)
        ways.push_back(std::uint64_t{skin.triangles[t + k]} << 32 |
                       skin.triangles[t + (k + 1) % 3]);
    std::sort(ways.begin(), ways.end());
    if (std::adjacent_find(ways.begin(), ways.end()) != ways.end()) return false;
    return std::all_of(ways.begin(), ways.end(), [&](std::uint64_t way) {
      return std::binary_search(ways.begin(), ways.end(), way << 32 | way >> 32);
    });
  }

  std::vector<RodPart> parts_;
};

}  // namespace osteon::testing
