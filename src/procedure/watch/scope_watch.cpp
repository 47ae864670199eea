#include "osteon/procedure/scope_watch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "osteon/scene/marks_now.h"
#include "osteon/scene/rings.h"

namespace osteon {
namespace {

constexpr double kWatchHz = 100;
constexpr double kDegreesOfRad = 180 / std::numbers::pi;
constexpr double kTipSpare_m = 0.003;

// Clips the segment by the hull's planes (Cyrus and Beck 1978): what is left lies inside.
bool crosses(const Hull& hull, const Vec3& a, const Vec3& b) {
  double from = 0, to = 1;
  for (const Plane& plane : hull.planes) {
    const double da = plane.signed_distance(a), db = plane.signed_distance(b);
    if (da >= 0 && db >= 0) return false;
    if (da > 0) from = std::max(from, da / (da - db));
    if (db > 0) to = std::min(to, da / (da - db));
    if (from >= to) return false;
  }
  return true;
}

// Strides along the segment are no longer than the distance to the bone's surface.
bool crosses(const DistanceField& field, const Vec3& a, const Vec3& b) {
  constexpr double kLeastStride_m = 0.0002;
  const double length = (b - a).norm();
  for (double at = 0; at < length;) {
    const double room = field.at(a + (at / length) * (b - a)).distance;
    if (!(room > 0)) return true;
    at += std::max(room, kLeastStride_m);
  }
  return false;
}

}  // namespace

ScopeView view_through(const ScopeOptics& optics, const Pose& X_WT) {
  const double s = std::sin(optics.angle_rad), c = std::cos(optics.angle_rad);
  return {X_WT.p, X_WT.rotate(Vec3(0, s, -c)), X_WT.rotate(Vec3(0, c, s))};
}

double turn_deg(const ScopeView& view) {
  const Vec3 right = view.along_W.cross(view.up_W);
  const double x = right.z(), y = view.up_W.z();
  if (std::hypot(x, y) < 1e-6) return 0;
  return std::atan2(x, y) * kDegreesOfRad;
}

bool is_hidden(const Case& the_case, const BoneSnapshot& bones, const Vec3& from_W,
               const Vec3& to_W, double spare_m) {
  const Vec3 way = to_W - from_W;
  const double length = way.norm();
  if (length <= spare_m) return false;
  const Vec3 end_W = to_W - way * (spare_m / length);
  for (std::size_t i = 0; i < the_case.bones.size(); ++i) {
    if (is_loose_ring(the_case, static_cast<std::uint32_t>(i))) continue;
    const Pose X_WB = i < bones.count ? bones.bones[i].X_WB : the_case.bones[i].X_WB;
    const Pose X_BW = X_WB.inverse();
    const Vec3 a = X_BW * from_W, b = X_BW * end_W;
    if (the_case.bones[i].field) {
      if (crosses(*the_case.bones[i].field, a, b)) return true;
      continue;
    }
    for (const Hull& piece : the_case.bones[i].pieces)
      if (crosses(piece, a, b)) return true;
  }
  return false;
}

std::optional<PlaceInPicture> place_in_picture(const ScopeOptics& optics, const ScopeView& view,
                                               const Case& the_case, const BoneSnapshot& bones,
                                               const Vec3& p_W, double spare_m) {
  const Vec3 way = p_W - view.eye_W;
  const double distance = way.norm();
  if (!(distance > 1e-9)) return std::nullopt;
  const double cosine = std::clamp(way.dot(view.along_W) / distance, -1.0, 1.0);
  const double share = std::acos(cosine) / optics.half_field_rad;
  if (share > 1) return std::nullopt;
  return PlaceInPicture{share, distance, is_hidden(the_case, bones, view.eye_W, p_W, spare_m)};
}

ScopeWatch::ScopeWatch(const Case& the_case, Settings settings)
    : case_(&the_case),
      settings_(std::move(settings)),
      stride_(std::max<std::uint64_t>(
          1, static_cast<std::uint64_t>(std::lround(1 / (kWatchHz * settings_.tick_s))))) {}

Event ScopeWatch::event(const ToolState& tool, EventKind kind, std::array<double, 3> values) const {
  Event made;
  made.tick = tool.tick;
  made.kind = kind;
  made.hand = settings_.hand;
  made.p_W = tool.X_WP.p;
  made.values = values;
  return made;
}

std::optional<std::array<double, 2>> ScopeWatch::seen(const ScopeView& view,
                                                      const BoneSnapshot& bones, const Vec3& p_W,
                                                      double spare_m) const {
  const auto at = place_in_picture(*settings_.optics, view, *case_, bones, p_W, spare_m);
  if (!at || at->hidden) return std::nullopt;
  return std::array<double, 2>{at->share, at->distance_m * 1000};
}

void ScopeWatch::look(const ToolState& tool, const ToolState* other, const BoneSnapshot& bones,
                      std::vector<Event>& out) const {
  const ScopeView view = view_through(*settings_.optics, tool.X_WP);
  const double turned = turn_deg(view);
  int in_view = 0;
  for (const std::uint32_t mark : settings_.marks) {
    const auto at = seen(view, bones, place_now(*case_, mark, bones), kMarkSpare_m);
    if (!at) continue;
    ++in_view;
    out.push_back(event(tool, kMarkSeen, {(*at)[0], (*at)[1], turned}));
    out.back().subject_kind = SubjectKind::kLandmark;
    out.back().subject = mark;
  }
  out.push_back(event(tool, kScopeHeld, {turned, static_cast<double>(in_view), 0}));
  if (!other || !is_finite(other->X_WP)) return;
  const bool tip = seen(view, bones, other->X_WP.p, kTipSpare_m).has_value();
  out.push_back(event(tool, kTipSeen, {tip ? 1.0 : 0.0, 0, 0}));
}

void ScopeWatch::add(const ToolState& tool, const ToolState* other, const BoneSnapshot& bones,
                     std::vector<Event>& out) {
  if (tool.tick % stride_ != 0 || !is_finite(tool.X_WP)) return;
  if (settings_.portal_W) {
    const Vec3 in_W = tool.X_WP.rotate(-Vec3::UnitZ());
    const Vec3 past = tool.X_WP.p - *settings_.portal_W;
    const double depth = past.dot(in_W);
    const double off_m = depth > 0 ? (past - depth * in_W).norm() : 0;
    out.push_back(event(tool, kShaftHeld, {off_m * 1000, 0, 0}));
  }
  if (tool.portal < settings_.portal_marks.size()) {
    out.push_back(event(tool, kThroughPortal, {0, 0, 0}));
    out.back().subject_kind = SubjectKind::kLandmark;
    out.back().subject = settings_.portal_marks[tool.portal];
  }
  if (settings_.optics) look(tool, other, bones, out);
}

}  // namespace osteon
