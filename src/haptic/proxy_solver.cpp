#include "proxy_solver.h"

#include <algorithm>
#include <cmath>

#include "osteon/scene/state.h"
#include "rigid_motion.h"

namespace osteon {
namespace {

// The proxy stands still when a round moves it less than this, m.
constexpr double kStill = 1e-7;
// A plane with a larger gap, m, does not start a contact: it is only a bound that the next round or
// tick will refine. It does not end one either: on its way over an edge the proxy may be so far.
constexpr double kTouch = 2e-5;

Vec3 clipped_to_ball(const Vec3& center, double radius, const Vec3& from, const Vec3& to) {
  if ((to - center).squaredNorm() <= radius * radius) return to;
  // Largest s with |from + s (to - from) - center| <= radius.
  const Vec3 d = to - from;
  const Vec3 f = from - center;
  const double a = d.squaredNorm();
  const double b = f.dot(d);
  const double c = f.squaredNorm() - radius * radius;
  const double s = (-b + std::sqrt(std::max(0.0, b * b - a * c))) / a;
  return from + std::clamp(s, 0.0, 1.0) * d;
}

}  // namespace

// A way with more pieces than the list holds is taken in shorter stretches, and a turn in smaller
// ones: a long instrument that lags behind a turning hand would else stand still for good.
bool ProxySolver::gather(ProxyTask& task) {
  constexpr double kShortest = 1e-5;
  const Quat wanted = task.q_WP;
  for (const double share : {1.0, 0.25, 1.0 / 16, 1.0 / 64, 0.0}) {
    if (share < 1) task.q_WP = task.X_WP.q;
    if (share > 0 && share < 1) task.q_WP = task.X_WP.q.slerp(share, wanted);
    const double turn = angle_between(task.X_WP.q, task.q_WP);
    ToolReach about{{task.base_W, task.X_WP.q}, task.reach_m, turn};
    for (reach_m_ = task.reach_m; reach_m_ >= kShortest; reach_m_ *= 0.5) {
      about.reach_m = reach_m_;
      if (field_.collect(about, task.before_WB, task.now_WB, near_pieces_, near_)) {
        recall();
        return true;
      }
    }
  }
  near_.count = 0;
  near_.field_count = 0;
  return false;
}

// Puts what is known of the pairs in the order of the candidates. Both lists grow, so that one pass
// over both finds what they share; most ticks have the candidates of the last one.
void ProxySolver::recall() {
  const auto listed = [&](std::uint32_t i) {
    return i < near_.count ? near_.pair[i] : PairMemory::kNone;
  };
  std::uint32_t same = 0;
  while (same < memory_.size() && memory_[same].pair == listed(same)) ++same;
  if (same == memory_.size()) return;
  for (std::uint32_t i = same; i < memory_.size(); ++i) last_[i] = memory_[i];
  std::uint32_t from = same;
  for (std::uint32_t i = same; i < memory_.size(); ++i) {
    const std::uint32_t pair = listed(i);
    while (from < memory_.size() && last_[from].pair < pair) ++from;
    if (pair != PairMemory::kNone && from < memory_.size() && last_[from].pair == pair) {
      memory_[i] = last_[from];
    } else if (memory_[i].pair != PairMemory::kNone || pair != PairMemory::kNone) {
      memory_[i] = {};
      memory_[i].pair = pair;
    }
  }
}

void ProxySolver::raise(std::uint32_t i) {
  const std::uint32_t pair = near_.pair[i];
  planes_[i] = field_.outer_half_space(pair, parting_[i], raised_WB_[field_.pairs()[pair].bone]);
  settled_[i] = false;
}

// Most planes never come into question: the tool's support is worked out for those that do.
void ProxySolver::settle(std::uint32_t i) {
  if (settled_[i]) return;
  settled_[i] = true;
  const std::uint32_t pair = near_.pair[i];
  const std::uint32_t bone = field_.pairs()[pair].bone;
  planes_[i] = field_.half_space(pair, parting_[i], raised_WB_[bone], raised_q_WT_);
  if (gap_known_[i]) return;
  const bool moved = raised_q_WT_.coeffs() != start_WT_.q.coeffs() ||
                     !same_pose(raised_WB_[bone], start_WB_[bone]);
  const FreeHalfSpace then =
      moved ? field_.half_space(pair, parting_[i], start_WB_[bone], start_WT_.q) : planes_[i];
  parting_[i].gap = then.n.dot(start_WT_.p) - then.c + kSkin;
  gap_known_[i] = true;
}

// Whether x is behind a piece's plane by more than the tolerance.
bool ProxySolver::beyond(std::uint32_t i, const Vec3& x) {
  if (!(planes_[i].n.dot(x) - planes_[i].c < -kPlaneTolerance)) return false;
  settle(i);
  return planes_[i].n.dot(x) - planes_[i].c < -kPlaneTolerance;
}

bool ProxySolver::inside_all(const Vec3& x) {
  for (std::uint32_t i = 0; i < near_.count; ++i)
    if (beyond(i, x)) return false;
  return true;
}

// nearest_point of the settled planes.
NearestPoint ProxySolver::nearest(const Vec3& wanted) {
  NearestSearch search(planes(), wanted);
  for (int step = 0; step < NearestSearch::kMaxSteps; ++step) {
    const Vec3 x = search.at();
    std::uint32_t worst = plane_count();
    double most = kPlaneTolerance;
    for (std::uint32_t i = 0; i < plane_count(); ++i) {
      if (!(planes_[i].c - planes_[i].n.dot(x) > most)) continue;
      if (i < near_.count) settle(i);
      const double shortfall = planes_[i].c - planes_[i].n.dot(x);
      if (!(shortfall > most)) continue;
      most = shortfall;
      worst = i;
    }
    if (worst == plane_count()) return search.result();
    if (!search.enter(worst)) return {};
  }
  return {};
}

// Parts one candidate with the tool at p_W, and remembers the plane.
bool ProxySolver::part(std::uint32_t i, const Vec3& p_W) {
  const std::uint32_t pair = near_.pair[i];
  const Pose& bone = raised_WB_[field_.pairs()[pair].bone];
  PairMemory& memory = memory_[i];
  if (!field_.separate(pair, bone, {p_W, raised_q_WT_}, memory.basis, parting_[i])) return false;
  memory.plane = parting_[i];
  memory.known = true;
  gap_known_[i] = true;
  raise(i);
  return true;
}

// A plane that parted a pair once lies beside the bone for ever. While the tool is beyond it, it
// will do: only a plane that comes to hold the proxy is worth finding again.
bool ProxySolver::part_all(std::span<const Pose> X_WB, const Pose& X_WT) {
  raised_WB_ = start_WB_ = X_WB;
  raised_q_WT_ = X_WT.q;
  start_WT_ = X_WT;
  for (std::uint32_t i = 0; i < near_.count; ++i) {
    const PairMemory& memory = memory_[i];
    if (memory.known) {
      parting_[i] = memory.plane;
      gap_known_[i] = false;
      raise(i);
      if (planes_[i].n.dot(X_WT.p) - planes_[i].c >= 0) continue;
      settle(i);
      if (planes_[i].n.dot(X_WT.p) - planes_[i].c >= 0) continue;
    }
    if (!part(i, X_WT.p)) return false;
  }
  walls_.start(near_);
  return walls_.look(X_WB, X_WT);
}

// Most ticks turn neither the tool nor a bone: then the pieces' planes are right as they are.
void ProxySolver::raise_planes(std::span<const Pose> X_WB, const Quat& q_WT) {
  const std::span<const Pose> last_WB = raised_WB_;
  const bool turned = raised_q_WT_.coeffs() != q_WT.coeffs();
  raised_WB_ = X_WB;
  raised_q_WT_ = q_WT;
  for (std::uint32_t i = 0; i < near_.count; ++i) {
    const std::uint32_t bone = field_.pairs()[near_.pair[i]].bone;
    if (turned || !same_pose(last_WB[bone], X_WB[bone])) raise(i);
  }
  walls_.raise(X_WB, q_WT, std::span(planes_).subspan(near_.count));
  tools_.raise(q_WT, std::span(planes_).subspan(bone_planes()));
  if (ring_) ring_->raise(q_WT, std::span(planes_).subspan(felt_planes()));
}

// The free point nearest to the task's start. A field's planes may have to be found again there.
bool ProxySolver::find_start(const ProxyTask& task, const Quat& q_WP, Vec3& start) {
  constexpr int kTries = 4;
  for (int i = 0; i < kTries; ++i) {
    raise_planes(task.now_WB, q_WP);
    const NearestPoint found = nearest(task.base_W);
    if (!found.found || (found.x - task.base_W).norm() > reach_m_) return false;
    start = found.x;
    if (near_.field_count == 0 || walls_.clear(task.now_WB, {start, q_WP})) return true;
    if (walls_.spent()) return false;
    if (!walls_.look(task.now_WB, {start, q_WP})) return false;
  }
  return false;
}

// Puts the start of the path at the free point nearest to the task's start.
bool ProxySolver::enter_free_space(const ProxyTask& task, const Quat& q_WP, ProxyMove& move) {
  Vec3 start;
  if (!find_start(task, q_WP, start)) return false;
  move.q_WP = q_WP;
  move.path[0] = start;
  move.path_count = 1;
  return true;
}

// Bones pinch the proxy: let it go wherever no overlap grows.
void ProxySolver::leave_overlap(const ProxyTask& task, ProxyMove& move) {
  raise_planes(task.now_WB, task.X_WP.q);
  for (std::uint32_t i = 0; i < near_.count; ++i) settle(i);
  for (std::uint32_t i = 0; i < plane_count(); ++i)
    planes_[i].c = std::min(planes_[i].c, planes_[i].n.dot(task.base_W));
  move.status |= kTickProxyBlocked;
  move.q_WP = task.X_WP.q;
  move.path[0] = task.base_W;
  move.path_count = 1;
  NearestPoint target;
  if (step_towards(task, move, target)) note_holding(task, target, move);
}

bool ProxySolver::step_towards(const ProxyTask& task, ProxyMove& move, NearestPoint& target) {
  target = nearest(task.hand_W);
  if (!target.found) {
    move.status |= kTickSolverLimit;
    return false;
  }
  const Vec3 from = move.end();
  const Vec3 to = clipped_to_ball(task.base_W, reach_m_, from, target.x);
  move.path[move.path_count++] = walls_.way(task.now_WB, move.q_WP, from, to);
  stopped_ = move.end() != to;
  return true;
}

// New planes at the path's end for the pairs that hold it back. The depth programme weighs
// distances, so its plane may ask for a little more room than the last one gave: less than the
// skin, which is granted if there is any.
bool ProxySolver::look_again(const ProxyTask& task, const NearestPoint& target, ProxyMove& move) {
  for (std::uint32_t k = 0; k < target.active_count; ++k)
    if (target.active[k] < near_.count && !part(target.active[k], move.end())) {
      move.status |= kTickSolverLimit;
      return false;
    }
  if (!walls_.look(task.now_WB, {move.end(), move.q_WP})) {
    move.status |= kTickSolverLimit;
    return false;
  }
  if (task.others_now)
    tools_.look(*task.others_now, {move.end(), move.q_WP}, task.hand_W - move.end());
  raise_planes(task.now_WB, move.q_WP);
  move.query_W = move.end();
  // A field's skin is wide enough for the next round to take care of it.
  if (inside_all(move.end())) return true;
  const NearestPoint lifted = nearest(move.end());
  if (!lifted.found || (lifted.x - move.end()).norm() > 10 * kSkin) return false;
  move.path[move.path_count - 1] = lifted.x;
  return true;
}

void ProxySolver::note_holding(const ProxyTask& task, const NearestPoint& target,
                               ProxyMove& move) const {
  move.holding_count = 0;
  for (std::uint32_t k = 0; k < target.active_count; ++k) {
    const std::uint32_t i = target.active[k];
    if (i >= felt_planes()) continue;  // skin, which has a force of its own
    if (gap_of(i) > kTouch && !task.held) continue;
    const double depth = planes_[i].c - planes_[i].n.dot(task.hand_W);
    HoldingPlane& plane = move.holding[move.holding_count++];
    plane = {0, kMaxHands, planes_[i].n, target.weight[k], depth, Vec3::Zero()};
    if (i >= bone_planes()) {
      plane.other = tools_.hand(i - bone_planes());
      plane.p_W = tools_.point_W(i - bone_planes());
      continue;
    }
    plane.pair = pair_of(i);
    plane.p_W = task.now_WB[field_.pairs()[plane.pair].bone] * plane_of(i).p_B;
  }
}

bool ProxySolver::touching(const NearestPoint& target) const {
  for (std::uint32_t k = 0; k < target.active_count; ++k)
    if (gap_of(target.active[k]) > kTouch) return false;
  return true;
}

void ProxySolver::approach(const ProxyTask& task, ProxyMove& move) {
  bool looked = false;  // at the field that stops it
  for (move.rounds = 1; move.rounds < ProxyMove::kMaxRounds; ++move.rounds) {
    const Vec3 from = move.end();
    NearestPoint target;
    if (!step_towards(task, move, target)) break;
    note_holding(task, target, move);
    move.free = target.active_count == 0 && move.end() == task.hand_W;
    // A plane whose gap was measured before bone or tool moved is looked at again.
    const bool felt = touching(target) || move.rounds > 1;
    const bool still = (move.end() - from).norm() < kStill && (!stopped_ || looked);
    if (move.free || (felt && still)) break;
    looked = stopped_;
    if (walls_.spent() || !look_again(task, target, move)) break;
  }
}

void ProxySolver::meet_tools(const ProxyTask& task) {
  tools_.clear();
  if (task.others_now)
    tools_.start(*task.others_before, *task.others_now, task.X_WP, task.hand_W - task.X_WP.p);
}

// Symbols: x is where the tool's origin may be, n_i.x >= c_i the half-space of plane i, hand_W what
// x is drawn to. Invariant: `path` lies in every half-space that it was found with, and each of
// these holds the whole tool clear of its piece; half-spaces are convex, so the straight ways
// between the path's points are free too. Source: Zilles and Salisbury, IROS 1995, with planes that
// come with a proof. Ends: a move is at most kMaxRounds - 1 rounds, a round one search for the
// nearest point, of NearestSearch::kMaxSteps steps at most.
ProxyMove ProxySolver::move(const ProxyTask& wanted, std::span<PairMemory> memory) {
  ProxyTask task = wanted;
  memory_ = memory;
  ring_ = task.ring;
  stopped_ = false;
  ProxyMove move;
  move.q_WP = task.X_WP.q;
  move.path[0] = task.base_W;
  move.path_count = 1;
  move.query_W = task.X_WP.p;
  reach_m_ = task.reach_m;
  if (!gather(task) || !part_all(task.before_WB, task.X_WP)) {
    move.status = kTickSolverLimit;
    return move;
  }
  if (task.q_WP.coeffs() != wanted.q_WP.coeffs()) move.status |= kTickRotationHeld;
  meet_tools(task);
  if (enter_free_space(task, task.q_WP, move)) {
    approach(task, move);
  } else if (enter_free_space(task, task.X_WP.q, move)) {
    move.status |= kTickRotationHeld;
    approach(task, move);
  } else {
    leave_overlap(task, move);
  }
  return move;
}

}  // namespace osteon
