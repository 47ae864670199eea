#include "osteon/procedure/path_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "osteon/base/random.h"

namespace osteon {
namespace {

constexpr double kPi = std::numbers::pi;

// A way sampled every 1/rate on average, each step between half and one and a half of it.
ProbePath sampled(const std::function<Pose(double)>& way, double duration_s, double rate_hz,
                  bool evenly = false) {
  Random random(7);
  ProbePath path;
  for (double t = 0; t < duration_s;) {
    path.samples.push_back({3 + t, way(t), false});
    t += (evenly ? 1 : random.uniform(0.5, 1.5)) / rate_hz;
  }
  path.samples.push_back({3 + duration_s, way(duration_s), false});
  return path;
}

Pose circle(double t) {  // 20 mm about the origin, once in 4 s
  const double a = kPi / 2 * t;
  return {Vec3(0.02 * std::cos(a), 0.02 * std::sin(a), 0), Quat::Identity()};
}
Pose helix(double t) {  // the same, rising 5 mm a second, turning about z with it
  const double a = kPi / 2 * t;
  const Vec3 p = circle(t).p + Vec3(0, 0, 0.005 * t);
  return {p, Quat(std::cos(a / 2), 0, 0, std::sin(a / 2))};
}
Pose line(double t) { return {Vec3(0.010 * t, 0.020 * t, -0.020 * t), Quat::Identity()}; }

PathMetrics measured(const ProbePath& path, const PathMetricsOptions& options = {}) {
  const auto metrics = path_metrics(path, options);
  EXPECT_TRUE(metrics.has_value()) << metrics.error().message();
  return metrics.value_or(PathMetrics{});
}

void expect_share(double value, double wanted, double share = 1e-3) {
  EXPECT_NEAR(value, wanted, share * std::abs(wanted));
}

TEST(PathMetrics, RefusesWhatHasNoMovement) {
  ProbePath path;
  EXPECT_FALSE(path_metrics(path));
  path.samples.push_back({});
  ASSERT_FALSE(path_metrics(path));
  EXPECT_NE(path_metrics(path).error().what.find("1 sample"), std::string::npos);
}

TEST(PathMetrics, RefusesTimeThatRunsBackAndNumbersThatAreNone) {
  ProbePath path = sampled(line, 1, 100);
  path.samples[5].time_s = path.samples[4].time_s;
  ASSERT_FALSE(path_metrics(path));
  EXPECT_NE(path_metrics(path).error().where.find("sample 6"), std::string::npos);
  path = sampled(line, 1, 100);
  path.samples[7].X_WD.p.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(path_metrics(path));
  PathMetricsOptions options;
  options.axis_W = Vec3::Zero();
  EXPECT_FALSE(path_metrics(sampled(line, 1, 100), options));
}

TEST(PathMetrics, OfATipThatRestsAreZeroOrEmpty) {
  const PathMetrics m = measured(sampled([](double) { return Pose{}; }, 1, 100));
  EXPECT_EQ(m.path_mm, 0);
  EXPECT_EQ(m.speed_mm_s, 0);
  EXPECT_EQ(m.smoothness, 0.0);
  EXPECT_FALSE(m.sparc);
  EXPECT_FALSE(m.ldlj);
  EXPECT_FALSE(m.inefficiency_percent);
  EXPECT_FALSE(m.time_in_tissue_s);
}

TEST(PathMetrics, OfALine) {
  const PathMetrics m = measured(sampled(line, 2, 200));
  expect_share(m.elapsed_s, 2);
  expect_share(m.path_mm, 60);
  expect_share(m.speed_mm_s, 30);
  expect_share(m.depth_mm, 40);  // along the shaft, z
  EXPECT_NEAR(*m.smoothness, 0, 1e-2);
  EXPECT_FALSE(m.ldlj);
  EXPECT_NEAR(*m.inefficiency_percent, 0, 1e-9);
  EXPECT_EQ(m.rotation_deg, 0);
  EXPECT_EQ(m.translational_actions, 0);
}

TEST(PathMetrics, OfACircle) {
  PathMetricsOptions options;
  options.axis_W = Vec3(3, 0, 0);
  const PathMetrics m = measured(sampled(circle, 10, 1000), options);
  const double v = 20 * kPi / 2;  // mm/s
  expect_share(m.path_mm, 10 * v);
  expect_share(m.speed_mm_s, v);
  expect_share(*m.smoothness, v * v * v / 400 * std::sqrt(10));
  expect_share(*m.ldlj, -4 * std::log(10 * kPi / 2));  // T^4 omega^4 under the logarithm
  expect_share(m.depth_mm, 10 * 20);                   // 40 mm each half turn
  expect_share(*m.inefficiency_percent, 100 * (5 * kPi / 2 - 1));
}

TEST(PathMetrics, OfAHelixWithItsTurns) {
  const PathMetrics m = measured(sampled(helix, 10, 1000));
  const double v = std::hypot(20 * kPi / 2, 5);
  expect_share(m.path_mm, 10 * v);
  expect_share(m.depth_mm, 50);
  expect_share(m.rotation_deg, 900);
  EXPECT_EQ(m.rotational_actions, 1);  // 90 degrees a second all the time
  EXPECT_EQ(m.translational_actions, 0);
}

TEST(PathMetrics, ActionsAreCountedOnceTheyHaveLasted) {
  // Still, then at 100 mm/s for `fast_s`, three times.
  const auto thrice = [](double fast_s) {
    return [fast_s](double t) {
      double x = 0;
      for (int k = 0; k < 3; ++k) x += 0.1 * std::clamp(t - k - 0.4, 0.0, fast_s);
      return Pose{Vec3(x, 0, 0), Quat::Identity()};
    };
  };
  EXPECT_EQ(measured(sampled(thrice(0.3), 3, 500)).translational_actions, 3);
  EXPECT_EQ(measured(sampled(thrice(0.15), 3, 500)).translational_actions, 0);
}

TEST(PathMetrics, InTheBallAreThoseOfItsChord) {
  // Tissue: a ball of 30 mm. The tip goes along x through its centre, the shaft up.
  PathMetricsOptions options;
  options.tissue_W = [](const Vec3& p) { return p.norm() - 0.030; };
  const auto along_x = [](double t) {
    return Pose{Vec3(-0.05 + 0.01 * t, 0, 0), Quat::Identity()};
  };
  const PathMetrics m = measured(sampled(along_x, 10, 1000), options);
  expect_share(*m.time_in_tissue_s, 6);
  expect_share(*m.path_in_tissue_mm, 60);
  expect_share(*m.tissue_damage_mm2, kPi * 30 * 30 / 2);  // the upper half of its disc
  options.shaft_m = 0.001;                                // a stump sweeps a strip
  expect_share(*measured(sampled(along_x, 10, 1000), options).tissue_damage_mm2, 60, 2e-3);
}

TEST(PathMetrics, OfUnevenSamplesAreThoseOfEvenOnes) {
  const auto reach = [](double t) {  // minimum jerk over 100 mm in 2 s (Flash and Hogan 1985)
    const double s = t / 2;
    return Pose{Vec3(0.1 * s * s * s * (10 - 15 * s + 6 * s * s), 0, 0), Quat::Identity()};
  };
  const PathMetrics uneven = measured(sampled(reach, 2, 400));
  const PathMetrics even = measured(sampled(reach, 2, 100, true));
  expect_share(*uneven.sparc, *even.sparc);
  expect_share(*uneven.ldlj, *even.ldlj);
  // integral jerk^2 = 720 D^2 / T^5, peak speed 1.875 D / T
  // At 100 Hz three samples of the largest jerk, at the ends, are not seen.
  expect_share(*uneven.ldlj, -std::log(720 / (1.875 * 1.875)), 1.2e-2);
  expect_share(*uneven.smoothness, std::sqrt(720 * 100 * 100 / 32.0), 5e-3);
}

TEST(PathMetrics, ATremorIsLessSmooth) {
  const auto shaking = [](double t) {
    return Pose{line(t).p + Vec3(0, 0, 0.0005 * std::sin(2 * kPi * 9 * t)), Quat::Identity()};
  };
  const auto calm = [](double t) {
    return Pose{line(t).p + Vec3(0, 0, 0.0005 * std::sin(2 * kPi * 1 * t)), Quat::Identity()};
  };
  const PathMetrics rough = measured(sampled(shaking, 3, 400));
  const PathMetrics smooth = measured(sampled(calm, 3, 400));
  EXPECT_LT(*rough.sparc, *smooth.sparc);
  EXPECT_LT(*rough.ldlj, *smooth.ldlj - 3);
  EXPECT_GT(*rough.smoothness, 10 * *smooth.smoothness);
}

TEST(PathMetrics, AsJsonHaveEveryKeyInOrder) {
  const auto json = nlohmann::ordered_json::parse(to_json(measured(sampled(line, 1, 100))));
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{"elapsed_s", "path_mm", "time_in_tissue_s",
                                            "path_in_tissue_mm", "tissue_damage_mm2", "speed_mm_s",
                                            "smoothness", "sparc", "ldlj", "depth_mm",
                                            "rotation_deg", "inefficiency_percent",
                                            "translational_actions", "rotational_actions"}));
  EXPECT_TRUE(json["tissue_damage_mm2"].is_null());
  EXPECT_NEAR(json["path_mm"].get<double>(), 30, 1e-9);
}

}  // namespace
}  // namespace osteon
