#include "osteon/scene/survey.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "osteon/base/random.h"
#include "osteon/base/turn.h"

namespace osteon {
namespace {

constexpr int kCandidatesPerBone = 240;
constexpr double kClearance = 0.0015;    // m, between the tip's way and other bones
constexpr double kTransitSpeed = 0.15;   // m/s, in free air
constexpr double kApproachSpeed = 0.04;  // m/s, the last way to the surface
constexpr double kSlowZone = 0.015;      // m above the surface from which the approach is slow
constexpr double kPressTime = 0.35;      // s, to build the force up and to let it go
constexpr double kStrokeStep = 0.0005;   // m between samples on the surface
constexpr double kFlattest = 0.8;        // cosine between a stroke's ends and its middle
constexpr double kHighestStep = 0.006;   // m that a stroke may climb or fall

// A place to touch: a point of the bone's surface, its normal, and the stroke over it.
struct Site {
  Vec3 p_W;
  Vec3 n_W;
  std::vector<Vec3> stroke_p_W;
  std::vector<Vec3> stroke_n_W;
};

struct RayHit {
  double enter = 0;
  Vec3 n;
};

// First point where p + s u (s >= 0) enters the planes of `hull` moved outwards by `grow`.
std::optional<RayHit> enter_hull(const Hull& hull, const Vec3& p, const Vec3& u, double grow) {
  double enter = 0;
  double leave = std::numeric_limits<double>::infinity();
  Vec3 n = -u;
  for (const Plane& plane : hull.planes) {
    const double slope = plane.n.dot(u);
    const double height = plane.signed_distance(p) - grow;
    if (slope == 0) {
      if (height > 0) return std::nullopt;
      continue;
    }
    const double s = -height / slope;
    if (slope < 0 && s > enter) {
      enter = s;
      n = plane.n;
    }
    if (slope > 0) leave = std::min(leave, s);
    if (enter > leave) return std::nullopt;
  }
  return RayHit{enter, n};
}

std::optional<RayHit> enter_bone(const Bone& bone, const Vec3& p_W, const Vec3& u_W, double grow) {
  const Pose X_BW = bone.X_WB.inverse();
  const Vec3 p_B = X_BW * p_W;
  const Vec3 u_B = X_BW.rotate(u_W);
  std::optional<RayHit> first;
  for (const Hull& piece : bone.pieces) {
    const auto hit = enter_hull(piece, p_B, u_B, grow);
    if (hit && (!first || hit->enter < first->enter)) first = hit;
  }
  if (first) first->n = bone.X_WB.rotate(first->n);
  return first;
}

class Surveyor {
 public:
  Surveyor(const Case& the_case, const Tool& tool, const SurveyOptions& options)
      : case_(the_case), tool_(tool), options_(options), random_(options.seed) {
    const Aabb box = the_case.bounds_W();
    center_W_ = box.center();
    radius_ = 0.5 * box.extent().norm() + 0.03;
  }

  Survey run() {
    for (std::size_t i = 0; i < case_.bones.size(); ++i) {
      const auto site = best_site(i);
      if (!site) {
        survey_.unreachable.push_back(case_.bones[i].name);
        continue;
      }
      survey_.visited.push_back(case_.bones[i].name);
      visit(*site);
    }
    return std::move(survey_);
  }

 private:
  // Best of a fixed number of random places: reachable, with the flattest and longest stroke.
  std::optional<Site> best_site(std::size_t bone_index) {
    std::optional<Site> best;
    double best_score = -1;
    for (int k = 0; k < kCandidatesPerBone; ++k) {
      auto site = random_site(case_.bones[bone_index]);
      if (!site || !approach_is_free(bone_index, site->p_W, site->n_W)) continue;
      const double score = lay_stroke(bone_index, *site);
      if (score > best_score) {
        best_score = score;
        best = std::move(site);
      }
    }
    return best;
  }

  // A point on one of the bone's pieces, uniform over its triangles' area.
  std::optional<Site> random_site(const Bone& bone) {
    const std::size_t which = random_.next() % bone.pieces.size();
    const Hull& piece = bone.pieces[which];
    double total = 0;
    for (const Triangle& t : piece.triangles) total += twice_area(piece, t);
    double wanted = random_.uniform() * total;
    double a = random_.uniform();
    double b = random_.uniform();
    if (a + b > 1) {
      a = 1 - a;
      b = 1 - b;
    }
    for (std::size_t i = 0; i < piece.triangles.size(); ++i) {
      const Triangle& t = piece.triangles[i];
      wanted -= twice_area(piece, t);
      if (wanted > 0 && i + 1 < piece.triangles.size()) continue;
      const Vec3& v0 = piece.vertices[t[0]];
      const Vec3 p_B = v0 + a * (piece.vertices[t[1]] - v0) + b * (piece.vertices[t[2]] - v0);
      return Site{bone.X_WB * p_B, bone.X_WB.rotate(piece.planes[piece.plane_of[i]].n), {}, {}};
    }
    return std::nullopt;
  }

  static double twice_area(const Hull& h, const Triangle& t) {
    return (h.vertices[t[1]] - h.vertices[t[0]]).cross(h.vertices[t[2]] - h.vertices[t[0]]).norm();
  }

  // No bone stands between the outside and the place, nor beside the way.
  bool approach_is_free(std::size_t bone_index, const Vec3& p_W, const Vec3& n_W) const {
    const Vec3 tip_W = p_W + n_W * (tool_.tip_radius_m + 1e-4);
    for (std::size_t j = 0; j < case_.bones.size(); ++j) {
      const double grow =
          j == bone_index ? tool_.tip_radius_m * 0.5 : tool_.tip_radius_m + kClearance;
      if (enter_bone(case_.bones[j], tip_W, n_W, grow)) return false;
    }
    return true;
  }

  // Lays the stroke over the surface, as long as it stays on the bone, free and gentle. Returns a
  // score: its length less its rise and fall.
  double lay_stroke(std::size_t bone_index, Site& site) {
    const Vec3 u = tangent(case_.bones[bone_index], site.n_W);
    const int half = static_cast<int>(std::lround(options_.stroke_m / 2 / kStrokeStep));
    int first = 0;
    int last = 0;
    while (first > -half && surface_point(bone_index, site, u, first - 1)) --first;
    while (last < half && surface_point(bone_index, site, u, last + 1)) ++last;
    double lowest = 0;
    for (int s = first; s <= last; ++s) {
      const auto at = surface_point(bone_index, site, u, s);
      if (!at) continue;
      site.stroke_p_W.push_back(at->first);
      site.stroke_n_W.push_back(at->second);
      lowest = std::min(lowest, (at->first - site.p_W).dot(site.n_W));
    }
    return (last - first) * kStrokeStep + lowest;
  }

  std::optional<std::pair<Vec3, Vec3>> surface_point(std::size_t bone_index, const Site& site,
                                                     const Vec3& u, int step) const {
    const Vec3 above = site.p_W + u * (step * kStrokeStep) + site.n_W * kHighestStep;
    const auto hit = enter_bone(case_.bones[bone_index], above, -site.n_W, 0);
    if (!hit || hit->enter <= 0 || hit->enter > 2 * kHighestStep) return std::nullopt;
    if (hit->n.dot(site.n_W) < kFlattest) return std::nullopt;
    const Vec3 p_W = above - site.n_W * hit->enter;
    if (!approach_is_free(bone_index, p_W, site.n_W)) return std::nullopt;
    return std::make_pair(p_W, hit->n);
  }

  // Direction in the tangent plane along which the bone is longest.
  static Vec3 tangent(const Bone& bone, const Vec3& n_W) {
    const Vec3 any = std::abs(n_W.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY();
    const Vec3 e1 = n_W.cross(any).normalized();
    const Vec3 e2 = n_W.cross(e1);
    Vec3 best = e1;
    double longest = 0;
    constexpr int kDirections = 8;
    for (int k = 0; k < kDirections; ++k) {
      // Half-circle directions without trigonometry: points of a square, then unit length.
      const double f = 2.0 * k / kDirections;
      const Vec3 u =
          (f <= 1 ? Vec3(e1 + (2 * f - 1) * e2) : Vec3((3 - 2 * f) * e1 + e2)).normalized();
      double lo = std::numeric_limits<double>::infinity();
      double hi = -lo;
      for (const Hull& piece : bone.pieces)
        for (const Vec3& v : piece.vertices) {
          const double x = u.dot(bone.X_WB.rotate(v));
          lo = std::min(lo, x);
          hi = std::max(hi, x);
        }
      if (hi - lo > longest) {
        longest = hi - lo;
        best = u;
      }
    }
    return best;
  }

  void visit(const Site& site) {
    const Vec3& p0 = site.stroke_p_W.front();
    const Vec3& n0 = site.stroke_n_W.front();
    const Vec3& n = site.n_W;
    const Quat q = turn_between(Vec3::UnitZ(), n);
    const Vec3 touch = p0 + n0 * tool_.tip_radius_m;
    travel_to(outside(touch, n), q);
    line_to(touch + n * kSlowZone, q, kTransitSpeed);
    line_to(touch + n * 5e-4, q, kApproachSpeed);
    hold_to(pressed(p0, n0), q, kPressTime);
    hold_to(pressed(p0, n0), q, kPressTime);
    for (std::size_t i = 1; i < site.stroke_p_W.size(); ++i)
      line_to(pressed(site.stroke_p_W[i], site.stroke_n_W[i]), q, options_.speed_m_per_s);
    const Vec3 end = site.stroke_p_W.back() + site.stroke_n_W.back() * tool_.tip_radius_m;
    hold_to(end + n * 1e-3, q, kPressTime);
    line_to(end + n * kSlowZone, q, kApproachSpeed);
    line_to(outside(end, n), q, kTransitSpeed);
  }

  // Where the hand must aim so that coupling and grip, in series, give the wanted force.
  Vec3 pressed(const Vec3& p_W, const Vec3& n_W) const {
    const double depth = options_.press_n / options_.stiffness_n_per_m +
                         options_.press_n / options_.hand_stiffness_n_per_m;
    return p_W + n_W * (tool_.tip_radius_m - depth);
  }

  // Where the line from p along n leaves the ball around the case.
  Vec3 outside(const Vec3& p_W, const Vec3& n_W) const {
    const Vec3 r = p_W - center_W_;
    const double b = r.dot(n_W);
    const double c = r.squaredNorm() - radius_ * radius_;
    return p_W + n_W * (-b + std::sqrt(std::max(0.0, b * b - c)));
  }

  // Along the ball around the case, clear of every bone.
  void travel_to(const Vec3& goal_W, const Quat& q) {
    if (survey_.path.samples.empty()) {
      survey_.path.samples.push_back({0, Pose{goal_W, q}, false});
      return;
    }
    const Vec3 from = (survey_.path.samples.back().X_WD.p - center_W_).normalized();
    const Vec3 to = (goal_W - center_W_).normalized();
    const Quat q0 = survey_.path.samples.back().X_WD.q;
    constexpr int kSteps = 24;
    Vec3 side = from.cross(to);
    const bool opposite = side.norm() < 1e-6 && from.dot(to) < 0;
    if (opposite) side = from.cross(std::abs(from.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY());
    for (int i = 1; i <= kSteps; ++i) {
      const double f = static_cast<double>(i) / kSteps;
      Vec3 d = (1 - f) * from + f * to;
      if (opposite) d += std::min(f, 1 - f) * side.normalized().cross(from).normalized();
      if (d.norm() < 0.2) d += side.normalized().cross(from) * 0.5;
      line_to(center_W_ + d.normalized() * radius_, q0.slerp(f, q), kTransitSpeed);
    }
    line_to(goal_W, q, kTransitSpeed);
  }

  void line_to(const Vec3& p_W, const Quat& q, double speed) {
    const double way = (p_W - survey_.path.samples.back().X_WD.p).norm();
    hold_to(p_W, q, std::max(way / speed, 1e-3));
  }

  void hold_to(const Vec3& p_W, const Quat& q, double seconds) {
    survey_.path.samples.push_back(
        {survey_.path.samples.back().time_s + seconds, Pose{p_W, q}, false});
  }

  const Case& case_;
  const Tool& tool_;
  SurveyOptions options_;
  Random random_;
  Vec3 center_W_;
  double radius_ = 0;
  Survey survey_;
};

}  // namespace

Survey make_survey(const Case& the_case, const Tool& tool, const SurveyOptions& options) {
  return Surveyor(the_case, tool, options).run();
}

}  // namespace osteon
