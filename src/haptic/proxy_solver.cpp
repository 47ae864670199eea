#include "proxy_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "osteon/scene/state.h"
#include "rigid_motion.h"

namespace osteon {
namespace {

// The proxy stands still when a round moves it less than this, m.
constexpr double kStill = 4e-7;
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
bool ProxySolver::gather(Context& c) {
  constexpr double kShortest = 1e-5;
  ProxyTask& task = c.task;
  const Quat wanted = task.q_WP;
  for (const double share : {1.0, 0.25, 1.0 / 16, 1.0 / 64, 0.0}) {
    if (share < 1) task.q_WP = task.X_WP.q;
    if (share > 0 && share < 1) task.q_WP = task.X_WP.q.slerp(share, wanted);
    const double turn = angle_between(task.X_WP.q, task.q_WP);
    ToolReach about{{task.base_W, task.X_WP.q}, task.reach_m, turn};
    for (c.reach_m = task.reach_m; c.reach_m >= kShortest; c.reach_m *= 0.5) {
      about.reach_m = c.reach_m;
      if (field_.collect(about, task.before_WB, task.now_WB, around_, near_)) {
        recall(c);
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
void ProxySolver::recall(Context& c) {
  const std::span<PairMemory> memory = c.memory;
  const auto listed = [&](std::uint32_t i) {
    return i < near_.count ? near_.pair[i] : PairMemory::kNone;
  };
  std::uint32_t same = 0;
  while (same < memory.size() && memory[same].pair == listed(same)) ++same;
  if (same == memory.size()) return;
  for (std::uint32_t i = same; i < memory.size(); ++i) last_[i] = memory[i];
  std::uint32_t from = same;
  for (std::uint32_t i = same; i < memory.size(); ++i) {
    const std::uint32_t pair = listed(i);
    while (from < memory.size() && last_[from].pair < pair) ++from;
    if (pair != PairMemory::kNone && from < memory.size() && last_[from].pair == pair) {
      memory[i] = last_[from];
    } else if (memory[i].pair != PairMemory::kNone || pair != PairMemory::kNone) {
      memory[i] = {};
      memory[i].pair = pair;
    }
  }
}

void ProxySolver::raise(const Context& c, std::uint32_t i) {
  const std::uint32_t pair = near_.pair[i];
  planes_[i] = field_.outer_half_space(pair, parting_[i], c.raised_WB[field_.pairs()[pair].bone]);
  settled_[i] = false;
}

// Most planes never come into question: the tool's support is worked out for those that do.
void ProxySolver::settle(const Context& c, std::uint32_t i) {
  if (settled_[i]) return;
  settled_[i] = true;
  const std::uint32_t pair = near_.pair[i];
  const std::uint32_t bone = field_.pairs()[pair].bone;
  planes_[i] = field_.half_space(pair, parting_[i], c.raised_WB[bone], c.raised_q_WT);
  if (gap_known_[i]) return;
  const bool moved = c.raised_q_WT.coeffs() != c.start_WT.q.coeffs() ||
                     !same_pose(c.raised_WB[bone], c.start_WB[bone]);
  const FreeHalfSpace then =
      moved ? field_.half_space(pair, parting_[i], c.start_WB[bone], c.start_WT.q) : planes_[i];
  parting_[i].gap = then.n.dot(c.start_WT.p) - then.c + kSkin;
  gap_known_[i] = true;
}

// Whether x is behind a piece's plane by more than the tolerance.
bool ProxySolver::beyond(const Context& c, std::uint32_t i, const Vec3& x) {
  if (!(planes_[i].n.dot(x) - planes_[i].c < -kPlaneTolerance)) return false;
  settle(c, i);
  return planes_[i].n.dot(x) - planes_[i].c < -kPlaneTolerance;
}

bool ProxySolver::inside_all(const Context& c, const Vec3& x) {
  for (std::uint32_t i = 0; i < near_.count; ++i)
    if (beyond(c, i, x)) return false;
  return true;
}

// nearest_point of the settled planes.
NearestPoint ProxySolver::nearest(const Context& c, const Vec3& wanted) {
  NearestSearch search(planes(c), wanted);
  for (int step = 0; step < NearestSearch::kMaxSteps; ++step) {
    const Vec3 x = search.at();
    std::uint32_t worst = plane_count(c);
    double most = kPlaneTolerance;
    for (std::uint32_t i = 0; i < plane_count(c); ++i) {
      if (!(planes_[i].c - planes_[i].n.dot(x) > most)) continue;
      if (i < near_.count) settle(c, i);
      const double shortfall = planes_[i].c - planes_[i].n.dot(x);
      if (!(shortfall > most)) continue;
      most = shortfall;
      worst = i;
    }
    if (worst == plane_count(c)) return search.result();
    if (!search.enter(worst)) return {};
  }
  return {};
}

// Parts one candidate with the tool at p_W, and remembers the plane.
bool ProxySolver::part(Context& c, std::uint32_t i, const Vec3& p_W) {
  const std::uint32_t pair = near_.pair[i];
  const Pose& bone = c.raised_WB[field_.pairs()[pair].bone];
  PairMemory& memory = c.memory[i];
  if (!field_.separate(pair, bone, {p_W, c.raised_q_WT}, memory.basis, parting_[i])) return false;
  memory.plane = parting_[i];
  memory.known = true;
  looked_[i] = true;
  gap_known_[i] = true;
  raise(c, i);
  return true;
}

// A plane that parted a pair once lies beside the bone for ever. While the tool is beyond it, it
// will do: only a plane that comes to hold the proxy is worth finding again.
bool ProxySolver::part_all(Context& c) {
  const std::span<const Pose> X_WB = c.task.before_WB;
  const Pose& X_WT = c.task.X_WP;
  c.raised_WB = c.start_WB = X_WB;
  c.raised_q_WT = X_WT.q;
  c.start_WT = X_WT;
  for (std::uint32_t i = 0; i < near_.count; ++i) {
    const PairMemory& memory = c.memory[i];
    if (memory.known) {
      parting_[i] = memory.plane;
      gap_known_[i] = false;
      raise(c, i);
      if (planes_[i].n.dot(X_WT.p) - planes_[i].c >= 0) continue;
      settle(c, i);
      if (planes_[i].n.dot(X_WT.p) - planes_[i].c >= 0) continue;
    }
    if (!part(c, i, X_WT.p)) return false;
  }
  walls_.start(near_);
  return walls_.look(X_WB, X_WT);
}

// Most ticks turn neither the tool nor a bone: then the pieces' planes are right as they are.
void ProxySolver::raise_planes(Context& c, const Quat& q_WT) {
  const std::span<const Pose> X_WB = c.task.now_WB;
  const std::span<const Pose> last_WB = c.raised_WB;
  const bool turned = c.raised_q_WT.coeffs() != q_WT.coeffs();
  c.raised_WB = X_WB;
  c.raised_q_WT = q_WT;
  for (std::uint32_t i = 0; i < near_.count; ++i) {
    const std::uint32_t bone = field_.pairs()[near_.pair[i]].bone;
    if (turned || !same_pose(last_WB[bone], X_WB[bone])) raise(c, i);
  }
  walls_.raise(X_WB, q_WT, std::span(planes_).subspan(near_.count));
  tools_.raise(q_WT, std::span(planes_).subspan(bone_planes()));
  if (c.task.ring) c.task.ring->raise(q_WT, std::span(planes_).subspan(felt_planes()));
}

// The free point nearest to the task's start. A field's planes may have to be found again there.
bool ProxySolver::find_start(Context& c, const Quat& q_WP, Vec3& start) {
  const ProxyTask& task = c.task;
  constexpr int kTries = 4;
  for (int i = 0; i < kTries; ++i) {
    raise_planes(c, q_WP);
    const NearestPoint found = nearest(c, task.base_W);
    if (!found.found || (found.x - task.base_W).norm() > c.reach_m) return false;
    start = found.x;
    if (near_.field_count == 0 || walls_.clear(task.now_WB, {start, q_WP})) return true;
    if (walls_.spent()) return false;
    if (!walls_.look(task.now_WB, {start, q_WP})) return false;
  }
  return false;
}

// A plane that still parts its pair may be in the way of a turn that the bone is not: one that was
// found in a slot, above it. Such planes are found again where the tool stands, before the turn.
// They stay only if each leaves much more room, and a tool that bone holds keeps its planes: new
// ones would let it turn on by pushing the tool aside.
bool ProxySolver::part_better(Context& c) {
  constexpr double kMore_m = 1e-4;
  std::array<std::uint32_t, kMaxCandidates> held{};
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < near_.count; ++i)
    if (beyond(c, i, c.task.base_W)) held[count++] = i;
  c.raised_WB = c.start_WB;
  c.raised_q_WT = c.start_WT.q;
  for (std::uint32_t i = 0; i < near_.count; ++i) raise(c, i);
  bool better = count > 0;
  std::uint32_t done = 0;
  for (; done < count && better; ++done) {
    const std::uint32_t i = held[done];
    last_[done] = c.memory[i];
    settle(c, i);
    const double room_m = planes_[i].n.dot(c.start_WT.p) - planes_[i].c;
    better = part(c, i, c.start_WT.p) && parting_[i].gap > 2 * room_m + kMore_m;
  }
  for (std::uint32_t k = 0; !better && k < done; ++k) {
    const std::uint32_t i = held[k];
    c.memory[i] = last_[k];
    parting_[i] = last_[k].plane;
    gap_known_[i] = false;
    raise(c, i);
  }
  return better;
}

// Puts the start of the path at the free point nearest to the task's start.
bool ProxySolver::enter_free_space(Context& c, const Quat& q_WP, ProxyMove& move) {
  Vec3 start;
  if (!find_start(c, q_WP, start)) return false;
  move.q_WP = q_WP;
  move.path[0] = start;
  move.path_count = 1;
  return true;
}

// Bones pinch the proxy: let it go wherever no overlap grows.
void ProxySolver::leave_overlap(Context& c, ProxyMove& move) {
  const ProxyTask& task = c.task;
  raise_planes(c, task.X_WP.q);
  for (std::uint32_t i = 0; i < near_.count; ++i) settle(c, i);
  for (std::uint32_t i = 0; i < plane_count(c); ++i)
    planes_[i].c = std::min(planes_[i].c, planes_[i].n.dot(task.base_W));
  move.status |= kTickProxyBlocked;
  move.q_WP = task.X_WP.q;
  move.path[0] = task.base_W;
  move.path_count = 1;
  NearestPoint target;
  if (!step_towards(c, move, target)) return;
  note_holding(task, target, move, kTouch);
  const bool still = (move.end() - move.path[0]).norm() < kStill;
  if (!still || move.holding_count > 0) return;
  // What keeps it there may leave a gap on every side: the push is felt all the same, or a drill
  // would stand still there for good.
  note_holding(task, target, move, std::numeric_limits<double>::infinity());
  if (move.holding_count == 0 && walls_.is_blocked()) note_block(c, target, move);
}

bool ProxySolver::step_towards(Context& c, ProxyMove& move, NearestPoint& target) {
  const ProxyTask& task = c.task;
  target = nearest(c, task.hand_W);
  if (!target.found) {
    move.status |= kTickSolverLimit;
    return false;
  }
  const Vec3 from = move.end();
  const Vec3 to = clipped_to_ball(task.base_W, c.reach_m, from, target.x);
  move.path[move.path_count++] = walls_.way(task.now_WB, move.q_WP, from, to);
  c.stopped = move.end() != to;
  return true;
}

// New planes at the path's end for the pairs that hold it back. The depth programme weighs
// distances, so its plane may ask for a little more room than the last one gave: less than the
// skin, which is granted if there is any.
bool ProxySolver::look_again(Context& c, const NearestPoint& target, ProxyMove& move) {
  const ProxyTask& task = c.task;
  for (std::uint32_t k = 0; k < target.active_count; ++k)
    if (target.active[k] < near_.count && !part(c, target.active[k], move.end())) {
      move.status |= kTickSolverLimit;
      return false;
    }
  const bool looked = c.stuck ? walls_.look_ahead(task.now_WB, move.q_WP)
                              : walls_.look(task.now_WB, {move.end(), move.q_WP});
  if (!looked) {
    move.status |= kTickSolverLimit;
    return false;
  }
  if (task.others_now)
    tools_.look(*task.others_now, {move.end(), move.q_WP}, task.hand_W - move.end());
  raise_planes(c, move.q_WP);
  move.query_W = move.end();
  // A field's skin is wide enough for the next round to take care of it.
  if (inside_all(c, move.end())) return true;
  const NearestPoint lifted = nearest(c, move.end());
  if (!lifted.found || (lifted.x - move.end()).norm() > 10 * kSkin) return false;
  move.path[move.path_count - 1] = lifted.x;
  return true;
}

void ProxySolver::note_holding(const ProxyTask& task, const NearestPoint& target, ProxyMove& move,
                               double most_gap_m) const {
  move.holding_count = 0;
  for (std::uint32_t k = 0; k < target.active_count; ++k) {
    const std::uint32_t i = target.active[k];
    if (i >= felt_planes()) continue;  // skin, which has a force of its own
    if (gap_of(i) > most_gap_m && !task.held) continue;
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

// Every piece's plane that holds it was found in this move. Of two that lie in one plane the search
// names one; the other comes to hold once the first has gone.
bool ProxySolver::looked(const NearestPoint& target) const {
  for (std::uint32_t k = 0; k < target.active_count; ++k)
    if (target.active[k] < near_.count && !looked_[target.active[k]]) return false;
  return true;
}

void ProxySolver::approach(Context& c, ProxyMove& move) {
  const ProxyTask& task = c.task;
  c.stuck = false;
  for (move.rounds = 1; move.rounds < ProxyMove::kMaxRounds; ++move.rounds) {
    const Vec3 from = move.end();
    NearestPoint target;
    if (!step_towards(c, move, target)) break;
    note_holding(task, target, move, kTouch);
    move.free = target.active_count == 0 && move.end() == task.hand_W;
    // A plane whose gap was measured before bone or tool moved is looked at again: it may have been
    // found from far away, where there is no bone.
    const bool felt = touching(target) || (move.rounds > 1 && looked(target));
    const bool still = (move.end() - from).norm() < kStill;
    if (still && walls_.is_blocked() && (c.stuck || walls_.spent())) note_block(c, target, move);
    if (move.free || (felt && still && (!c.stopped || c.stuck))) break;
    // Where it stands still before bone that no plane names, the bone is looked at from nearer.
    c.stuck = still && walls_.is_blocked();
    if (walls_.spent() || !look_again(c, target, move)) break;
  }
}

// Bone that ends the way but that no plane names, as over a hole whose rims hold the tool all
// round, holds against the push itself: what stands still before bone must feel it.
void ProxySolver::note_block(const Context& c, const NearestPoint& target, ProxyMove& move) {
  const ProxyTask& task = c.task;
  const Vec3 left = move.end() - target.x;
  const double size = left.norm();
  if (!(size > kTouch) || move.holding_count == move.holding.size()) return;
  PartingPlane met;
  if (!walls_.blocking(task.now_WB, move.q_WP, met)) return;
  const std::uint32_t pair = walls_.blocked_by();
  const Pose& X_WB = task.now_WB[field_.pairs()[pair].bone];
  move.holding[move.holding_count++] = {pair, kMaxHands, Vec3(left / size),
                                        size, size,      X_WB * met.p_B};
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
  Context c{wanted, memory, wanted.reach_m};
  const ProxyTask& task = c.task;
  ProxyMove move;
  move.q_WP = task.X_WP.q;
  move.path[0] = task.base_W;
  move.path_count = 1;
  move.query_W = task.X_WP.p;
  looked_.fill(false);
  if (!gather(c) || !part_all(c)) {
    move.status = kTickSolverLimit;
    return move;
  }
  if (task.q_WP.coeffs() != wanted.q_WP.coeffs()) move.status |= kTickRotationHeld;
  meet_tools(task);
  if (enter_free_space(c, task.q_WP, move) ||
      (!task.held && part_better(c) && enter_free_space(c, task.q_WP, move))) {
    approach(c, move);
  } else if (enter_free_space(c, task.X_WP.q, move)) {
    move.status |= kTickRotationHeld;
    approach(c, move);
  } else {
    leave_overlap(c, move);
  }
  return move;
}

}  // namespace osteon
