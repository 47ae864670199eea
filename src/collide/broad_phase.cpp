#include "osteon/collide/broad_phase.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace osteon {
namespace {

// Grows every bound by more than the rounding of a pose at a metre from the origin.
constexpr double kRounding = 1e-9;

Mat3 turn_into_bone(const Pose& X_WB) { return X_WB.q.conjugate().toRotationMatrix(); }

bool same_pose(const Pose& a, const Pose& b) { return a.p == b.p && a.q.coeffs() == b.q.coeffs(); }

struct Stretch {
  Vec3 from;
  Vec3 along;
  double per_length2;  // 1 over the length's square; 0: a point
};

// So short a stretch is a point: what it adds is less than kRounding.
double per_square(const Vec3& along) {
  constexpr double kPoint_m2 = 1e-30;
  const double length2 = along.squaredNorm();
  return length2 > kPoint_m2 ? 1 / length2 : 0.0;
}

double distance_squared(const Stretch& s, const Vec3& p) {
  const Vec3 off = p - s.from;
  const double share = std::clamp(off.dot(s.along) * s.per_length2, 0.0, 1.0);
  return (off - share * s.along).squaredNorm();
}

// Separating axes of a segment and a box: the box's own axes and their crosses with the segment
// (Ericson, Real-Time Collision Detection, section 5.3.3).
bool meets_box(const Stretch& s, const Vec3& center, const Vec3& half) {
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

// A bone out of reach as a whole. Written so that what is not finite is looked at closely.
bool BroadPhase::out_of_reach(std::uint32_t bone, const Pose& X_WB, const SweptSphere& ball,
                              double margin) const {
  const Vec3 center_W = X_WB * bones_[bone].center_B;
  const double room = ball.radius + margin + bones_[bone].radius +
                      kRounding * (2 + ball.p_from_W.norm() + center_W.norm());
  const Vec3 along_W = ball.p_to_W - ball.p_from_W;
  const Stretch path_W{ball.p_from_W, along_W, per_square(along_W)};
  return distance_squared(path_W, center_W) > room * room;
}

// Two vectors turned by one matrix cost less than by the quaternion each.
BroadPhase::BallOfBone BroadPhase::in_bone(const Pose& X_WB, const Mat3& R_BW,
                                           const SweptSphere& ball, double margin) {
  BallOfBone out;
  out.from_B = R_BW * (ball.p_from_W - X_WB.p);
  out.along_B = R_BW * (ball.p_to_W - ball.p_from_W);
  out.per_length2 = per_square(out.along_B);
  out.reach = ball.radius + margin + kRounding * (1 + out.from_B.lpNorm<1>());
  // What is not finite makes the sum so.
  out.finite = std::isfinite(out.reach + out.from_B.sum() + out.along_B.sum());
  return out;
}

bool BroadPhase::meets(const Bounds& piece, const BallOfBone& ball) {
  const Stretch path{ball.from_B, ball.along_B, ball.per_length2};
  const double apart = ball.reach + piece.radius;
  return distance_squared(path, piece.center_B) <= apart * apart &&
         meets_box(path, piece.box_center_B, piece.box_half + Vec3::Constant(ball.reach));
}

// How far the ball is from a place about which nothing of the bone was found, and how far it may
// be. Written so that what is not finite is looked at closely.
BroadPhase::Clearance BroadPhase::clearance(const NearPieces& near, std::uint32_t bone,
                                            const Pose& X_WB, const SweptSphere& ball,
                                            double margin) {
  const NearPieces::Place& place = near.places_[bone];
  if (place.count > 0) return {};
  const Vec3 step = same_pose(X_WB, place.X_WB)
                        ? Vec3(ball.p_from_W - place.p_W)
                        : Vec3(X_WB.q.conjugate() * (ball.p_from_W - X_WB.p) - place.p_B);
  const double length = (ball.p_to_W - ball.p_from_W).lpNorm<1>();
  const double far = ball.p_from_W.lpNorm<1>() + X_WB.p.lpNorm<1>();
  return {place.reach - (length + ball.radius + margin + kRounding * (3 + far)),
          step.squaredNorm()};
}

// Settled without a root.
bool BroadPhase::still_clear(const NearPieces& near, std::uint32_t bone, const Pose& X_WB,
                             const SweptSphere& ball, double margin) {
  const Clearance c = clearance(near, bone, X_WB, ball, margin);
  return c.room > 0 && c.step_squared < c.room * c.room;
}

double BroadPhase::spare(const NearPieces& near, std::uint32_t bone, const Pose& X_WB,
                         const SweptSphere& ball, double margin) {
  const Clearance c = clearance(near, bone, X_WB, ball, margin);
  const double spare = c.room - std::sqrt(c.step_squared);
  return spare > 0 ? spare : 0;
}

// Those that the ball may meet: of the kept ones where it is within their reach. Whatever meets the
// ball meets a wider one that holds it.
std::span<const std::uint32_t> BroadPhase::near_of(std::uint32_t bone, const Pose& X_WB,
                                                   const BallOfBone& ball, NearPieces& near) const {
  constexpr double kTooWide = 0.003;
  const NearPieces::Place& place = near.places_[bone];
  const double size = ball.along_B.norm() + ball.reach + kRounding;
  const double needed = (ball.from_B - place.p_B).norm() + size;
  if (!(needed <= place.reach && place.reach <= needed + kTooWide))
    look_about(bone, X_WB, ball, near);
  return {near.pieces_.data() + first_piece_[bone], place.count};
}

// No ball about p_B of less than this radius, m, meets a piece of the bone. A box counts by its
// widest axis, as `meets` widens it by each.
double BroadPhase::gap_to_pieces(std::uint32_t bone, const Vec3& p_B) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = first_piece_[bone]; i < first_piece_[bone + 1]; ++i) {
    const Bounds& piece = pieces_[i];
    const double to_ball = (p_B - piece.center_B).norm() - piece.radius;
    const double to_box = ((p_B - piece.box_center_B).cwiseAbs() - piece.box_half).maxCoeff();
    least = std::min(least, std::max(to_ball, to_box));
  }
  return least - 2 * kRounding * (1 + p_B.norm());
}

// Keeps those that come a little nearer than the ball asks for; of a bone with none of these how
// far it is.
void BroadPhase::look_about(std::uint32_t bone, const Pose& X_WB, const BallOfBone& ball,
                            NearPieces& near) const {
  constexpr double kAhead = 0.001;
  NearPieces::Place& place = near.places_[bone];
  const double size = ball.along_B.norm() + ball.reach + kRounding;
  const Ball& whole = bones_[bone];
  const double clear = (ball.from_B - whole.center_B).norm() - whole.radius - kRounding;
  place.X_WB = X_WB;
  place.p_W = X_WB * ball.from_B;
  place.p_B = ball.from_B;
  place.count = 0;
  place.reach = clear > size ? clear : gap_to_pieces(bone, place.p_B);
  if (place.reach > size + kAhead || clear > size) return;
  place.reach = size + kAhead;
  const BallOfBone wide{place.p_B, Vec3::Zero(), 0, place.reach + kRounding, true};
  for (std::uint32_t i = first_piece_[bone]; i < first_piece_[bone + 1]; ++i)
    if (meets(pieces_[i], wide))
      near.pieces_[first_piece_[bone] + place.count++] = i - first_piece_[bone];
}

std::size_t BroadPhase::query_bone(std::uint32_t bone, const Pose& X_WB, const SweptSphere& ball,
                                   double margin, std::span<PieceRef> out, std::size_t found,
                                   NearPieces* near) const {
  if (near ? still_clear(*near, bone, X_WB, ball, margin) : out_of_reach(bone, X_WB, ball, margin))
    return found;
  const BallOfBone ball_B =
      in_bone(X_WB, near ? near->turn_into(bone, X_WB) : turn_into_bone(X_WB), ball, margin);
  const std::uint32_t first = first_piece_[bone];
  const bool listed = near && ball_B.finite;
  const auto list = listed ? near_of(bone, X_WB, ball_B, *near) : std::span<const std::uint32_t>();
  const auto count =
      listed ? static_cast<std::uint32_t>(list.size()) : first_piece_[bone + 1] - first;
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t piece = listed ? list[k] : k;
    if (ball_B.finite && !meets(pieces_[first + piece], ball_B)) continue;
    if (found < out.size()) out[found] = {bone, piece};
    ++found;
  }
  return found;
}

std::size_t BroadPhase::query(std::span<const Pose> X_WB, const SweptSphere& ball, double margin,
                              std::span<PieceRef> out, NearPieces* near) const {
  assert(X_WB.size() >= bone_count() && (!near || near->places_.size() == bone_count()));
  std::size_t found = 0;
  for (std::uint32_t bone = 0; bone < bone_count(); ++bone)
    found = query_bone(bone, X_WB[bone], ball, margin, out, found, near);
  return found;
}

NearPieces::NearPieces(const BroadPhase& broad_phase)
    : places_(broad_phase.bone_count()),
      turns_(broad_phase.bone_count()),
      pieces_(broad_phase.piece_count()) {}

const Mat3& NearPieces::turn_into(std::uint32_t bone, const Pose& X_WB) {
  Turn& turn = turns_[bone];
  if (!same_pose(turn.X_WB, X_WB)) turn = {X_WB, turn_into_bone(X_WB)};
  return turn.R_BW;
}

}  // namespace osteon
