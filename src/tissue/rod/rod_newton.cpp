#include <algorithm>
#include <cmath>
#include <set>

#include "rod/rod_newton.h"

namespace osteon::rods {
namespace {

constexpr int kMostRounds = 8;   // of Newton's method a step
constexpr double kStill = 1e-6;  // of the radius (and radians): balanced
constexpr double kSmall = 1e-2;  // of the same: so small a way needs no search along it
constexpr int kMostHalvings = 12;
constexpr int kMostConjugate = 60;

Quat turned(const Vec3& axis_angle) {
  const double angle = axis_angle.norm();
  if (!(angle > 0)) return Quat::Identity();
  const Vec3 v = std::sin(0.5 * angle) / angle * axis_angle;
  return {std::cos(0.5 * angle), v.x(), v.y(), v.z()};
}

Vec3 gripped_at(const RodGrip& grip, const Vec3& start_W, double time_s) {
  const double share = smooth_ramp(time_s, grip.over_s).share;
  return grip.middle_W + share * grip.by_m +
         turned(share * grip.turn_rad) * Vec3(start_W - grip.middle_W);
}

// Registers' worth of places in which an axis or a frame is held.
std::vector<long> parts_held(const RodSupports& supports) {
  std::set<long> out;
  for (const RodHeldAxis& a : supports.axes) out.insert(a.node / kRowGuard * kRowGuard);
  for (const RodHeldFrame& f : supports.frames) out.insert(f.segment / kRowGuard * kRowGuard);
  return {out.begin(), out.end()};
}

// Of a round section, about an axis across it.
std::vector<double> inertias(const Rod& rod) {
  const double second = 0.25 * rod.radius_m * rod.radius_m;  // of area, over the area
  std::vector<double> out;
  for (const double length : rod.length_m)
    out.push_back(rod.material.density_kg_per_m3 * length * 3.141592653589793 * rod.radius_m *
                  rod.radius_m * second);
  return out;
}

std::vector<bool> held_frames(const Rod& rod, const RodSupports& supports) {
  std::vector<bool> out(rod.segments(), false);
  for (const RodHeldFrame& f : supports.frames) out[f.segment] = true;
  return out;
}

}  // namespace

RodNewton::RodNewton(Rod r, RodSupports s, double step_s)
    : rod(std::move(r)),
      supports(std::move(s)),
      dt(step_s),
      held_frame(held_frames(rod, supports)),
      span(spans(rod, held_frame)),
      inertia(inertias(rod)),
      finder(rod, held_frame),
      system(rod, span, inertia),
      held_parts(parts_held(supports)) {}

void RodNewton::begin(const RodState& state) {
  start_x = state.at_W;
  for (std::size_t i = 0; i < start_x.size(); ++i) {
    system.set_three(kPlace, i, state.at_W[i]);
    system.set_three(kWay, i, h * state.velocity_m_per_s[i]);
    system.set_three(kForce, i, rod.mass_kg[i] * supports.gravity_m_per_s2);
  }
  for (std::size_t i = 0; i < held_frame.size(); ++i) {
    system.set_quat(kFrame, i, state.R_WS[i]);
    system.set_three(kWay + 3, i, h * state.spin_rad_per_s[i]);
  }
  for (const NodeLoad& load : supports.loads)
    system.add_three(kForce, load.slot, smooth_ramp(now_s, load.over_s).share * load.force_n);
  system.copy_pose(kPlace, kStartPlace);
  system.go(1, kAimPlace);
  system.copy_pose(kAimPlace, kPlace);
  place_grips();
  touches = finder.find(rod, supports, state);
  settling = false;
}

void RodNewton::place_grips() {
  for (const RodHeldAxis& a : supports.axes)
    system.at(kPlace + a.axis, a.node) =
        gripped_at(supports.grips[a.grip], rod.start_W[a.node], now_s)[a.axis];
  for (const RodHeldFrame& f : supports.frames) {
    const RodGrip& grip = supports.grips[f.grip];
    const double share = smooth_ramp(now_s, grip.over_s).share;
    system.set_quat(kFrame, f.segment, turned(share * grip.turn_rad) * rod.start_R_WS[f.segment]);
  }
}

RodNumbers RodNewton::numbers() const {
  const RodSection& k = rod.section;
  return {k.shear_n,    k.stretch_n, k.bend_n_m2,
          k.twist_n_m2, 1 / (h * h), rod.material.damping_per_s / h};
}

// I / 2 |2 v|^2 with v the vector part of the turn from one frame to the other.
double RodNewton::turning_j(const Quat& from, const Quat& to, std::size_t i) const {
  const Vec3 v = (from.conjugate() * to).vec();
  return 2 * inertia[i] * v.dot(Vec3(1, 1, 2).cwiseProduct(v));
}

double RodNewton::potential(const RodPose& at) const {
  const double c = rod.material.damping_per_s;
  double sum = elastic_energy_j(rod, span, at);
  for (std::size_t i = 0; i < at.x.size(); ++i) {
    const Vec3 aim = system.three(kAimPlace, i), moved = at.x[i] - start_x[i];
    sum += 0.5 / (h * h) * rod.mass_kg[i] * (at.x[i] - aim).squaredNorm();
    sum += 0.5 * c / h * rod.mass_kg[i] * moved.squaredNorm();
    sum -= system.three(kForce, i).dot(moved);
  }
  for (std::size_t i = 0; i < at.q.size(); ++i)
    sum += turning_j(system.quat(kAimFrame, i), at.q[i], i) / (h * h) +
           c / h * turning_j(system.quat(kStartFrame, i), at.q[i], i);
  for (const RodTouch& touch : touches)
    sum += contact_at(rod, supports, touch, finder.samples(), start_x, at.x).energy_j;
  return sum;
}

void RodNewton::add_contacts(bool with_stiffness) {
  contacts.clear();
  if (touches.empty()) return;
  x.resize(start_x.size());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = system.three(kPlace, i);
  for (const RodTouch& touch : touches) {
    contacts.push_back(contact_at(rod, supports, touch, finder.samples(), start_x, x));
    const RodContact& c = contacts.back();
    for (std::size_t a = 0; a < c.count; ++a)
      system.add_three(kSlope, c.node[a], c.weight[a] * c.slope);
    if (!with_stiffness) continue;
    for (std::size_t a = 0; a < c.count; a += 2) {  // within one segment
      system.add_node_block(c.node[a], c.weight[a] * c.weight[a] * c.stiffness);
      system.add_node_block(c.node[a + 1], c.weight[a + 1] * c.weight[a + 1] * c.stiffness);
      system.add_node_node(c.node[a], c.weight[a] * c.weight[a + 1] * c.stiffness);
    }
  }
}

void RodNewton::assemble(bool with_stiffness) {
  system.assemble(numbers(), with_stiffness);
  add_contacts(with_stiffness);
  if (!with_stiffness) return;
  for (const RodHeldAxis& a : supports.axes) system.hold_axis(a.node, a.axis);
  for (const RodHeldFrame& f : supports.frames) system.hold_frame(f.segment);
}

void RodNewton::release(RodSystem::Values& values) const {
  for (const RodHeldAxis& a : supports.axes) values[system.index(a.axis, a.node)] = 0;
  for (const RodHeldFrame& f : supports.frames)
    for (long k = 3; k < 6; ++k) values[system.index(k, f.segment)] = 0;
}

// Blocks of touches between one segment and another, which the chain's matrix has no place for.
void RodNewton::add_couplings(const RodSystem::Values& at, RodSystem::Values& out) const {
  const auto add = [&](std::size_t to, std::size_t from, const Mat3& k) {
    for (long r = 0; r < 3; ++r)
      for (long c = 0; c < 3; ++c) out[system.index(r, to)] += k(r, c) * at[system.index(c, from)];
  };
  for (const RodContact& c : contacts) {
    if (c.count < 4) continue;
    for (std::size_t a = 0; a < 2; ++a)
      for (std::size_t b = 2; b < 4; ++b) {
        const Mat3 k = c.weight[a] * c.weight[b] * c.stiffness;
        add(c.node[a], c.node[b], k);
        add(c.node[b], c.node[a], k);
      }
  }
  release(out);
}

// Conjugate gradients for (chain + couplings) way = -slope, preconditioned by the chain: a touch's
// share in it is at least half of the touch, so the rounds are few. Ends when the residual is a
// millionth.
void RodNewton::conjugate() {
  RodSystem::Values r = system.values_of(kWay), z = r, p, ap, found(r.size(), 0.0);
  system.solve(z);
  p = z;
  double rz = RodSystem::dot(r, z);
  const double goal = 1e-12 * rz;
  for (int n = 0; n < kMostConjugate && rz > goal; ++n) {
    system.multiply(p, ap);
    add_couplings(p, ap);
    const double pap = RodSystem::dot(p, ap);
    if (!(pap > 0)) break;
    const double by = rz / pap;
    for (std::size_t i = 0; i < r.size(); ++i) {
      found[i] += by * p[i];
      r[i] -= by * ap[i];
    }
    z = r;
    system.solve(z);
    const double next = RodSystem::dot(r, z), keep = next / rz;
    for (std::size_t i = 0; i < r.size(); ++i) p[i] = z[i] + keep * p[i];
    rz = next;
  }
  system.set_values(kWay, found);
}

void RodNewton::find_way() {
  system.take_slope();
  for (const RodHeldAxis& a : supports.axes) system.at(kWay + a.axis, a.node) = 0;
  for (const RodHeldFrame& f : supports.frames) system.set_three(kWay + 3, f.segment, Vec3::Zero());
  const bool coupled = std::any_of(contacts.begin(), contacts.end(), [](const RodContact& c) {
    return c.count == 4 && c.stiffness.trace() > 0;
  });
  if (!settling) system.factor();
  if (coupled) return conjugate();
  system.solve_way();
}

void RodNewton::try_way(double share) {
  system.go(share, kTriedPlace);
  for (const RodHeldFrame& f : supports.frames)
    system.set_quat(kTriedFrame, f.segment, system.quat(kFrame, f.segment));
}

// One round of Newton's method; true when nothing is left to do. The way goes down the potential,
// since the matrix is positive; it is halved until the potential has fallen too, by a
// ten-thousandth of what the slope promised (Armijo 1966). After a way that needed no search, and
// where nothing may touch, the matrix is nearly the same: the next round keeps its factors, as long
// as ways become ten times shorter.
bool RodNewton::go() {
  assemble(!settling);
  find_way();
  const double size = system.largest_way(1 / rod.radius_m);
  try_way(1);
  if (size > kSmall) {
    const double before = potential(system.pose(kPlace));
    const double promised = RodSystem::dot(system.values_of(kSlope), system.values_of(kWay));
    double share = 1;
    for (int n = 0; n < kMostHalvings &&
                    !(potential(system.pose(kTriedPlace)) <= before + 1e-4 * share * promised);
         ++n)
      try_way(share *= 0.5);
  }
  system.copy_pose(kTriedPlace, kPlace);
  const bool shorter = !settling || size < 0.1 * last_size;
  settling = touches.empty() && size <= kSmall && shorter;
  last_size = size;
  return !(size > kStill);
}

void RodNewton::finish(RodState& state) {
  for (const long first : held_parts) system.assemble_part(numbers(), first, first + kRowGuard);
  add_contacts(false);
  state.grip_n.assign(supports.grips.size(), Vec3::Zero());
  state.grip_n_m.assign(supports.grips.size(), Vec3::Zero());
  for (const RodHeldAxis& a : supports.axes) {
    Vec3 f = Vec3::Zero();
    f[a.axis] = system.at(kSlope + a.axis, a.node);
    const RodGrip& grip = supports.grips[a.grip];
    const Vec3 middle = grip.middle_W + smooth_ramp(now_s, grip.over_s).share * grip.by_m;
    state.grip_n[a.grip] += f;
    state.grip_n_m[a.grip] += (system.three(kPlace, a.node) - middle).cross(f);
  }
  for (const RodHeldFrame& f : supports.frames)
    state.grip_n_m[f.grip] += system.quat(kFrame, f.segment) * system.three(kSlope + 3, f.segment);
  state.sticks.clear();
  for (std::size_t i = 0; i < touches.size(); ++i)
    if (contacts[i].force_n > 0)
      state.sticks.push_back({touches[i].pair.sample, touches[i].pair.other, contacts[i].stick_m});
  const double per_h = 1 / h;
  for (std::size_t i = 0; i < start_x.size(); ++i) {
    state.at_W[i] = system.three(kPlace, i);
    state.velocity_m_per_s[i] = per_h * (state.at_W[i] - start_x[i]);
  }
  for (std::size_t i = 0; i < held_frame.size(); ++i) {
    const Quat q = system.quat(kFrame, i), &a = state.R_WS[i];
    // The turn from a to q, by its numbers: stored and loaded again they would take longer.
    const double w = a.w() * q.w() + a.x() * q.x() + a.y() * q.y() + a.z() * q.z();
    const double twice = w < 0 ? -2 * per_h : 2 * per_h;
    state.spin_rad_per_s[i] = {
        twice * (a.w() * q.x() - a.x() * q.w() - a.y() * q.z() + a.z() * q.y()),
        twice * (a.w() * q.y() - a.y() * q.w() - a.z() * q.x() + a.x() * q.z()),
        twice * (a.w() * q.z() - a.z() * q.w() - a.x() * q.y() + a.y() * q.x())};
    state.R_WS[i] = q;
  }
}

void RodNewton::advance(RodState& state, double from_s, double length_s) {
  h = length_s;
  now_s = from_s + length_s;
  begin(state);
  for (int n = 0; n < kMostRounds; ++n)
    if (go()) break;
  finish(state);
}

}  // namespace osteon::rods
