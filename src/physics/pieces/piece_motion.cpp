// Symbols: c, q middle and turn of the piece; r a point of its surface from there; J its inertia by
// unit mass. A correction along n at r moves the middle by n / (1 + (r x n) J^-1 (r x n)) of it and
// turns the piece by the rest (Mueller and others 2020, equations 2 to 9, with one body that no
// contact moves). Mass cancels: gravity and drag are accelerations. It ends: the rounds are
// counted.
#include "pieces/piece_motion.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace osteon {
namespace {

constexpr double kPieceFalls_m_per_s2 = 9.81;
constexpr double kDragAir_per_s = 1, kDragInTissue_per_s = 200;  // own defaults
constexpr double kPieceFastest_m_per_s = 0.5;
constexpr double kPieceSlow_m_per_s = 0.008;               // for a tenth of a second: it rests
constexpr double kMostOut_m = 1e-4, kMostByTool_m = 1e-3;  // of one correction
constexpr int kPieceRounds = 4;
constexpr double kRoomOfStep_m = 0.002;  // beyond a piece: a step seldom goes farther

Quat turned(const Quat& q, const Vec3& by) {
  const Quat turn(0, by.x(), by.y(), by.z());
  Quat out = q;
  out.coeffs() += 0.5 * (turn * q).coeffs();
  return out.normalized();
}

struct Moving {
  Vec3 c, c0;
  Quat q, q0;
  Mat3 inverse_J_B;

  Vec3 spun(const Vec3& moment) const { return q * (inverse_J_B * (q.conjugate() * moment)); }
  void correct(const Vec3& r, const Vec3& n, double by_m) {
    const Vec3 arm = r.cross(n);
    const double share = by_m / (1 + arm.dot(spun(arm)));
    c += share * n;
    q = turned(q, share * spun(arm));
  }
};

// What a point of the surface met in a step.
struct PointContact {
  Vec3 out_W = Vec3::UnitZ();
  double pushed_m = 0, held_m = 0;  ///< along the normal, and against its way by friction
};

// Out of what the point stands in.
bool push_out(Moving& at, const Vec3& p_M, const PieceNeighbours& around, PointContact& contact) {
  const Vec3 r = at.q * p_M;
  PiecePush push = around.in_bone(at.c + r);
  if (const PiecePush soft = around.in_soft(at.c + r); soft.depth_m > push.depth_m) push = soft;
  double by_m = std::min(push.depth_m, kMostOut_m);
  const PiecePush tool = around.in_tool(at.c + r);
  if (tool.depth_m > push.depth_m) {
    push = tool;
    by_m = std::min(push.depth_m, kMostByTool_m);
  }
  if (!(push.depth_m > 0)) return false;
  at.correct(r, push.out_W, by_m);
  contact.out_W = push.out_W;
  contact.pushed_m += by_m;
  return true;
}

// Friction takes back of the point's way along the surface what its share of the push allows.
void hold_back(Moving& at, const Vec3& p_M, PointContact& contact) {
  const Vec3 r = at.q * p_M;
  const Vec3 moved = at.c + r - (at.c0 + at.q0 * p_M);
  const Vec3 slid = moved - moved.dot(contact.out_W) * contact.out_W;
  const double way = slid.norm();
  const double can = FallenPieces::kFriction * contact.pushed_m - contact.held_m;
  if (!(way > 1e-12) || !(can > 0)) return;
  const double by_m = std::min(way, can);
  at.correct(r, -slid / way, by_m);
  contact.held_m += by_m;
}

}  // namespace

double nearest_point_m(const FallenPiece& piece, const Vec3& p_W) {
  const Vec3 p_B = piece.X_WB.inverse() * p_W;
  double best = 1e300;
  for (const Vec3& point : piece.shape->points_B()) best = std::min(best, (point - p_B).norm());
  return best;
}

PieceStep move_piece(FallenPiece& piece, const PieceSurroundings& around, double step_s) {
  const PieceShape& shape = *piece.shape;
  // Soft parts hold a piece where it was cut off, or pushed to; only in air does it fall.
  const bool held = around.in_tissue(piece.X_WB * shape.middle_B());
  const double slowed = 1 / (1 + step_s * (held ? kDragInTissue_per_s : kDragAir_per_s));
  if (!held) piece.v_W.z() -= step_s * kPieceFalls_m_per_s2;
  piece.v_W *= slowed;
  piece.w_W *= slowed;
  const Mat3 J = shape.spread_m2().trace() * Mat3::Identity() - shape.spread_m2();
  Moving at;
  at.c0 = piece.X_WB * shape.middle_B();
  at.q0 = piece.X_WB.q;
  at.c = at.c0 + step_s * piece.v_W;
  at.q = turned(at.q0, step_s * piece.w_W);
  at.inverse_J_B = J.inverse();
  const PieceNeighbours near(around, at.c0, shape.reach_m() + kRoomOfStep_m);
  PieceStep did;
  std::array<PointContact, PieceShape::kMostPoints> contacts{};
  bool pushed = false;
  for (int round = 0; round < kPieceRounds; ++round) {
    for (std::size_t n = 0; n < shape.points_B().size(); ++n) {
      // To and fro: one order alone would turn what rests on a slope a little in each step.
      const std::size_t i = round % 2 == 0 ? n : shape.points_B().size() - 1 - n;
      const Vec3 p_M = shape.points_B()[i] - shape.middle_B();
      pushed = push_out(at, p_M, near, contacts[i]) || pushed;
      if (contacts[i].pushed_m > 0) hold_back(at, p_M, contacts[i]);
    }
    if (!pushed) break;  // nor would it be in another round
  }
  did.touches = held || pushed;
  if (!is_finite(at.c) || !at.q.coeffs().allFinite()) {
    piece.v_W = piece.w_W = Vec3::Zero();
    return did;
  }
  piece.v_W = (at.c - at.c0) / step_s;
  const Quat turn = at.q * at.q0.conjugate();
  piece.w_W = (turn.w() < 0 ? -2.0 : 2.0) / step_s * turn.vec();
  const double speed = piece.v_W.norm(), rim = piece.w_W.norm() * shape.reach_m();
  if (speed > kPieceFastest_m_per_s) piece.v_W *= kPieceFastest_m_per_s / speed;
  if (rim > kPieceFastest_m_per_s) piece.w_W *= kPieceFastest_m_per_s / rim;
  did.slow = speed < kPieceSlow_m_per_s && rim < kPieceSlow_m_per_s;
  piece.X_WB.q = at.q;
  piece.X_WB.p = at.c - at.q * shape.middle_B();
  return did;
}

}  // namespace osteon
