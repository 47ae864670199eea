#include "osteon/tissue/rod.h"

#include <algorithm>
#include <cmath>

#include "rod/rod_contact.h"

namespace osteon {
namespace {

constexpr double kPi = 3.141592653589793;

// The turn that takes one unit vector to another the shortest way.
Quat shortest_turn(const Vec3& from, const Vec3& to) {
  const double w = 1 + from.dot(to);
  if (w < 1e-9) {
    Vec3 axis = from.cross(std::abs(from.x()) < 0.6 ? Vec3::UnitX() : Vec3::UnitY());
    axis.normalize();
    return {0, axis.x(), axis.y(), axis.z()};
  }
  const Vec3 v = from.cross(to);
  Quat q(w, v.x(), v.y(), v.z());
  q.normalize();
  return q;
}

double length_of(const std::vector<Vec3>& points) {
  double sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += (points[i] - points[i - 1]).norm();
  return sum;
}

Result<void> check_points(const RodDef& def) {
  if (def.points_W.size() < 2)
    return fail("'mesh.rod.points_mm' names fewer than two points", {}, "Give both ends");
  for (std::size_t i = 0; i < def.points_W.size(); ++i) {
    const std::string key = "'mesh.rod.points_mm[" + std::to_string(i) + "]'";
    if (!is_finite(def.points_W[i]))
      return fail(key + " is not three finite numbers", {}, "Give a position in mm");
    if (i > 0 && !((def.points_W[i] - def.points_W[i - 1]).norm() > 1e-9))
      return fail(key + " is the same as the point before it", {}, "Remove one of them");
  }
  return {};
}

Result<void> check_size(const RodDef& def) {
  if (!(std::isfinite(def.radius_m) && def.radius_m > 0))
    return fail("'mesh.rod.radius_mm' must be above 0", {}, "Give half the rod's thickness");
  if (def.segments < 1 || def.segments > 10000)
    return fail("'mesh.rod.segments' must lie from 1 to 10000", {}, "40 is usual");
  if (!(def.friction >= 0 && def.friction <= 10))
    return fail("'material.friction' must lie from 0 to 10", {}, "Most tissue: 0.1 to 0.4");
  const double segment_m = length_of(def.points_W) / def.segments;
  if (!(segment_m >= 0.1 * def.radius_m))
    return fail("'mesh.rod.segments' makes segments shorter than a tenth of the radius", {},
                "Use fewer segments");
  return {};
}

// Places on a polyline, equally far apart along it.
std::vector<Vec3> resampled(const std::vector<Vec3>& points, int segments) {
  const double step = length_of(points) / segments;
  std::vector<Vec3> out{points.front()};
  std::size_t k = 1;
  double before = 0, piece = (points[1] - points[0]).norm();
  for (int i = 1; i < segments; ++i) {
    while (i * step > before + piece && k + 1 < points.size()) {
      before += piece;
      ++k;
      piece = (points[k] - points[k - 1]).norm();
    }
    const double share = std::min((i * step - before) / piece, 1.0);
    out.push_back(points[k - 1] + share * (points[k] - points[k - 1]));
  }
  out.push_back(points.back());
  return out;
}

// Frames carried along without twist (parallel transport).
std::vector<Quat> frames_along(const std::vector<Vec3>& nodes) {
  std::vector<Quat> out;
  Vec3 before = Vec3::UnitZ();
  Quat q = Quat::Identity();
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    const Vec3 along = (nodes[i + 1] - nodes[i]).normalized();
    q = shortest_turn(before, along) * q;
    q.normalize();
    out.push_back(q);
    before = along;
  }
  return out;
}

// Shear coefficient of Cowper (1966) for a round section.
RodSection section_of(const SolidMaterial& material, double radius_m) {
  const double nu = material.poisson, shear = shear_modulus_pa(material);
  const double area = kPi * radius_m * radius_m, second = 0.25 * area * radius_m * radius_m;
  const double k = 6 * (1 + nu) / (7 + 6 * nu);
  return {material.young_pa * area, k * shear * area, material.young_pa * second,
          shear * 2 * second};
}

void measure(Rod& rod, bool straight) {
  const std::size_t n = rod.start_R_WS.size();
  const double mass_per_m = rod.material.density_kg_per_m3 * kPi * rod.radius_m * rod.radius_m;
  rod.mass_kg.assign(n + 1, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const double l = (rod.start_W[i + 1] - rod.start_W[i]).norm();
    rod.length_m.push_back(l);
    rod.mass_kg[i] += 0.5 * mass_per_m * l;
    rod.mass_kg[i + 1] += 0.5 * mass_per_m * l;
  }
  for (std::size_t i = 0; i + 1 < n; ++i)
    rod.rest_turn.push_back(straight
                                ? Vec3(Vec3::Zero())
                                : rods::turn_between(rod.start_R_WS[i], rod.start_R_WS[i + 1]));
}

Result<void> check_shape(const Rod& rod) {
  for (std::size_t i = 0; i < rod.segments(); ++i)
    if (!(rod.length_m[i] > 1e-3 * rod.radius_m))
      return fail("'mesh.rod.points_mm' turn back on themselves at segment " + std::to_string(i),
                  {}, "Use more segments, or a smoother line");
  return {};
}

}  // namespace

Result<Rod> make_rod(const RodDef& def) {
  if (auto sound = check_material(def.material); !sound) return tl::unexpected(sound.error());
  if (auto sound = check_points(def); !sound) return tl::unexpected(sound.error());
  if (auto sound = check_size(def); !sound) return tl::unexpected(sound.error());
  Rod rod;
  rod.material = def.material;
  rod.radius_m = def.radius_m;
  rod.friction = def.friction;
  rod.section = section_of(def.material, def.radius_m);
  rod.start_W = resampled(def.points_W, def.segments);
  rod.start_R_WS = frames_along(rod.start_W);
  measure(rod, def.straight_at_rest);
  if (auto sound = check_shape(rod); !sound) return tl::unexpected(sound.error());
  if (const auto crossed = rods::passes_through_itself(rod))
    return fail("'mesh.rod.points_mm': the rod passes through itself near segments " +
                    std::to_string(crossed->sample) + " and " + std::to_string(crossed->other),
                {}, "Move its parts at least a diameter apart, or make it thinner");
  return rod;
}

}  // namespace osteon
