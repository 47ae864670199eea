#include "osteon/scene/placing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "graft_form.h"
#include "osteon/scene/case.h"
#include "osteon/scene/graft.h"
#include "osteon/scene/state.h"

namespace osteon {
namespace {

constexpr double kBesideWall_m = 0.001;
constexpr double kThreadOut_m = 0.120;  // so much of the thread is seen beyond the femur

// Eight directions and their opposites, of equal steps: cos and sin by halves of the right angle.
std::array<Vec3, 16> about(const Vec3& axis) {
  const Vec3 helper = std::abs(axis.z()) < 0.8 ? Vec3(Vec3::UnitZ()) : Vec3(Vec3::UnitX());
  const Vec3 u = axis.cross(helper).normalized(), v = axis.cross(u);
  const double half = std::sqrt(0.5), long_ = std::sqrt(0.5 * (1 + half)),
               short_ = std::sqrt(0.5 * (1 - half));
  const double c[] = {1, long_, half, short_}, s[] = {0, short_, half, long_};
  std::array<Vec3, 16> out;
  for (std::size_t i = 0; i < 4; ++i) {
    out[i] = c[i] * u + s[i] * v;
    out[4 + i] = c[i] * v - s[i] * u;
    out[8 + i] = -out[i];
    out[12 + i] = -out[4 + i];
  }
  return out;
}

// Where a ray enters a triangle's plane within it; infinity: it misses (Moeller and Trumbore 1997).
double along_ray(const Vec3& p, const Vec3& d, const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double kMiss = std::numeric_limits<double>::infinity();
  const Vec3 e1 = b - a, e2 = c - a, h = d.cross(e2);
  const double det = e1.dot(h);
  if (det == 0) return kMiss;
  const Vec3 s = p - a, q = s.cross(e1);
  const double u = s.dot(h) / det, v = d.dot(q) / det;
  // A line that meets an edge meets one of its triangles whatever rounding says.
  constexpr double kEdge = 1e-9;
  if (u < -kEdge || v < -kEdge || u + v > 1 + kEdge) return kMiss;
  return e2.dot(q) / det;
}

// The first place at which a line beside the tunnel meets the bone, from `from_B` on, within `far`.
double first_bone(const TriMesh& mesh, const Vec3& from_B, const Vec3& along_B, double far) {
  double best = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles) {
    const double s =
        along_ray(from_B, along_B, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
    if (s >= 0 && s < best) best = s;
  }
  return best <= far ? best : std::numeric_limits<double>::infinity();
}

// How far from `from_B` the bone's surface crosses the axis of a hole in it; none: it does not.
std::optional<double> mouth_after(const TriMesh& mesh, const Vec3& from_B, const Vec3& along_B,
                                  double radius_m, double far) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const Vec3& aside : about(along_B)) {
    const double s = first_bone(mesh, from_B + (radius_m + kBesideWall_m) * aside, along_B, far);
    if (!std::isfinite(s)) continue;
    least = std::min(least, s);
    most = std::max(most, s);
  }
  if (!std::isfinite(least)) return std::nullopt;
  return 0.5 * (least + most);
}

// A tunnel whose axis runs from the joint to the outside between two places beyond its mouths.
std::optional<PlacingTunnel> tunnel_of(const Case& the_case, BoneId bone, const Vec3& joint_W,
                                       const Vec3& outside_W, double mouth_radius_m,
                                       double outer_radius_m) {
  const Bone& in = the_case.bone(bone);
  const Pose X_BW = in.X_WB.inverse();
  const Vec3 a = X_BW * joint_W, b = X_BW * outside_W;
  const double way = (b - a).norm();
  if (!(way > 0.001)) return std::nullopt;
  const Vec3 along = (b - a) / way;
  const auto mouth = mouth_after(in.mesh, a, along, mouth_radius_m, way);
  const auto outer = mouth_after(in.mesh, b, -along, outer_radius_m, way);
  if (!mouth || !outer || !(way - *outer - *mouth > 0.005)) return std::nullopt;
  return PlacingTunnel{bone.index, a + *mouth * along, b - *outer * along, mouth_radius_m};
}

double turn_at(const Vec3& from, const Vec3& to) {
  return std::acos(std::clamp(from.normalized().dot(to.normalized()), -1.0, 1.0));
}

std::optional<PlacingPlan> with_graft(const Case& the_case, const PlacingTunnel& f,
                                      const PlacingTunnel& t, double socket_m,
                                      const PlacingGraft& graft) {
  const Pose &X_WF = the_case.bones[f.bone].X_WB, &X_WT = the_case.bones[t.bone].X_WB;
  const Vec3 f_in = X_WF * f.mouth_B, f_out = X_WF * f.outer_B;
  const Vec3 t_in = X_WT * t.mouth_B, t_out = X_WT * t.outer_B;
  PlacingPlan plan;
  plan.femur = f;
  plan.tibia = t;
  plan.socket_m = socket_m;
  plan.between_m = (f_in - t_in).norm();
  plan.tibia_bend_rad = turn_at(t_in - t_out, f_in - t_in);
  plan.femur_bend_rad = turn_at(f_in - t_in, f_out - f_in);
  plan.graft_m = graft.diameter_m > 0 ? graft.diameter_m : 2 * std::min(f.radius_m, t.radius_m);
  plan.graft_length_m = graft.length_m;
  plan.loop_m = graft.loop_m > 0 ? graft.loop_m : loop_for(f.length_m(), socket_m);
  if (!(plan.loop_m > 0)) return std::nullopt;
  return plan;
}

// Both holes run from the end that lies nearer to the other one.
struct HoleEnds {
  struct In {
    std::uint32_t bone;
    Vec3 from_B, to_B;
    double radius_m;
  };
  In femur, tibia;
};
std::optional<HoleEnds> nearest_ends(const Case& the_case, const PlacingHole& socket,
                                     const PlacingHole& tibia) {
  const BoneId f = the_case.find("femur"), t = the_case.find("tibia");
  if (!f.valid() || !t.valid()) return std::nullopt;
  const Pose &X_WF = the_case.bone(f).X_WB, &X_WT = the_case.bone(t).X_WB;
  HoleEnds out{{f.index, socket.from_B, socket.to_B, 0.5 * socket.diameter_m},
               {t.index, tibia.from_B, tibia.to_B, 0.5 * tibia.diameter_m}};
  const auto apart = [&](const Vec3& in_F, const Vec3& in_T) {
    return (X_WF * in_F - X_WT * in_T).norm();
  };
  const double f0 = std::min(apart(socket.from_B, tibia.from_B), apart(socket.from_B, tibia.to_B));
  const double f1 = std::min(apart(socket.to_B, tibia.from_B), apart(socket.to_B, tibia.to_B));
  if (f1 < f0) std::swap(out.femur.from_B, out.femur.to_B);
  if (apart(out.femur.from_B, tibia.to_B) < apart(out.femur.from_B, tibia.from_B))
    std::swap(out.tibia.from_B, out.tibia.to_B);
  return out;
}

// From the middle of a hole's wall to where its axis leaves the whole bone, both ways.
std::optional<PlacingTunnel> tunnel_through(const Case& the_case, const HoleEnds::In& hole) {
  constexpr double kFar_m = 0.2;
  const TriMesh& mesh = the_case.bones[hole.bone].mesh;
  const Vec3 way = hole.to_B - hole.from_B, middle = hole.from_B + 0.5 * way;
  if (!(way.norm() > 0.001 && hole.radius_m > 0)) return std::nullopt;
  const Vec3 along = way.normalized();
  const double in = first_bone(mesh, middle, -along, kFar_m);
  const double out = first_bone(mesh, middle, along, kFar_m);
  if (!std::isfinite(in) || !std::isfinite(out) || !(in + out > 0.005)) return std::nullopt;
  return PlacingTunnel{hole.bone, middle - in * along, middle + out * along, hole.radius_m};
}

}  // namespace

double PlacingPlan::button_out_m() const {
  return tibia.length_m() + between_m + femur.length_m() + 2 * kFlipRoom_m;
}

std::optional<PlacingPlan> find_placing(const Case& the_case) {
  const BoneId femur = the_case.find("femur"), tibia = the_case.find("tibia");
  if (!femur.valid() || !tibia.valid()) return std::nullopt;
  constexpr std::array<const char*, 7> kNames{
      "femoral_tunnel_from", "femoral_tunnel_socket", "femoral_tunnel_to", "femoral_tunnel_side",
      "tibial_tunnel_from",  "tibial_tunnel_to",      "tibial_tunnel_side"};
  std::array<Vec3, kNames.size()> at;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const auto found = std::find_if(the_case.landmarks.begin(), the_case.landmarks.end(),
                                    [&](const Landmark& l) { return l.name == kNames[i]; });
    if (found == the_case.landmarks.end()) return std::nullopt;
    at[i] = found->p_W;
  }
  const double socket_radius = (at[3] - at[0]).norm(), tibia_radius = (at[6] - at[4]).norm();
  // The channel is narrower; beside the socket's wall the cortex is met as well.
  const auto f = tunnel_of(the_case, femur, at[0], at[2], socket_radius, 0.6 * socket_radius);
  const auto t = tunnel_of(the_case, tibia, at[5], at[4], tibia_radius, tibia_radius);
  if (!f || !t) return std::nullopt;
  const Pose& X_WF = the_case.bone(femur).X_WB;
  const Vec3 f_in = X_WF * f->mouth_B, f_out = X_WF * f->outer_B;
  return with_graft(the_case, *f, *t, (at[1] - f_in).dot((f_out - f_in).normalized()), {});
}

std::optional<PlacingPlan> plan_placing(const Case& the_case, const PlacingHole& socket,
                                        const PlacingHole& tibia, const PlacingGraft& graft) {
  const auto ends = nearest_ends(the_case, socket, tibia);
  if (!ends) return std::nullopt;
  const auto f = tunnel_through(the_case, ends->femur), t = tunnel_through(the_case, ends->tibia);
  if (!f || !t) return std::nullopt;
  const Vec3 along = (f->outer_B - f->mouth_B).normalized();
  const double deep = (ends->femur.to_B - f->mouth_B).dot(along);
  if (!(deep > 0 && deep < f->length_m())) return std::nullopt;
  return with_graft(the_case, *f, *t, deep, graft);
}

PlacingNumbers placing_numbers(const PlacingPlan& plan) {
  PlacingNumbers out{};
  std::size_t n = 0;
  for (const PlacingTunnel* tunnel : {&plan.femur, &plan.tibia}) {
    for (int i = 0; i < 3; ++i) out[n++] = tunnel->mouth_B[i];
    for (int i = 0; i < 3; ++i) out[n++] = tunnel->outer_B[i];
    out[n++] = tunnel->radius_m;
  }
  for (const double x : {plan.socket_m, plan.graft_m, plan.graft_length_m, plan.loop_m})
    out[n++] = x;
  return out;
}

std::optional<PlacingPlan> plan_of_numbers(const Case& the_case, const PlacingNumbers& numbers) {
  constexpr double kMost_m = 10;
  const BoneId femur = the_case.find("femur"), tibia = the_case.find("tibia");
  if (!femur.valid() || !tibia.valid()) return std::nullopt;
  for (const double x : numbers)
    if (!(std::abs(x) < kMost_m)) return std::nullopt;
  const auto tunnel = [&](BoneId bone, std::size_t n) {
    return PlacingTunnel{bone.index,
                         {numbers[n], numbers[n + 1], numbers[n + 2]},
                         {numbers[n + 3], numbers[n + 4], numbers[n + 5]},
                         numbers[n + 6]};
  };
  const PlacingTunnel f = tunnel(femur, 0), t = tunnel(tibia, 7);
  if (!(numbers[14] > 0 && numbers[15] > 0 && numbers[16] > 0 && numbers[17] > 0))
    return std::nullopt;
  return with_graft(the_case, f, t, numbers[14], {numbers[15], numbers[16], numbers[17]});
}

double placing_between_m(const PlacingPlan& plan, const BoneSnapshot& bones) {
  if (plan.femur.bone >= bones.count || plan.tibia.bone >= bones.count) return 0;
  return (bones.bones[plan.femur.bone].X_WB * plan.femur.mouth_B -
          bones.bones[plan.tibia.bone].X_WB * plan.tibia.mouth_B)
      .norm();
}

namespace {

// The way on which the graft goes, from outside the tibia to outside the femur.
struct PlacingWay {
  std::array<Vec3, 6> stations;
  std::array<double, 6> at_m;  // from the tibia's outer mouth
  Vec3 place(double m) const {
    std::size_t i = 0;
    while (i + 2 < at_m.size() && m > at_m[i + 1]) ++i;
    const double share = (m - at_m[i]) / (at_m[i + 1] - at_m[i]);
    return stations[i] + share * (stations[i + 1] - stations[i]);
  }
};

PlacingWay way_now(const PlacingPlan& plan, const BoneSnapshot& bones) {
  const Pose &X_WF = bones.bones[plan.femur.bone].X_WB, &X_WT = bones.bones[plan.tibia.bone].X_WB;
  PlacingWay way;
  const Vec3 t_out = X_WT * plan.tibia.outer_B, t_in = X_WT * plan.tibia.mouth_B;
  const Vec3 f_in = X_WF * plan.femur.mouth_B, f_out = X_WF * plan.femur.outer_B;
  const double before = plan.graft_length_m + 0.05;
  way.stations = {t_out + before * (t_out - t_in).normalized(),      t_out, t_in, f_in, f_out,
                  f_out + kThreadOut_m * (f_out - f_in).normalized()};
  way.at_m[0] = -before;
  for (std::size_t i = 1; i < way.stations.size(); ++i)
    way.at_m[i] = way.at_m[i - 1] + (way.stations[i] - way.stations[i - 1]).norm();
  return way;
}

void add_rods(const PlacingWay& way, double from_m, double to_m, PlacingRod::Is is, double radius_m,
              std::vector<PlacingRod>& out) {
  double at = from_m;
  for (std::size_t i = 1; i < way.at_m.size() && at < to_m; ++i) {
    const double next = std::min(to_m, way.at_m[i]);
    if (!(next > at)) continue;
    out.push_back({is, way.place(at), way.place(next), radius_m});
    at = next;
  }
}

}  // namespace

std::vector<PlacingRod> placing_rods(const BoneSnapshot& bones) {
  using Is = PlacingRod::Is;
  const GraftPlacingState& s = bones.placing;
  const PlacingPlan& plan = s.plan;
  std::vector<PlacingRod> out;
  if (!s.on || s.phase == PlacingPhase::kEmpty) return out;
  if (plan.femur.bone >= bones.count || plan.tibia.bone >= bones.count) return out;
  const PlacingWay way = way_now(plan, bones);
  if (s.phase == PlacingPhase::kThreadInside || s.phase == PlacingPhase::kThreadHeld) {
    out.push_back({Is::kThread, s.end_W, way.stations[3], kThreadRadius_m});
    add_rods(way, way.at_m[3], way.at_m[5], Is::kThread, kThreadRadius_m, out);
    return out;
  }
  const bool turned = s.phase == PlacingPhase::kTurned;
  // Turned it lies on the cortex, or on what lies between.
  const double button = turned ? way.at_m[4] + s.gap_m : s.drawn_m - kFlipRoom_m;
  const double front = button - plan.loop_m;
  add_rods(way, front - plan.graft_length_m, front, Is::kGraft, 0.5 * plan.graft_m, out);
  add_rods(way, front, button, Is::kLoop, kLoopRadius_m, out);
  if (turned) {
    const Vec3 axis = (way.stations[5] - way.stations[4]).normalized();
    const Vec3 across = about(axis)[0], at = way.place(button) + kButtonRadius_m * axis;
    out.push_back(
        {Is::kButton, at - kFlipRoom_m * across, at + kFlipRoom_m * across, kButtonRadius_m});
    const PlacingScrew& screw = s.screw;
    if (screw.screws == 0) return out;
    const Pose& X_WT = bones.bones[plan.tibia.bone].X_WB;
    const Vec3 tip_W = X_WT * (screw.p_B - screw.in_m * screw.out_B);
    out.push_back({Is::kScrew, tip_W, tip_W + screw.length_m * X_WT.rotate(screw.out_B),
                   0.5 * screw.width_m});
    return out;
  }
  add_rods(way, button - kFlipRoom_m, button + kFlipRoom_m, Is::kButton, kButtonRadius_m, out);
  add_rods(way, button + kFlipRoom_m, way.at_m[5], Is::kThread, kThreadRadius_m, out);
  return out;
}

}  // namespace osteon
