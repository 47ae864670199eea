#include "soft/skin_places.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "bone/grow.h"
#include "finding/displace.h"
#include "joint/roll_glide.h"
#include "soft/skin_field.h"

namespace osteon {
namespace {

constexpr double kFine_m = 2e-5;    // for the slope at a point
constexpr double kAbout_m = 0.004;  // for that of the skin about a portal, as a shaft meets it
constexpr int kMostSteps = 60;
constexpr double kStill_m = 1e-9;

Vec3 slope(const SkinField& skin, const Vec3& p_W, double step_m) {
  Vec3 out;
  for (int k = 0; k < 3; ++k) {
    const Vec3 step = step_m * Vec3::Unit(k);
    out[k] = (skin.at(p_W + step) - skin.at(p_W - step)) / (2 * step_m);
  }
  return out;
}

// The nearest point of the skin: f(p) = 0 with p - from along the slope of f. Each step goes down
// the slope to the surface, then half of the way that is left along it (Newton's method for the
// first, damped for the second). Ends when it stands still, or where there is no slope.
Vec3 nearest_on(const SkinField& skin, const Vec3& from) {
  Vec3 p = from;
  for (int i = 0; i < kMostSteps; ++i) {
    const Vec3 g = slope(skin, p, kFine_m);
    if (!(g.squaredNorm() > 1e-6)) return p;
    const Vec3 down = skin.at(p) / g.squaredNorm() * g;
    const Vec3 to = from - (p - down);
    const Vec3 along = to - g * (g.dot(to) / g.squaredNorm());
    const Vec3 step = 0.5 * along - down;
    p += step;
    if (step.norm() < kStill_m) break;
  }
  return p;
}

// Where the line through `from` along `way_W` (unit) meets the skin, the nearest such place but for
// folds. Newton's method, in steps that stay near; none where the skin runs along the line.
std::optional<Vec3> straight_on(const SkinField& skin, const Vec3& from, const Vec3& way_W) {
  constexpr double kStride_m = 0.005, kLeastRise = 0.1;
  Vec3 p = from;
  for (int i = 0; i < kMostSteps; ++i) {
    const Vec3 fine = kFine_m * way_W;
    const double rise = (skin.at(p + fine) - skin.at(p - fine)) / (2 * kFine_m);
    if (!(rise > kLeastRise)) return std::nullopt;
    const double step = std::clamp(-skin.at(p) / rise, -kStride_m, kStride_m);
    p += step * way_W;
    if (std::abs(step) < kStill_m) return p;
  }
  return std::nullopt;
}

// One that stays beside a band lies on the skin straight over where it is beside it: across the
// band's flat side, as that goes with the landmark's bone.
Vec3 on_skin(const AnatomyDescription& anatomy, const LandmarkDescription& landmark,
             const SkinField& skin, const Vec3& from) {
  if (!landmark.along || !landmark.bone) return nearest_on(skin, from);
  const auto& band = std::get<BandDescription>(anatomy.softs[*landmark.along].shape);
  const Pose moved = displacement_of(anatomy, *landmark.bone).value_or(Pose{});
  const auto over = straight_on(skin, from, moved.rotate(band.flat_W));
  return over ? *over : nearest_on(skin, from);
}

}  // namespace

void lay_on_skin(const AnatomyDescription& anatomy, GeneratedAnatomy& grown) {
  AnatomyDescription moved = anatomy;
  move_bound_along(moved);
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < moved.bones.size(); ++i)
    poses.push_back(bend_of(moved, i).value_or(Pose{}) * rest_pose(moved.bones[i]));
  for (std::size_t s = 0; s < moved.softs.size(); ++s) {
    const auto* shape = std::get_if<SkinDescription>(&moved.softs[s].shape);
    if (!shape) continue;
    const SkinField skin(*shape, moved.bones, poses);
    for (std::size_t i = 0; i < moved.landmarks.size() && i < grown.landmarks.size(); ++i) {
      if (moved.landmarks[i].on_soft != s) continue;
      GeneratedLandmark& landmark = grown.landmarks[i];
      landmark.p_W = on_skin(anatomy, anatomy.landmarks[i], skin, landmark.p_W);
      const Vec3 out = slope(skin, landmark.p_W, kAbout_m);
      if (out.norm() > 0) landmark.inwards_W = -out.normalized();
    }
  }
}

}  // namespace osteon
