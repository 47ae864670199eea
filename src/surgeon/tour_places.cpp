#include <algorithm>
#include <cmath>
#include <numbers>

#include "osteon/base/random.h"
#include "osteon/base/turn.h"
#include "osteon/scene/portal.h"
#include "osteon/surgeon/approach.h"
#include "osteon/surgeon/tour_surgeon.h"

namespace osteon {
namespace {

constexpr double kTourRoomWanted_m = 0.0008;  // about a shaft; with more a place is no better
constexpr double kTourRoomNeeded_m = 0.00025;
// How far friction of the skin may hold a tip back, and how far from the middle of the half field a
// mark may be: where no place bears so much, places that bear less are looked at.
struct LookLimits {
  double strayed_m, off_share;
  int turns;
};
constexpr LookLimits kLooks[] = {{0.0008, 0.42, 24}, {0.0004, 0.45, 48}, {0.0002, 0.47, 72}};
constexpr double kAside_m = 0.0006;  // a tip that comes in so far aside shall meet the same bone
constexpr double kTourOutside_m = 0.060;  // so far beyond the portal the shaft is looked after
constexpr double kLeastRise = 0.3;  // of the shaft's direction outwards: handles stay over skin
constexpr double kLeastInwards = 0.25;
constexpr double kSquare = 0.65;  // least cosine between push and normal
// What it counts beside that cosine that a tip which comes in aside meets the same bone.
constexpr double kMeetsAsWell = 0.6;
constexpr double kHandle_m = 0.074;
constexpr double kHandlesApart_m = 0.019, kShaftsApart_m = 0.004;

// Gaps to the bones at rest; one that lies farther off than another is not looked at.
class TourAround {
 public:
  explicit TourAround(const Case& the_case) : case_(the_case) {
    for (const Bone& bone : the_case.bones) {
      Aabb box;
      for (const Hull& piece : bone.pieces)
        for (const Vec3& v : piece.vertices) box.include(bone.X_WB * v);
      balls_.push_back({box.center(), 0.5 * box.extent().norm()});
    }
  }
  /// No more than `most_m`.
  double gap(const Vec3& p_W, double most_m) const {
    for (std::size_t i = 0; i < balls_.size(); ++i)
      if ((p_W - balls_[i].center_W).norm() - balls_[i].radius_m < most_m)
        most_m = std::min(most_m, gap_to(case_.bones[i], p_W));
    return most_m;
  }
  /// Whether a ball there meets this bone, and none of the others.
  enum class Met { kNone, kIt, kAnother };
  Met met(const Vec3& p_W, double radius_m, std::uint32_t bone) const {
    if (gap(p_W, radius_m) >= radius_m) return Met::kNone;
    return gap_to(case_.bones[bone], p_W) < radius_m ? Met::kIt : Met::kAnother;
  }

 private:
  const Case& case_;
  std::vector<Surroundings> balls_;
};

Vec3 inwards_at(const Case& the_case, const Vec3& portal_W) {
  for (const Portal& portal : find_portals(the_case))
    if ((portal.p_W - portal_W).norm() < 1e-9) return portal.nhat_W;
  return -Vec3::UnitZ();
}

bool leans_well(const Quat& q, const Vec3& inwards_W) {
  const Vec3 back = q * Vec3(Vec3::UnitZ());
  return back.z() > kLeastRise && back.dot(inwards_W) < -kLeastInwards;
}

// Room about the shaft from the tip to well outside.
double room_about(const TourAround& around, const TourPlace& place, const TourTool& tool,
                  double from_m) {
  constexpr double kMost_m = 0.005;  // more room is no better
  const Vec3 back = place.q * Vec3(Vec3::UnitZ());
  const Vec3 axis_W = place.portal_W - place.depth_m * back;
  double room = kMost_m;
  for (double along = from_m; along < place.depth_m + kTourOutside_m; along += 0.0015) {
    const Vec3 p_W = axis_W + along * back;
    room = std::min(room, around.gap(p_W, room + tool.shaft_radius_m) - tool.shaft_radius_m);
    if (room < kTourRoomNeeded_m) break;
  }
  return room;
}

bool sees(const Case& the_case, const ScopeOptics& optics, const Pose& pose, const TourGaze& gaze,
          const LookLimits& limits) {
  const BoneSnapshot rest;  // of no bones: where each is at rest
  const ScopeView view = view_through(optics, pose);
  for (int k = 0; k < 7; ++k) {
    Vec3 eye_W = pose.p;
    if (k > 0) eye_W[(k - 1) / 2] += k % 2 ? limits.strayed_m : -limits.strayed_m;
    const Vec3 way = gaze.at_W - eye_W;
    const double off = std::acos(std::clamp(way.normalized().dot(view.along_W), -1.0, 1.0));
    if (off > limits.off_share * optics.half_field_rad || way.norm() < gaze.near_m ||
        way.norm() > gaze.far_m || is_hidden(the_case, rest, eye_W, gaze.at_W))
      return false;
  }
  return true;
}

struct Spot {
  Vec3 p_W, n_W;
};
// A place on one of the bone's pieces that lies on the outside of them all.
std::optional<Spot> spot_on(const Bone& bone, Random& random) {
  const Hull& piece = bone.pieces[random.next() % bone.pieces.size()];
  const std::size_t facet = random.next() % piece.triangles.size();
  const Triangle& t = piece.triangles[facet];
  double a = random.uniform(), b = random.uniform();
  if (a + b > 1) {
    a = 1 - a;
    b = 1 - b;
  }
  const Vec3& v0 = piece.vertices[t[0]];
  const Vec3 p_B = v0 + a * (piece.vertices[t[1]] - v0) + b * (piece.vertices[t[2]] - v0);
  const Spot spot{bone.X_WB * p_B, bone.X_WB.rotate(piece.planes[piece.plane_of[facet]].n)};
  if (gap_to(bone, spot.p_W + 0.001 * spot.n_W) < 0.0008) return std::nullopt;
  return spot;
}

// Shaft through the portal with the tip at p_W: both ends of a right-angled triangle are known.
std::optional<TourPlace> place_for_tip(const TourTool& tool, const Vec3& portal_W, const Vec3& p_W,
                                       double turn_rad) {
  const Vec3 to = portal_W - p_W;
  const double far = to.norm(), aside = tool.offset_T.norm();
  if (far <= aside + 0.002) return std::nullopt;
  const double depth = std::sqrt(far * far - aside * aside);
  const Vec3 own = (tool.offset_T + depth * Vec3::UnitZ()) / far;
  const Eigen::AngleAxisd turned(turn_rad, to / far);
  const Eigen::Quaterniond least(turn_between(own, to / far));
  return TourPlace{portal_W, Quat(Eigen::Quaterniond(turned) * least).normalized(), depth};
}

// Whether the tip comes in along the shaft without meeting anything, and what reaches from it to
// the shaft neither.
bool way_in_is_free(const TourAround& around, const TourTool& tool, const TourPlace& place) {
  const Pose pose = pose_at(place, tool);
  const Vec3 back = pose.rotate(Vec3::UnitZ());
  for (double along = 0; along < place.depth_m - kTourRest_m + 0.004; along += 0.001)
    for (const double beside : {0.0, 0.5, 1.0}) {
      if (along == 0 && beside == 0) continue;
      const Vec3 p = pose.p + along * back + pose.rotate(beside * tool.offset_T);
      const double least_m = tool.tip_radius_m + (along > 0.0025 ? 0.0003 : -0.0001);
      if (around.gap(p, least_m) < least_m) return false;
    }
  return true;
}

// Comes in along the shaft until the tip, or what reaches from it to the shaft, meets a bone.
// Whether that is this bone, and the shaft behind leans on none.
bool meets_alone(const TourAround& around, const TourTool& tool, const Pose& pose,
                 std::uint32_t bone) {
  constexpr double kBefore_m = 0.003, kBeyond_m = 0.003, kStride_m = 0.0003;
  constexpr double kShaftFrom_m = 0.0025, kShaftTo_m = 0.012, kShaftStride_m = 0.0015;
  const Vec3 back = pose.rotate(Vec3::UnitZ()), offset_W = pose.rotate(tool.offset_T);
  for (double along = kBefore_m; along > -kBeyond_m; along -= kStride_m) {
    const Vec3 tip_W = pose.p + along * back;
    bool is_there = false;
    for (const double beside : {0.0, 0.5, 1.0}) {
      const auto met = around.met(tip_W + beside * offset_W, tool.tip_radius_m, bone);
      if (met == TourAround::Met::kAnother) return false;
      is_there = is_there || met == TourAround::Met::kIt;
    }
    if (!is_there) continue;
    for (double up = kShaftFrom_m; up < kShaftTo_m; up += kShaftStride_m)
      if (around.gap(tip_W + offset_W + up * back, tool.shaft_radius_m) < tool.shaft_radius_m)
        return false;
    return true;
  }
  return false;
}

// Of tools that come in a little aside, the share that meets the bone and nothing else.
double share_that_meets(const TourAround& around, const TourTool& tool, const TourPlace& place,
                        std::uint32_t bone) {
  constexpr int kAsides = 6;
  const Pose pose = pose_at(place, tool);
  const Vec3 back = pose.rotate(Vec3::UnitZ()), e1 = back.unitOrthogonal(), e2 = back.cross(e1);
  int meets = 0;
  for (int k = 0; k < kAsides; ++k) {
    const double a = 2 * std::numbers::pi * k / kAsides;
    Pose aside = pose;
    aside.p += kAside_m * (std::cos(a) * e1 + std::sin(a) * e2);
    meets += meets_alone(around, tool, aside, bone) ? 1 : 0;
  }
  return static_cast<double>(meets) / kAsides;
}

bool clear_of_all(const TourPlace& place, const std::vector<TourPlace>& others) {
  return std::all_of(others.begin(), others.end(),
                     [&](const TourPlace& other) { return clear_of(place, other); });
}

}  // namespace

// Apart below, and farther where their handles are.
bool clear_of(const TourPlace& a, const TourPlace& b) {
  const Vec3 ua = a.q * Vec3(Vec3::UnitZ()), ub = b.q * Vec3(Vec3::UnitZ());
  const Vec3 pa = a.portal_W - a.depth_m * ua, pb = b.portal_W - b.depth_m * ub;
  for (double s = 0; s < 0.14; s += 0.007)
    for (double t = 0; t < 0.14; t += 0.007) {
      const double apart = std::max(s, t) > kHandle_m ? kHandlesApart_m : kShaftsApart_m;
      if ((pa + s * ua - pb - t * ub).norm() < apart) return false;
    }
  return true;
}

Pose pose_at(const TourPlace& place, const TourTool& tool) {
  Pose pose{place.portal_W, place.q};
  pose.p -= pose.rotate(tool.offset_T + place.depth_m * Vec3::UnitZ());
  return pose;
}

namespace {

std::optional<TourPlace> find_look_within(const Case& the_case, const TourTool& tool,
                                          const Vec3& portal_W, const TourGaze& gaze,
                                          const LookLimits& limits) {
  const Vec3 inwards_W = inwards_at(the_case, portal_W);
  const TourAround around(the_case);
  std::optional<TourPlace> best;
  double best_room = 0;
  for (double d = gaze.near_m + 0.0015; d < gaze.far_m - 0.001; d += 0.001)
    for (int turn = 0; turn < limits.turns; ++turn) {
      const double angle =
          (turn % 2 ? 1 : -1) * ((turn + 1) / 2) * 2 * std::numbers::pi / limits.turns;
      const auto pose = pose_for({gaze.at_W, d, angle}, portal_W, *tool.optics);
      if (!pose || !leans_well(pose->q, inwards_W)) continue;
      const TourPlace place{portal_W, pose->q, (portal_W - pose->p).norm()};
      if (place.depth_m < kTourRest_m || !sees(the_case, *tool.optics, *pose, gaze, limits))
        continue;
      const double room = room_about(around, place, tool, tool.shaft_radius_m);
      if (room <= std::max(best_room, kTourRoomNeeded_m)) continue;
      best = place;
      best_room = room;
      if (room > kTourRoomWanted_m) return best;
    }
  return best;
}

}  // namespace

std::optional<TourPlace> find_look(const Case& the_case, const TourTool& tool, const Vec3& portal_W,
                                   const TourGaze& gaze) {
  for (const LookLimits& limits : kLooks)
    if (const auto found = find_look_within(the_case, tool, portal_W, gaze, limits)) return found;
  return std::nullopt;
}

std::optional<TourPlace> find_touch(const Case& the_case, const TourTool& tool,
                                    const Vec3& portal_W, std::uint32_t bone,
                                    const TourPlace* other, std::uint64_t seed) {
  constexpr int kSpots = 15000, kTurns = 16;
  const Vec3 inwards_W = inwards_at(the_case, portal_W);
  const TourAround around(the_case);
  Random random(seed * 1000003 + bone);
  std::optional<TourPlace> best;
  double best_score = 0;
  for (int k = 0; k < kSpots; ++k) {
    const auto spot = spot_on(the_case.bones[bone], random);
    if (!spot || (spot->p_W - portal_W).norm() > 0.03) continue;
    const Vec3 tip_W = spot->p_W + spot->n_W * tool.tip_radius_m;
    if ((portal_W - tip_W).normalized().dot(spot->n_W) < kSquare - 0.15) continue;
    for (int turn = 0; turn < kTurns; ++turn) {
      const auto place = place_for_tip(tool, portal_W, tip_W, 2 * std::numbers::pi * turn / kTurns);
      if (!place || place->depth_m < kTourRest_m || !leans_well(place->q, inwards_W)) continue;
      const double square = (place->q * Vec3(Vec3::UnitZ())).dot(spot->n_W);
      if (square <= kSquare || square + kMeetsAsWell <= best_score) continue;
      if (other && !clear_of(*place, *other)) continue;
      if (!way_in_is_free(around, tool, *place)) continue;
      if (room_about(around, *place, tool, 0.0018 + tool.shaft_radius_m) < kTourRoomNeeded_m)
        continue;
      const double score = square + kMeetsAsWell * share_that_meets(around, tool, *place, bone);
      if (score <= best_score) continue;
      best = place;
      best_score = score;
    }
    if (best_score > 0.9 + kMeetsAsWell) break;
  }
  return best;
}

TourPlace place_between(const TourPlace& from, const TourPlace& to, double lift_m, double share) {
  constexpr double kUp = 0.3;  // of the whole way; as much in again
  const double f = lift_m > 0 ? std::clamp((share - kUp) / (1 - 2 * kUp), 0.0, 1.0)
                              : std::clamp(share, 0.0, 1.0);
  const auto beyond = [](const TourPlace& end) { return std::max(0.0, -end.depth_m - kTourOut_m); };
  const double out = std::max({lift_m * std::min({1.0, share / kUp, (1 - share) / kUp}),
                               beyond(from) * (1 - share), beyond(to) * share});
  TourPlace place = from;
  place.depth_m = -kTourOut_m - out;
  // Between two portals the place is of neither: its portal is the point that it turns about.
  place.portal_W = from.portal_W + f * (to.portal_W - from.portal_W) +
                   Vec3(0, 0, lift_m > 0 ? 0 : 4 * f * (1 - f) * kTourOut_m);
  place.q = from.q.slerp(f, to.q);
  return place;
}

std::optional<double> lift_over(const TourPlace& from, const TourPlace& to,
                                const std::vector<TourPlace>& others) {
  constexpr int kSamples = 20;
  for (const double lift_m : {0.0, 0.03, 0.06, 0.09, 0.12, 0.16}) {
    bool clear = true;
    // Where it begins and where it ends are as they are.
    for (int k = 1; k < kSamples && clear; ++k)
      clear = clear_of_all(place_between(from, to, lift_m, double(k) / kSamples), others);
    if (clear) return lift_m;
  }
  return std::nullopt;
}

TourPlace turned_clear(const Case& the_case, const TourTool& tool, const TourPlace& place,
                       const std::vector<TourPlace>& others) {
  if (clear_of_all(place, others)) return place;
  const Vec3 inwards_W = inwards_at(the_case, place.portal_W);
  const TourAround around(the_case);
  for (int turn = 1; turn < 24; ++turn) {
    const double angle = (turn % 2 ? 1 : -1) * ((turn + 1) / 2) * std::numbers::pi / 12;
    TourPlace turned = place;
    turned.q = Quat(Eigen::AngleAxisd(angle, inwards_W)) * place.q;
    if (leans_well(turned.q, inwards_W) && clear_of_all(turned, others) &&
        room_about(around, turned, tool, tool.shaft_radius_m) >= kTourRoomNeeded_m)
      return turned;
  }
  return place;
}

}  // namespace osteon
