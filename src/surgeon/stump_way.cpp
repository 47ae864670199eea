#include "stump_way.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

constexpr double kGrid_m = 0.0008;
constexpr double kOfFootprint_m = 0.0015;  // this near the bone stays
constexpr double kRoom_m = 0.0003;         // between tool and bone
constexpr double kLeastGain = 0.004;       // of all that is to go
constexpr std::size_t kMostPlaces = 80;
constexpr double kBeforeSkin_m = 0.05, kBeforeStump_m = 0.012;
constexpr double kPlunge_m_per_s = 0.007, kAgain_m_per_s = 0.015, kThrough_m_per_s = 0.04;
constexpr double kSpare_m = 0.001, kStays_s = 0.5;

// Places in the stumps that are to be cleared, in World.
std::vector<Vec3> places_in(const AclKnee& knee, const std::vector<TornStump>& stumps) {
  std::vector<Vec3> out;
  for (const TornStump& stump : stumps) {
    const Pose X_WB = knee.whole().bone(stump.bone).X_WB;
    const MeshDistance inside(stump.mesh_B), bone(knee.whole().bone(stump.bone).mesh);
    const Aabb box = bounds(stump.mesh_B);
    for (double x = box.lo.x(); x < box.hi.x(); x += kGrid_m)
      for (double y = box.lo.y(); y < box.hi.y(); y += kGrid_m)
        for (double z = box.lo.z(); z < box.hi.z(); z += kGrid_m) {
          const Vec3 p_B(x, y, z);
          if (inside.closest(p_B).signed_distance < 0 &&
              bone.closest(p_B).signed_distance > kOfFootprint_m)
            out.push_back(X_WB * p_B);
        }
  }
  return out;
}

// How far before `to_W` a round end that comes straight from the portal passes over a place; none:
// it does not.
std::optional<double> passed_at(const Vec3& p_W, const Vec3& to_W, const Vec3& back_W,
                                double radius_m) {
  const Vec3 off = p_W - to_W;
  const double along = std::max(0.0, off.dot(back_W));
  if ((off - along * back_W).norm() >= radius_m) return std::nullopt;
  return along;
}

// Tool's y to a side, as far as the shaft, along `back_W`, lets it.
Quat window_to(const Vec3& aside_W, const Vec3& back_W) {
  const Vec3 across = aside_W - aside_W.dot(back_W) * back_W;
  const Vec3 y = across.norm() > 1e-9 ? Vec3(across.normalized()) : back_W.unitOrthogonal();
  Mat3 R;
  R << y.cross(back_W), y, back_W;
  return Quat(Eigen::Quaterniond(R)).normalized();
}

// The tip so far from the portal on the way to a place, the window to the side that has more.
Pose along(const StumpClearing& with, const ClearingPlace& place, double from_portal_m) {
  const Vec3 back = (with.portal_W - place.to_W).normalized();
  return {with.portal_W - from_portal_m * back, window_to(place.aside_W, back)};
}

}  // namespace

StumpsAsObstacles::StumpsAsObstacles(const Case& the_case, std::vector<TornStump> stumps) {
  for (TornStump& stump : stumps) {
    for (Vec3& p : stump.mesh_B.vertices) p = the_case.bone(stump.bone).X_WB * p;
    stumps_W_.emplace_back(std::move(stump.mesh_B));
  }
}

bool StumpsAsObstacles::is_free(const Vec3& from_W, const Vec3& to_W, double radius_m) const {
  constexpr int kPlaces = 12;
  for (int k = 0; k <= kPlaces; ++k) {
    const Vec3 p_W = from_W + static_cast<double>(k) / kPlaces * (to_W - from_W);
    for (const MeshDistance& stump : stumps_W_)
      if (stump.closest(p_W).signed_distance < radius_m) return false;
  }
  return true;
}

std::vector<ClearingPlace> clearing_places(const AclKnee& knee,
                                           const std::vector<TornStump>& stumps,
                                           const StumpClearing& with) {
  std::vector<Vec3> left = places_in(knee, stumps);
  std::vector<Vec3> free;
  for (const Vec3& p_W : left)
    if (knee.is_free(p_W, with.portal_W, with.radius_m + kRoom_m)) free.push_back(p_W);
  const double least = std::max(1.0, kLeastGain * static_cast<double>(left.size()));
  const auto passed = [&](const Vec3& p_W, const Vec3& to_W) {
    return passed_at(p_W, to_W, (with.portal_W - to_W).normalized(), with.radius_m);
  };
  std::vector<ClearingPlace> chosen;
  while (chosen.size() < kMostPlaces) {
    std::size_t most = 0;
    ClearingPlace best;
    for (const Vec3& to_W : free) {
      const auto gain =
          static_cast<std::size_t>(std::count_if(left.begin(), left.end(), [&](const Vec3& p_W) {
            return passed(p_W, to_W).has_value();
          }));
      if (gain <= most) continue;
      most = gain;
      best.to_W = to_W;
    }
    if (static_cast<double>(most) < least) break;
    std::erase_if(left, [&](const Vec3& p_W) {
      const auto at = passed(p_W, best.to_W);
      if (at) best.way_m = std::max(best.way_m, *at);
      if (at) best.aside_W += p_W - best.to_W;
      return at.has_value();
    });
    chosen.push_back(best);
  }
  return chosen;
}

double before_stumps_m(const AclKnee& knee, const std::vector<TornStump>& stumps,
                       const Vec3& portal_W) {
  double nearest_m = 1;
  for (const TornStump& stump : stumps)
    for (const Vec3& p_B : stump.mesh_B.vertices)
      nearest_m = std::min(nearest_m, (knee.whole().bone(stump.bone).X_WB * p_B - portal_W).norm());
  return std::max(0.0, nearest_m - kBeforeStump_m);
}

void begin_clearing(const StumpClearing& with, const ClearingPlace& first, double before_m,
                    AclWay& way) {
  way.take(with.instrument, with.size_mm);
  way.go_at(along(with, first, -kBeforeSkin_m), kThrough_m_per_s);
  way.go_at(along(with, first, before_m), kThrough_m_per_s);
  way.power(1);
}

// Goes to each place with its window to where most is left, and once more over what has swayed
// away, the window to the other side.
void clear_places(const StumpClearing& with, const std::vector<ClearingPlace>& places,
                  double before_m, AclWay& way) {
  for (const ClearingPlace& place : places) {
    const double to_m = (place.to_W - with.portal_W).norm();
    const double begins_m = to_m - place.way_m - with.radius_m - kSpare_m;
    way.go_at(along(with, place, before_m), kThrough_m_per_s);
    if (begins_m > before_m) way.go_at(along(with, place, begins_m), kThrough_m_per_s);
    way.go_at(along(with, place, to_m + with.radius_m), kPlunge_m_per_s);
    way.stay(kStays_s);
    way.go_at(along(with, place, before_m), kThrough_m_per_s);
  }
  for (ClearingPlace place : places) {
    place.aside_W *= -1;
    way.go_at(along(with, place, before_m), kThrough_m_per_s);
    way.go_at(along(with, place, (place.to_W - with.portal_W).norm() + with.radius_m),
              kAgain_m_per_s);
    way.stay(kStays_s);
    way.go_at(along(with, place, before_m), kThrough_m_per_s);
  }
}

void end_clearing(const StumpClearing& with, const ClearingPlace& last, AclWay& way) {
  way.power(0);
  way.go_at(along(with, last, -kBeforeSkin_m), kThrough_m_per_s);
}

}  // namespace osteon
