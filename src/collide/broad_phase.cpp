#include "osteon/collide/broad_phase.h"

#include <algorithm>
#include <cassert>

namespace osteon {
namespace {

// Grows every bound by more than the rounding of a pose at a metre from the origin.
constexpr double kRounding = 1e-9;

struct Segment {
  Vec3 from;
  Vec3 along;
};

double distance_squared(const Segment& s, const Vec3& p) {
  const double length2 = s.along.squaredNorm();
  const double share =
      length2 > 0 ? std::clamp((p - s.from).dot(s.along) / length2, 0.0, 1.0) : 0.0;
  return (p - s.from - share * s.along).squaredNorm();
}

// Separating axes of a segment and a box: the box's own axes and their crosses with the segment
// (Ericson, Real-Time Collision Detection, section 5.3.3).
bool meets_box(const Segment& s, const Vec3& center, const Vec3& half) {
  const Vec3 h = 0.5 * s.along;
  const Vec3 m = s.from + h - center;
  const Vec3 a = h.cwiseAbs();
  if ((m.cwiseAbs().array() > (half + a).array()).any()) return false;
  if (std::abs(m.y() * h.z() - m.z() * h.y()) > half.y() * a.z() + half.z() * a.y()) return false;
  if (std::abs(m.z() * h.x() - m.x() * h.z()) > half.x() * a.z() + half.z() * a.x()) return false;
  return std::abs(m.x() * h.y() - m.y() * h.x()) <= half.x() * a.y() + half.y() * a.x();
}

}  // namespace

void BroadPhase::add_piece(const ConvexBody& piece) {
  pieces_.push_back({piece.center, piece.radius, piece.box.center(), 0.5 * piece.box.extent()});
}

void BroadPhase::close_bone() {
  Aabb box;
  for (std::size_t i = first_piece_.back(); i < pieces_.size(); ++i) {
    box.include(pieces_[i].box_center_B - pieces_[i].box_half);
    box.include(pieces_[i].box_center_B + pieces_[i].box_half);
  }
  Ball ball;
  if (!box.empty()) ball.center_B = box.center();
  for (std::size_t i = first_piece_.back(); i < pieces_.size(); ++i)
    ball.radius =
        std::max(ball.radius, (pieces_[i].center_B - ball.center_B).norm() + pieces_[i].radius);
  ball.radius *= 1 + 1e-12;
  bones_.push_back(ball);
  first_piece_.push_back(static_cast<std::uint32_t>(pieces_.size()));
}

void BroadPhase::add_bone(std::span<const ConvexBody> pieces) {
  for (const ConvexBody& piece : pieces) add_piece(piece);
  close_bone();
}

void BroadPhase::add_bone(std::span<const ConvexBody* const> pieces) {
  for (const ConvexBody* piece : pieces) add_piece(*piece);
  close_bone();
}

void BroadPhase::add_bone(const Aabb& box) {
  const Vec3 half = 0.5 * box.extent();
  pieces_.push_back({box.center(), half.norm(), box.center(), half});
  close_bone();
}

std::size_t BroadPhase::query(std::span<const Pose> X_WB, const SweptSphere& ball, double margin,
                              std::span<PieceRef> out) const {
  assert(X_WB.size() >= bone_count());
  std::size_t found = 0;
  const Segment path_W{ball.p_from_W, ball.p_to_W - ball.p_from_W};
  for (std::uint32_t bone = 0; bone < bone_count(); ++bone) {
    // A bone out of reach as a whole. Written so that what is not finite is looked at closely.
    const Vec3 center_W = X_WB[bone] * bones_[bone].center_B;
    const double room = ball.radius + margin + bones_[bone].radius +
                        kRounding * (2 + ball.p_from_W.norm() + center_W.norm());
    if (distance_squared(path_W, center_W) > room * room) continue;
    const Pose X_BW = X_WB[bone].inverse();
    const Vec3 from = X_BW * ball.p_from_W;
    const Segment path{from, X_BW * ball.p_to_W - from};
    const double reach = ball.radius + margin + kRounding * (1 + from.norm());
    const bool finite = is_finite(from) && is_finite(path.along) && std::isfinite(reach);
    for (std::uint32_t i = first_piece_[bone]; i < first_piece_[bone + 1]; ++i) {
      const Bounds& b = pieces_[i];
      const double apart = reach + b.radius;
      if (finite && (distance_squared(path, b.center_B) > apart * apart ||
                     !meets_box(path, b.box_center_B, b.box_half + Vec3::Constant(reach))))
        continue;
      if (found < out.size()) out[found] = {bone, i - first_piece_[bone]};
      ++found;
    }
  }
  return found;
}

}  // namespace osteon
