#include "osteon/procedure/cut_watch.h"

#include <algorithm>
#include <cmath>

#include "osteon/procedure/polyline.h"

namespace osteon {
namespace {

bool is_inside(const Bone& bone, const Vec3& p_B) {
  return std::any_of(bone.pieces.begin(), bone.pieces.end(), [&](const Hull& piece) {
    return std::all_of(piece.planes.begin(), piece.planes.end(),
                       [&](const Plane& plane) { return plane.signed_distance(p_B) < 0; });
  });
}

}  // namespace

CutWatch::CutWatch(const Case& the_case, const CutPart& part, double ball_radius_m,
                   std::uint8_t hand, double tick_s)
    : radius_m_(ball_radius_m - kTouch_m),
      bone_(part.bone),
      hand_(hand),
      stride_(static_cast<std::uint64_t>(std::max(1.0, std::round(0.01 / tick_s)))) {
  const Bone& bone = the_case.bones[part.bone];
  Aabb box;
  for (const Hull& piece : bone.pieces)
    for (const Vec3& v : piece.vertices) box.include(v);
  if (box.empty()) return;
  const Vec3 first = box.lo + Vec3::Constant(0.5 * kApart_m);
  for (double x = first.x(); x < box.hi.x(); x += kApart_m)
    for (double y = first.y(); y < box.hi.y(); y += kApart_m)
      for (double z = first.z(); z < box.hi.z(); z += kApart_m) {
        if (!is_inside(bone, {x, y, z})) continue;
        const Vec3 p_W = bone.X_WB * Vec3(x, y, z);
        points_.push_back({p_W, distance_to_polyline(part.line_W, p_W) - part.within_m});
        ++(points_.back().off_m <= 0 ? within_ : beyond_);
      }
}

Event CutWatch::event(const ToolState& tool) const {
  const auto share = [](std::size_t gone, std::size_t of) {
    return of > 0 ? static_cast<double>(gone) / static_cast<double>(of) : 0;
  };
  Event made;
  made.tick = tool.tick;
  made.kind = kCutSeen;
  made.hand = hand_;
  made.subject_kind = SubjectKind::kBone;
  made.subject = bone_;
  made.p_W = tool.X_WP.p;
  made.values = {share(gone_within_, within_), share(gone_beyond_, beyond_), farthest_m_ * 1000};
  return made;
}

void CutWatch::add(const ToolState& tool, std::vector<Event>& out) {
  if (tool.tick % stride_ != 0 || !is_finite(tool.X_WP)) return;
  const Vec3 p_W = tool.X_WP.p;
  const std::size_t before = points_.size();
  std::erase_if(points_, [&](const Point& point) {
    if ((point.p_W - p_W).squaredNorm() >= radius_m_ * radius_m_) return false;
    ++(point.off_m <= 0 ? gone_within_ : gone_beyond_);
    farthest_m_ = std::max(farthest_m_, point.off_m);
    return true;
  });
  if (points_.size() < before) out.push_back(event(tool));
}

}  // namespace osteon
