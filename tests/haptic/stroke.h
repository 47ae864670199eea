#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "haptic/cpu_clock.h"
#include "osteon/collide/distance_field.h"
#include "osteon/haptic/haptic.h"
#include "osteon/mesh/distance.h"

namespace osteon::test {

/// A hand that strokes one bone: places under the bone's true surface, all in World.
struct Stroke {
  std::vector<Vec3> hand;     ///< one a tick
  Vec3 above = Vec3::Zero();  ///< where it comes down from
};

struct StrokeOptions {
  double tip_m = 0.00075;
  double depth_m = 0.001;  ///< of the hand under the place where the tip would rest
  double length_m = 0.020;
  double step_m = 2e-5;  ///< a tick: 20 mm/s
  int smooth = 25;       ///< ticks to either side over which the hand is averaged, twice
};

inline void average(std::vector<Vec3>& points, int reach) {
  const std::vector<Vec3> before = points;
  const int last = static_cast<int>(points.size()) - 1;
  for (int i = 0; i <= last; ++i) {
    const int wide = std::min({reach, i, last - i});
    Vec3 sum = Vec3::Zero();
    for (int k = i - wide; k <= i + wide; ++k) sum += before[static_cast<std::size_t>(k)];
    points[static_cast<std::size_t>(i)] = sum / (2 * wide + 1);
  }
}

/// As straight as the surface lets it, from the place next to `start` along `way`. None where the
/// field ends. The bone rests at the identity.
inline std::optional<Stroke> stroke_over(const DistanceField& field, const Vec3& start, Vec3 way,
                                         const StrokeOptions& o = {}) {
  Stroke out;
  Vec3 x = start;
  const int ticks = static_cast<int>(o.length_m / o.step_m);
  for (int i = 0; i <= ticks; ++i) {
    FieldSample s;
    for (int k = 0; k < 5; ++k) {
      s = field.at(x);
      const double slope2 = s.gradient.squaredNorm();
      if (!(slope2 > 0.01)) return std::nullopt;
      x -= (s.distance - o.tip_m) / slope2 * s.gradient;
    }
    s = field.at(x);
    if (!s.near || std::abs(s.distance - o.tip_m) > 1e-7) return std::nullopt;
    const Vec3 n = s.gradient.normalized();
    const Vec3 along = way - n.dot(way) * n;
    if (!(along.norm() > 1e-3 * way.norm())) return std::nullopt;
    if (i == 0) out.above = x + 0.002 * n;
    out.hand.push_back(x - o.depth_m * n);
    way = along.normalized();
    x += o.step_m * way;
  }
  for (int pass = 0; pass < 2; ++pass) average(out.hand, o.smooth);
  return out;
}

/// What the hand felt in each tick of a stroke.
struct FeltStroke {
  std::vector<Vec3> force;
  std::vector<Vec3> proxy;
  std::vector<double> tick_us;
  std::size_t lost = 0;  ///< ticks without contact
};

inline FeltStroke feel(std::shared_ptr<const Case> the_case, std::shared_ptr<const Tool> tool,
                       const Stroke& stroke) {
  const BoneSnapshot bones = rest_snapshot(*the_case);
  HapticLoop loop(std::move(the_case), std::move(tool));
  HapticParams params;
  params.friction_scale = 0;
  ToolInput input;
  constexpr int kDown = 150;
  for (int i = 0; i <= 2 * kDown; ++i) {
    const double share = std::min(1.0, static_cast<double>(i) / kDown);
    input.X_WD.p = stroke.above + share * (stroke.hand.front() - stroke.above);
    loop.tick(input, bones, 0, params);
  }
  FeltStroke out;
  for (std::size_t i = 0; i < stroke.hand.size(); ++i) {
    input.v_W =
        i == 0 ? Vec3(Vec3::Zero()) : Vec3((stroke.hand[i] - stroke.hand[i - 1]) / params.tick_s);
    input.X_WD.p = stroke.hand[i];
    const std::int64_t start = cpu_now_ns();
    const ToolState& s = loop.tick(input, bones, 0, params);
    out.tick_us.push_back(1e-3 * static_cast<double>(cpu_now_ns() - start));
    out.force.push_back(s.force_W);
    out.proxy.push_back(s.X_WP.p);
    out.lost += s.contact_count == 0;
  }
  return out;
}

inline double mean_force(const FeltStroke& felt) {
  double sum = 0;
  for (const Vec3& f : felt.force) sum += f.norm();
  return felt.force.empty() ? 0 : sum / static_cast<double>(felt.force.size());
}

/// Largest change of force in a tick, as a share of the mean, beyond that of `truth` within a
/// quarter millimetre of the same place: what the surface's own curvature gives there.
inline double worst_click(const FeltStroke& felt, const FeltStroke& truth) {
  constexpr std::size_t kNear = 12;
  const auto jump = [](const FeltStroke& f, std::size_t i) {
    return (f.force[i] - f.force[i - 1]).norm();
  };
  double worst = 0;
  for (std::size_t i = 1; i < felt.force.size(); ++i) {
    double own = 0;
    const std::size_t first = i > kNear ? i - kNear : 1;
    const std::size_t last = std::min(i + kNear, truth.force.size() - 1);
    for (std::size_t k = first; k <= last; ++k) own = std::max(own, jump(truth, k));
    worst = std::max(worst, jump(felt, i) - own);
  }
  return worst / mean_force(truth);
}

/// Largest change of force in a tick, as a share of the mean.
inline double worst_jump(const FeltStroke& felt) {
  double worst = 0;
  for (std::size_t i = 1; i < felt.force.size(); ++i)
    worst = std::max(worst, (felt.force[i] - felt.force[i - 1]).norm());
  return worst / mean_force(felt);
}

}  // namespace osteon::test
