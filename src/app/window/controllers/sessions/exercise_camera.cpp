#include "window/controllers/sessions/exercise_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace osteon {
namespace {

constexpr double kAside_rad = 100 * std::numbers::pi / 180;  // shafts come in from the left
constexpr double kUp_rad = 35 * std::numbers::pi / 180;
constexpr double kAround_m = 0.02;  // of each point, for instruments and posts

Vec3 mean_of_points(std::span<const Vec3> points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
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
  Vec3 lo = places_W.front(), hi = lo;
  for (const auto& points : {portals_W, places_W})
    for (const Vec3& p : points) {
      lo = lo.cwiseMin(p);
      hi = hi.cwiseMax(p);
    }
  Camera camera = from;
  camera.orthographic = false;
  camera.target_W = 0.5 * (lo + hi);
  camera.q_WC = look_rotation(view_from, Vec3::UnitZ());
  const double radius_m = 0.5 * (hi - lo).norm() + kAround_m;
  const double half = std::atan(std::tan(0.5 * camera.vertical_fov_rad) * std::min(1.0, aspect));
  camera.distance_m = radius_m / std::sin(half);
  return camera;
}

}  // namespace osteon
