#include <algorithm>
#include <cmath>

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

Vec3 three_at(const std::vector<double>& from, std::size_t at) {
  return {from[at], from[at + 1], from[at + 2]};
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
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
      finder(rod, held_frame) {
  for (const RodHeldAxis& a : supports.axes) held.push_back(node_at(a.node) + a.axis);
  for (const RodHeldFrame& f : supports.frames)
    for (std::size_t k = 0; k < 3; ++k) held.push_back(frame_at(f.segment) + k);
  const double second = 0.25 * rod.radius_m * rod.radius_m;  // of area, over the area
  for (std::size_t i = 0; i < rod.segments(); ++i) {
    const double mass = rod.material.density_kg_per_m3 * rod.length_m[i] * 3.141592653589793 *
                        rod.radius_m * rod.radius_m;
    inertia.push_back(mass * second * Vec3(1, 1, 2));
  }
}

void RodNewton::begin(const RodState& state) {
  start = {state.at_W, state.R_WS};
  aim = start;
  for (std::size_t i = 0; i < aim.x.size(); ++i) aim.x[i] += h * state.velocity_m_per_s[i];
  for (std::size_t i = 0; i < aim.q.size(); ++i)
    aim.q[i] = turned_by(aim.q[i], h * state.spin_rad_per_s[i]);
  force.resize(start.x.size());
  for (std::size_t i = 0; i < force.size(); ++i)
    force[i] = rod.mass_kg[i] * supports.gravity_m_per_s2;
  for (const NodeLoad& load : supports.loads)
    force[load.slot] += smooth_ramp(now_s, load.over_s).share * load.force_n;
  touches = finder.find(rod, supports, state);
  pose = aim;
  place_grips(pose);
}

void RodNewton::place_grips(RodPose& at) const {
  for (const RodHeldAxis& a : supports.axes)
    at.x[a.node][a.axis] = gripped_at(supports.grips[a.grip], rod.start_W[a.node], now_s)[a.axis];
  for (const RodHeldFrame& f : supports.frames) {
    const RodGrip& grip = supports.grips[f.grip];
    const double share = smooth_ramp(now_s, grip.over_s).share;
    at.q[f.segment] = turned(share * grip.turn_rad) * rod.start_R_WS[f.segment];
  }
}

// I / 2 |2 v|^2 with v the vector part of the turn from one frame to the other.
double RodNewton::turning_j(const Quat& from, const Quat& to, std::size_t i) const {
  const Vec3 v = (from.conjugate() * to).vec();
  return 2 * v.dot(inertia[i].cwiseProduct(v));
}

double RodNewton::potential(const RodPose& at) const {
  const double c = rod.material.damping_per_s;
  double sum = elastic_energy_j(rod, span, at);
  for (std::size_t i = 0; i < at.x.size(); ++i) {
    sum += 0.5 / (h * h) * rod.mass_kg[i] * (at.x[i] - aim.x[i]).squaredNorm();
    sum += 0.5 * c / h * rod.mass_kg[i] * (at.x[i] - start.x[i]).squaredNorm();
    sum -= force[i].dot(at.x[i] - start.x[i]);
  }
  for (std::size_t i = 0; i < at.q.size(); ++i)
    sum += turning_j(aim.q[i], at.q[i], i) / (h * h) + c / h * turning_j(start.q[i], at.q[i], i);
  for (const RodTouch& touch : touches)
    sum += contact_at(rod, supports, touch, finder.samples(), start.x, at.x).energy_j;
  return sum;
}

void RodNewton::add_turning(const Quat& from, std::size_t i, double weight) {
  const Quat r = from.conjugate() * pose.q[i];
  const Vec3 v = r.w() < 0 ? Vec3(-r.vec()) : Vec3(r.vec());
  const Vec3 u = 2 * weight * inertia[i].cwiseProduct(v);
  add_three(slope, frame_at(i), std::abs(r.w()) * u - v.cross(u));
  for (std::size_t k = 0; k < 3; ++k)
    band.at(frame_at(i) + k, frame_at(i) + k) += weight * inertia[i][static_cast<Eigen::Index>(k)];
}

void RodNewton::add_contacts() {
  contacts.clear();
  for (const RodTouch& touch : touches) {
    contacts.push_back(contact_at(rod, supports, touch, finder.samples(), start.x, pose.x));
    const RodContact& c = contacts.back();
    for (std::size_t a = 0; a < c.count; ++a) {
      add_three(slope, node_at(c.node[a]), c.weight[a] * c.slope);
      for (std::size_t b = a / 2 * 2; b <= a; ++b)  // within one segment
        for (std::size_t p = 0; p < 3; ++p)
          for (std::size_t q = 0; q < (a == b ? p + 1 : 3); ++q)
            band.at(node_at(c.node[a]) + p, node_at(c.node[b]) + q) +=
                c.weight[a] * c.weight[b] *
                c.stiffness(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(q));
    }
  }
}

void RodNewton::assemble(bool with_stiffness) {
  const double c = rod.material.damping_per_s;
  band.reset(unknowns(rod));
  slope.assign(unknowns(rod), 0.0);
  add_elastic(rod, span, pose, slope, with_stiffness ? &band : nullptr);
  for (std::size_t i = 0; i < pose.x.size(); ++i) {
    const double m = rod.mass_kg[i];
    add_three(
        slope, node_at(i),
        m / (h * h) * (pose.x[i] - aim.x[i]) + m * c / h * (pose.x[i] - start.x[i]) - force[i]);
    for (std::size_t k = 0; k < 3; ++k)
      band.at(node_at(i) + k, node_at(i) + k) += m / (h * h) + m * c / h;
  }
  for (std::size_t i = 0; i < pose.q.size(); ++i) {
    add_turning(aim.q[i], i, 1 / (h * h));
    if (c > 0) add_turning(start.q[i], i, c / h);
  }
  add_contacts();
}

// Blocks of touches between one segment and another, which the band has no place for.
void RodNewton::add_couplings(const std::vector<double>& x, std::vector<double>& out) const {
  for (const RodContact& c : contacts) {
    if (c.count < 4) continue;
    for (std::size_t a = 0; a < 2; ++a)
      for (std::size_t b = 2; b < 4; ++b) {
        const Mat3 k = c.weight[a] * c.weight[b] * c.stiffness;
        add_three(out, node_at(c.node[a]), k * three_at(x, node_at(c.node[b])));
        add_three(out, node_at(c.node[b]), k * three_at(x, node_at(c.node[a])));
      }
  }
  for (const std::size_t k : held) out[k] = 0;
}

// Conjugate gradients for (band + couplings) way = r0, preconditioned by the band: a touch's share
// in the band is at least half of it, so the rounds are few. Ends when the residual is a millionth.
void RodNewton::conjugate(const std::vector<double>& r0) {
  const RodBand whole = band;
  band.factor();
  std::vector<double> r = r0, z = r0, p, ap;
  way.assign(r.size(), 0.0);
  band.solve(z);
  p = z;
  double rz = dot(r, z);
  const double goal = 1e-12 * rz;
  for (int n = 0; n < kMostConjugate && rz > goal; ++n) {
    whole.multiply(p, ap);
    add_couplings(p, ap);
    const double pap = dot(p, ap);
    if (!(pap > 0)) return;
    const double by = rz / pap;
    for (std::size_t i = 0; i < r.size(); ++i) {
      way[i] += by * p[i];
      r[i] -= by * ap[i];
    }
    z = r;
    band.solve(z);
    const double next = dot(r, z), keep = next / rz;
    for (std::size_t i = 0; i < r.size(); ++i) p[i] = z[i] + keep * p[i];
    rz = next;
  }
}

void RodNewton::find_way() {
  std::vector<double> r(slope.size());
  for (std::size_t i = 0; i < r.size(); ++i) r[i] = -slope[i];
  for (const std::size_t k : held) {
    band.hold(k);
    r[k] = 0;
  }
  const bool coupled = std::any_of(contacts.begin(), contacts.end(), [](const RodContact& c) {
    return c.count == 4 && c.stiffness.trace() > 0;
  });
  if (coupled) return conjugate(r);
  band.factor();
  band.solve(r);
  way.swap(r);
}

void RodNewton::try_way(double share) {
  tried.x.resize(pose.x.size());
  tried.q.resize(pose.q.size());
  for (std::size_t i = 0; i < pose.x.size(); ++i)
    tried.x[i] = pose.x[i] + share * three_at(way, node_at(i));
  for (std::size_t i = 0; i < pose.q.size(); ++i)
    tried.q[i] =
        held_frame[i] ? pose.q[i] : turned_by(pose.q[i], share * three_at(way, frame_at(i)));
}

double RodNewton::largest() const {
  double most = 0;
  for (std::size_t i = 0; i < pose.x.size(); ++i)
    most = std::max(most, three_at(way, node_at(i)).squaredNorm() / (rod.radius_m * rod.radius_m));
  for (std::size_t i = 0; i < pose.q.size(); ++i)
    most = std::max(most, three_at(way, frame_at(i)).squaredNorm());
  return std::sqrt(most);
}

// One round of Newton's method; true when nothing is left to do. The way goes down the potential,
// since the matrix is positive; it is halved until the potential has fallen too, by a
// ten-thousandth of what the slope promised (Armijo 1966).
bool RodNewton::go() {
  assemble(true);
  find_way();
  const double size = largest();
  try_way(1);
  if (size > kSmall) {
    const double before = potential(pose), promised = dot(slope, way);
    double share = 1;
    for (int n = 0; n < kMostHalvings && !(potential(tried) <= before + 1e-4 * share * promised);
         ++n)
      try_way(share *= 0.5);
  }
  std::swap(pose, tried);
  return !(size > kStill);
}

void RodNewton::finish(RodState& state) {
  assemble(false);
  state.grip_n.assign(supports.grips.size(), Vec3::Zero());
  state.grip_n_m.assign(supports.grips.size(), Vec3::Zero());
  for (const RodHeldAxis& a : supports.axes) {
    Vec3 f = Vec3::Zero();
    f[a.axis] = slope[node_at(a.node) + a.axis];
    const RodGrip& grip = supports.grips[a.grip];
    const Vec3 middle = grip.middle_W + smooth_ramp(now_s, grip.over_s).share * grip.by_m;
    state.grip_n[a.grip] += f;
    state.grip_n_m[a.grip] += (pose.x[a.node] - middle).cross(f);
  }
  for (const RodHeldFrame& f : supports.frames)
    state.grip_n_m[f.grip] += pose.q[f.segment] * three_at(slope, frame_at(f.segment));
  state.sticks.clear();
  for (std::size_t i = 0; i < touches.size(); ++i)
    if (contacts[i].force_n > 0)
      state.sticks.push_back({touches[i].pair.sample, touches[i].pair.other, contacts[i].stick_m});
  for (std::size_t i = 0; i < pose.x.size(); ++i)
    state.velocity_m_per_s[i] = (pose.x[i] - start.x[i]) / h;
  for (std::size_t i = 0; i < pose.q.size(); ++i) {
    const Quat r = start.q[i].conjugate() * pose.q[i];
    state.spin_rad_per_s[i] = (r.w() < 0 ? -2 / h : 2 / h) * r.vec();
  }
  state.at_W = pose.x;
  state.R_WS = pose.q;
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
