// Where on the screen the moving parts of a scene show, and when its still parts are still.
#include <algorithm>
#include <cmath>
#include <limits>

#include "scene_painter.h"

namespace osteon {
namespace {

constexpr double kStill_px = 0.05;  // a bone that moved by less need not be drawn anew
constexpr double kSlack_px = 3;     // for the rounding of pixels and the smoothing of edges
constexpr int kShadowSteps = 6;
constexpr double kWidening = 1.25;  // of a capsule's piece from its far end to its near one
constexpr int kMostPieces = 16;

/// Marks capsules given in view space.
class Marker {
 public:
  /// What is nearer to the eye than `nearest_m` is not looked at.
  Marker(const Frame& frame, int width, int height, TileMask& mask, double nearest_m = 0)
      : frame_(frame), width_(width), height_(height), mask_(mask) {
    const Eigen::Matrix4f& m = frame.clip_from_view;
    perspective_ = m(3, 2) != 0;
    near_m_ = perspective_ ? static_cast<double>(m(2, 3) / (m(2, 2) - 1)) : 0;
    nearest_m_ = std::max(near_m_, nearest_m);
  }

  void capsule(Vec3 a_C, Vec3 b_C, double radius_m) {
    if (!cut(a_C, b_C, radius_m)) return;
    const int pieces = pieces_of(a_C, b_C);
    for (int k = 0; k < pieces; ++k) {
      const double from = static_cast<double>(k) / pieces, to = (k + 1.0) / pieces;
      piece(a_C + from * (b_C - a_C), a_C + to * (b_C - a_C), radius_m);
    }
  }

 private:
  // As wide everywhere as at its nearest point.
  void piece(const Vec3& a_C, const Vec3& b_C, double radius_m) {
    const double depth =
        perspective_ ? std::max(nearest_m_, -std::max(a_C.z(), b_C.z()) - radius_m) : 1;
    const double metres_per_px = static_cast<double>(frame_.pixel_clip.y()) * depth /
                                 static_cast<double>(frame_.clip_from_view(1, 1));
    mask_.mark(pixel(a_C), pixel(b_C), radius_m / metres_per_px + kSlack_px);
  }

  // One that runs towards the eye grows wider on the way: in pieces it is not as wide everywhere.
  int pieces_of(const Vec3& a_C, const Vec3& b_C) const {
    if (!perspective_) return 1;
    const double near = std::min(-a_C.z(), -b_C.z()), far = std::max(-a_C.z(), -b_C.z());
    const double steps = std::log(far / std::max(near, near_m_)) / std::log(kWidening);
    return std::clamp(static_cast<int>(std::ceil(steps)), 1, kMostPieces);
  }

  /// Leaves the part of the segment before the eye; false when there is none.
  bool cut(Vec3& a_C, Vec3& b_C, double radius_m) const {
    if (!perspective_) return true;
    if (std::max(-a_C.z(), -b_C.z()) < nearest_m_ - radius_m) return false;
    // Its thickness reaches as far beyond what is looked at.
    const double from_m = std::max(near_m_, nearest_m_ - radius_m);
    const double da = -a_C.z() - from_m, db = -b_C.z() - from_m;
    if (std::max(da, db) < 0) {  // only its thickness reaches in: somewhere near the picture's edge
      mask_.mark_all();
      return false;
    }
    const Vec3 a = a_C, b = b_C;
    if (da < 0) a_C = a + (b - a) * (da / (da - db));
    if (db < 0) b_C = b + (a - b) * (db / (db - da));
    return true;
  }

  Eigen::Vector2d pixel(const Vec3& p_C) const {
    const Eigen::Vector4d clip = frame_.clip_from_view.cast<double>() * p_C.homogeneous();
    return {0.5 * (clip.x() / clip.w() + 1) * width_, 0.5 * (clip.y() / clip.w() + 1) * height_};
  }

  const Frame& frame_;
  int width_, height_;
  TileMask& mask_;
  bool perspective_ = false;
  double near_m_ = 0, nearest_m_ = 0;
};

}  // namespace

std::vector<ScenePainter::Capsule> ScenePainter::capsules_along_z(const TriMesh& mesh) {
  constexpr std::size_t kSlices = 10;
  Aabb all;
  for (const Vec3& p : mesh.vertices)
    if (is_finite(p)) all.include(p);
  std::vector<Capsule> out;
  if (all.empty()) return out;
  const double height = std::max(all.extent().z(), 1e-9);
  std::vector<Aabb> slices(kSlices);
  // A triangle belongs to every slice that it runs through.
  for (const Triangle& t : mesh.triangles) {
    Aabb box;
    for (const std::uint32_t v : t)
      if (v < mesh.vertices.size() && is_finite(mesh.vertices[v])) box.include(mesh.vertices[v]);
    if (box.empty()) continue;
    const auto slice = [&](double z) {
      const double s = (z - all.lo.z()) / height * static_cast<double>(kSlices);
      return std::min(static_cast<std::size_t>(std::max(s, 0.0)), kSlices - 1);
    };
    for (std::size_t k = slice(box.lo.z()); k <= slice(box.hi.z()); ++k) {
      slices[k].include(box.lo);
      slices[k].include(box.hi);
    }
  }
  for (const Aabb& box : slices) {
    if (box.empty()) continue;
    const Vec3 c = box.center();
    const double radius = 0.5 * box.extent().head<2>().norm();
    out.push_back({Vec3(c.x(), c.y(), box.lo.z()), Vec3(c.x(), c.y(), box.hi.z()), radius});
  }
  return out;
}

ScenePainter::Capsule ScenePainter::capsule_around(const Aabb& box) {
  if (box.empty()) return {};
  Eigen::Index axis = 0;
  const Vec3 half = 0.5 * box.extent();
  const double longest = half.maxCoeff(&axis);
  Vec3 rest = half;
  rest[axis] = 0;
  const double radius = rest.norm();
  const Vec3 reach = Vec3::Unit(axis) * longest;
  return {box.center() - reach, box.center() + reach, radius};
}

TileMask ScenePainter::moving_tiles(const RenderSnapshot& snapshot, const ViewState& view,
                                    const Frame& frame, int width, int height) const {
  TileMask mask(width, height);
  Marker marker(frame, width, height, mask);
  const auto mark_model = [&](const ToolModel& tool, const Pose& X_WT) {
    const Pose X_CT = frame.X_CW * X_WT;
    if (!is_finite(X_CT)) return;
    for (const Capsule& c : tool.capsules) marker.capsule(X_CT * c.a, X_CT * c.b, c.radius_m);
  };
  const auto mark_tool = [&](const ToolState& state, const Pose& X_WT) {
    mark_model(model_of(state), X_WT);
  };
  if (view.show_proxy)
    for (const GhostTool& ghost : ghosts_) mark_model(model_at(ghost.instrument), ghost.X_WT);
  if (view.show_proxy)
    for (const Solid& solid : moving_solids_) {
      if (solid.box_W.empty()) continue;
      const Capsule c = capsule_around(solid.box_W);
      marker.capsule(frame.X_CW * c.a, frame.X_CW * c.b, c.radius_m);
    }
  if (view.show_proxy) mark_tool(snapshot.tool, snapshot.tool.X_WP);
  if (view.show_proxy)
    for (const ToolState& other : others_) mark_tool(other, other.X_WP);
  if (shows_hand(snapshot, view)) mark_tool(snapshot.tool, snapshot.tool.X_WD);
  if (view.show_force)
    for (const Capsule& c : mark_capsules(snapshot))
      marker.capsule(frame.X_CW * c.a, frame.X_CW * c.b, c.radius_m);
  for (const Capsule& c : placing_capsules(snapshot))
    marker.capsule(frame.X_CW * c.a, frame.X_CW * c.b, c.radius_m);
  for (const Capsule& c : bench_capsules(snapshot))
    marker.capsule(frame.X_CW * c.a, frame.X_CW * c.b, c.radius_m);
  for (const Capsule& c : loose_capsules(snapshot, view))
    marker.capsule(frame.X_CW * c.a, frame.X_CW * c.b, c.radius_m);
  for (const Capsule& c : rod_capsules(snapshot))
    marker.capsule(frame.X_CW * c.a, frame.X_CW * c.b, c.radius_m);
  if (view.show_proxy) {
    const double nearest_m = nearest_bone(snapshot, view, frame);
    TileMask shade = shade_tiles(snapshot.tool, frame, width, height, nearest_m);
    shade.keep(bone_tiles(snapshot, view, frame, width, height));
    mask.add(shade);
  }
  return mask;
}

// Depth, metres; it may lie behind the eye.
double ScenePainter::nearest_bone(const RenderSnapshot& snapshot, const ViewState& view,
                                  const Frame& frame) const {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < shared_->bones.size(); ++k) {
    if (!shows(snapshot, view, k) || shared_->bones[k].radius_m <= 0) continue;
    const Capsule& c = shared_->bones[k].around;
    for (const Pose& X_WB : end_poses(snapshot, k)) {
      const Pose X_CB = frame.X_CW * X_WB;
      const double depth = -std::max((X_CB * c.a).z(), (X_CB * c.b).z()) - c.radius_m;
      nearest_m = std::min(nearest_m, depth);
    }
  }
  return nearest_m;
}

// Shade falls on bones alone: what of it is nearer than the nearest bone is not seen.
TileMask ScenePainter::shade_tiles(const ToolState& state, const Frame& frame, int width,
                                   int height, double nearest_m) const {
  TileMask mask(width, height);
  const ToolModel& tool = model_of(state);
  const Pose X_CP = frame.X_CW * state.X_WP;
  if (!is_finite(X_CP) || tool.length_m <= 0) return mask;
  Marker marker(frame, width, height, mask, nearest_m);
  const ShadeReach reach = shade_reach(tool);
  const Vec3 tip = X_CP.p;
  const Vec3 end = X_CP * Vec3(tool.shaft_T.x(), tool.shaft_T.y(), tool.length_m);
  marker.capsule(tip, end, reach.near_m);
  const double step = reach.shadow_m / kShadowSteps;
  for (int k = 0; k <= kShadowSteps; ++k) {
    const double t = k * step;
    const Vec3 shift = -t * frame.key_dir_C.cast<double>();
    const double radius = 2 * tool.tip_radius_m + 0.25 * (t + 0.5 * step) + 0.5 * step;
    marker.capsule(tip + shift, end + shift, radius);
  }
  return mask;
}

TileMask ScenePainter::bone_tiles(const RenderSnapshot& snapshot, const ViewState& view,
                                  const Frame& frame, int width, int height) const {
  TileMask mask(width, height);
  Marker marker(frame, width, height, mask);
  for (std::size_t k = 0; k < shared_->bones.size(); ++k) {
    if (!shows(snapshot, view, k) || shared_->bones[k].radius_m <= 0) continue;
    const Capsule& c = shared_->bones[k].around;
    for (const Pose& X_WB : end_poses(snapshot, k)) {
      const Pose X_CB = frame.X_CW * X_WB;
      marker.capsule(X_CB * c.a, X_CB * c.b, c.radius_m);
    }
  }
  return mask;
}

// What bends with a limb may stand anywhere between its ends' poses, so all of it counts.
TileMask ScenePainter::changed_tiles(std::uint64_t since, const RenderSnapshot& snapshot,
                                     const ViewState& view, const Frame& frame, int width,
                                     int height) const {
  TileMask mask(width, height);
  Marker marker(frame, width, height, mask);
  for (const SurfaceChanges::One& one : shared_->changes.since(since)) {
    if (one.model >= shared_->bones.size() || !shows(snapshot, view, one.model)) continue;
    const bool bends = cover_motion(snapshot, one.model).has_value();
    const Capsule c = bends ? shared_->bones[one.model].around : capsule_around(one.box_M);
    for (const Pose& X_WM : end_poses(snapshot, one.model)) {
      const Pose X_CM = frame.X_CW * X_WM;
      marker.capsule(X_CM * c.a, X_CM * c.b, c.radius_m);
    }
  }
  return mask;
}

bool ScenePainter::bones_look_still(const BoneSnapshot& before, const BoneSnapshot& now,
                                    const Frame& frame) const {
  if (before.count != now.count) return false;
  for (std::size_t k = 0; k < std::min<std::size_t>(shared_->bones.size(), now.count); ++k) {
    const Pose& a = before.bones[k].X_WB;
    const Pose& b = now.bones[k].X_WB;
    if (!is_finite(a) || !is_finite(b)) return false;
    const double radius = shared_->bones[k].radius_m + shared_->bones[k].center_B.norm();
    const double turned = 2 * (a.q.conjugate() * b.q).vec().norm();
    const double moved = (a.p - b.p).norm() + radius * turned;
    const double pixel_m =
        finest_metres_per_pixel(frame, b * shared_->bones[k].center_B, shared_->bones[k].radius_m);
    if (!(moved <= kStill_px * pixel_m)) return false;
  }
  return true;
}

}  // namespace osteon
