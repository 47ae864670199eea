#include "runs/pictures/work_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "osteon/base/turn.h"

namespace osteon {
namespace {

constexpr double kAside_rad = 100 * std::numbers::pi / 180;  // shafts come in from the left
constexpr double kUp_rad = 35 * std::numbers::pi / 180;
constexpr double kBenchUp_rad = 55 * std::numbers::pi / 180;
constexpr double kAround_m = 0.02;  // of each point, for instruments and posts

Vec3 mean_of_points(std::span<const Vec3> points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

// So near that all of the points are in the picture from there.
Camera look_from(Camera camera, const Vec3& view_from_W, std::span<const Vec3> points_W,
                 double aspect) {
  Vec3 lo = points_W.front(), hi = lo;
  for (const Vec3& p : points_W) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  camera.orthographic = false;
  camera.target_W = 0.5 * (lo + hi);
  camera.q_WC = look_rotation(view_from_W, Vec3::UnitZ());
  const double radius_m = 0.5 * (hi - lo).norm() + kAround_m;
  const double half = std::atan(std::tan(0.5 * camera.vertical_fov_rad) * std::min(1.0, aspect));
  camera.distance_m = radius_m / std::sin(half);
  return camera;
}

}  // namespace

Camera side_camera(const Camera& from, std::span<const Vec3> portals_W,
                   std::span<const Vec3> places_W, double aspect) {
  if (portals_W.empty() || places_W.empty() || !(aspect > 0)) return from;
  Vec3 back = mean_of_points(portals_W) - mean_of_points(places_W);
  back.z() = 0;
  if (!is_finite(back) || back.norm() < 1e-4) back = -Vec3::UnitX();
  back = Eigen::AngleAxisd(kAside_rad, Vec3::UnitZ()) * back.normalized();
  const Vec3 view_from = std::cos(kUp_rad) * back + std::sin(kUp_rad) * Vec3::UnitZ();
  std::vector<Vec3> points(portals_W.begin(), portals_W.end());
  points.insert(points.end(), places_W.begin(), places_W.end());
  return look_from(from, view_from, points, aspect);
}

namespace {

std::vector<Vec3> points_on(const GraftBenchPlan& bench) {
  std::vector<Vec3> points{bench.graft_from_W, bench.graft_to_W, bench.board_from_W,
                           bench.board_to_W, bench.hook_W};
  points.insert(points.end(), bench.posts_W.begin(), bench.posts_W.end());
  for (const GraftBenchPlan::Tendon& tendon : bench.tendons) {
    points.push_back(tendon.insertion_W);
    points.push_back(tendon.free_W);
    points.insert(points.end(), tendon.bands_W.begin(), tendon.bands_W.end());
  }
  return points;
}

}  // namespace

Camera bench_camera(const Camera& from, const GraftBenchPlan& bench, double aspect,
                    bool near_fascia) {
  if (!(aspect > 0)) return from;
  // Tendons run away from who works there.
  Vec3 back = -bench.tendons[0].along_W;
  back.z() = 0;
  if (!is_finite(back) || back.norm() < 1e-4) back = -Vec3::UnitX();
  const Vec3 view_from =
      std::cos(kBenchUp_rad) * back.normalized() + std::sin(kBenchUp_rad) * Vec3::UnitZ();
  if (!near_fascia || !bench.is_covered())
    return look_from(from, view_from, points_on(bench), aspect);
  const std::vector<Vec3> points{bench.fascia_from_W, bench.fascia_to_W,
                                 bench.tendons[0].insertion_W, bench.tendons[1].insertion_W};
  // Straight down: a stroke along the mark is one along the picture, and stays as deep as it is.
  Camera camera = look_from(from, view_from, points, aspect);
  camera.q_WC = look_rotation(bench.fascia_up_W(), bench.fascia_along_W());
  return camera;
}

Camera skin_camera(const Camera& from, const Pose& X_WS) {
  constexpr double kAway_m = 0.22;
  Camera camera = from;
  camera.orthographic = false;
  camera.target_W = X_WS.p;
  camera.distance_m = kAway_m;
  camera.q_WC =
      look_rotation(X_WS.rotate(Vec3(0, -0.4, 1).normalized()), X_WS.rotate(Vec3::UnitY()));
  return camera;
}

bool is_at_bench(const GraftBenchPlan& bench, const Vec3& tip_W) {
  constexpr double kNear_m = 0.1;
  Aabb box;
  for (const Vec3& p_W : points_on(bench)) box.include(p_W);
  // A stripper goes along a tendon far out of the picture's middle.
  for (std::uint32_t line = 0; line < GraftBenchPlan::kLines; ++line) {
    box.include(bench.begin_W(line));
    box.include(bench.end_W(line));
  }
  return (box.lo - tip_W).cwiseMax(tip_W - box.hi).cwiseMax(0).norm() < kNear_m;
}

Pose beside_bench(const GraftBenchPlan& bench, bool near_fascia) {
  if (near_fascia && bench.is_covered()) {
    // From the side: the shaft hides nothing of the mark from above.
    const Vec3 back_W = 0.6 * bench.fascia_across_W() + 0.8 * bench.fascia_up_W();
    const Vec3 before_W = bench.fascia_from_W - 0.005 * bench.fascia_along_W();
    return {before_W + 0.011 * bench.fascia_up_W(), turn_between(Vec3::UnitZ(), back_W)};
  }
  const Vec3 above_W = bench.graft_from_W + Vec3(-0.03, 0.16, 0.06);
  return {above_W, turn_between(Vec3::UnitZ(), Vec3(-0.4, 0, 0.9).normalized())};
}

}  // namespace osteon
