#include "rod/rod_contact.h"

#include <algorithm>
#include <cmath>

namespace osteon::rods {
namespace {

constexpr double kSpacing = 0.75;    // between samples, of the radius
constexpr double kApart = 3.2;       // of the rod nearer than this many radii along it: no contact
constexpr double kReach = 0.6;       // of the radius: looked at before it touches
constexpr double kListed = 2;        // of the radius, at least: listed as near
constexpr std::uint32_t kGroup = 8;  // segments

struct NearestOnRod {
  double share = 0;         // along the other segment
  Vec3 way = Vec3::Zero();  // from the other to the point
};

NearestOnRod nearest_on(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Vec3 ab = b - a;
  const double square = ab.squaredNorm();
  const double share = square > 0 ? std::clamp((p - a).dot(ab) / square, 0.0, 1.0) : 0.0;
  return {share, p - (a + share * ab)};
}

Vec3 place(const RodSample& s, const std::vector<Vec3>& x) {
  return (1 - s.share) * x[s.segment] + s.share * x[s.segment + 1];
}

NearestOnRod nearest(const Rod& rod, const RodSupports& supports, const RodPair& pair,
                     const Vec3& p, const std::vector<Vec3>& x) {
  if (pair.other < rod.segments()) return nearest_on(x[pair.other], x[pair.other + 1], p);
  const RodObstacle& o = supports.obstacles[pair.other - rod.segments()];
  return nearest_on(o.from_W, o.to_W, p);
}

double reach_of(const Rod& rod, const RodSupports& supports, std::uint32_t other) {
  if (other < rod.segments()) return 2 * rod.radius_m;
  return rod.radius_m + supports.obstacles[other - rod.segments()].radius_m;
}

double friction_of(const Rod& rod, const RodSupports& supports, std::uint32_t other) {
  return other < rod.segments() ? rod.friction
                                : supports.obstacles[other - rod.segments()].friction;
}

// Both sorted by sample, then other.
const RodStick* stick_of(const std::vector<RodStick>& sticks, const RodPair& pair) {
  const auto at =
      std::lower_bound(sticks.begin(), sticks.end(), pair, [](const RodStick& s, const RodPair& p) {
        return s.sample != p.sample ? s.sample < p.sample : s.other < p.other;
      });
  const bool found = at != sticks.end() && at->sample == pair.sample && at->other == pair.other;
  return found ? &*at : nullptr;
}

// Friction holds with the contact's own stiffness up to its bound, then slides:
//   energy k/2 |e|^2 to |e| = bound / k, then bound (|e| - bound / (2 k)).
void add_friction(const RodTouch& touch, const Vec3& moved, RodContact& c) {
  const Vec3 e = touch.stick_m + moved - touch.normal.dot(touch.stick_m + moved) * touch.normal;
  const double length = e.norm(), k = touch.stiffness, most = touch.hold_n / k;
  const Mat3 across = Mat3::Identity() - touch.normal * touch.normal.transpose();
  c.stick_m = length <= most ? e : Vec3(most / length * e);
  c.energy_j += length <= most ? 0.5 * k * length * length : touch.hold_n * (length - 0.5 * most);
  c.slope += k * c.stick_m;
  c.stiffness += (length <= most ? k : touch.hold_n / length) * across;
}

// A bound from below on how far a segment's middle line is from another or from an obstacle's.
double apart_at_least(const Rod& rod, const RodSupports& supports, const RodPair& segment,
                      const std::vector<Vec3>& x) {
  const std::uint32_t i = segment.sample;
  const Vec3 middle = 0.5 * (x[i] + x[i + 1]);
  const double half = 0.5 * (x[i + 1] - x[i]).norm();
  if (segment.other >= rod.segments())
    return nearest(rod, supports, segment, middle, x).way.norm() - half;
  const Vec3 &a = x[segment.other], &b = x[segment.other + 1];
  return (middle - 0.5 * (a + b)).norm() - half - 0.5 * (b - a).norm();
}

/// A ball around a segment or some of them.
struct RodBall {
  Vec3 middle = Vec3::Zero();
  double radius_m = 0;
};

RodBall ball_about(const std::vector<RodBall>& balls, std::uint32_t first, std::uint32_t last) {
  RodBall out;
  for (std::uint32_t i = first; i < last; ++i) out.middle += balls[i].middle / (last - first);
  for (std::uint32_t i = first; i < last; ++i)
    out.radius_m =
        std::max(out.radius_m, (balls[i].middle - out.middle).norm() + balls[i].radius_m);
  return out;
}

bool within(const RodBall& a, const RodBall& b, double far_m) {
  const double reach = far_m + a.radius_m + b.radius_m;
  return (a.middle - b.middle).squaredNorm() < reach * reach;
}

RodTouch touch_of(const Rod& rod, const RodSupports& supports, const RodPair& pair,
                  const RodSample& sample, const NearestOnRod& at, const RodStick* stick) {
  RodTouch out;
  const bool own = pair.other < rod.segments();
  out.pair = pair;
  out.weight = {1 - sample.share, sample.share, own ? at.share - 1 : 0, own ? -at.share : 0};
  // On the rod itself each of the two touching parts has samples.
  out.stiffness = (own ? 0.5 : 1.0) * sample.stiffness;
  out.reach_m = reach_of(rod, supports, pair.other);
  const double apart = at.way.norm();
  out.normal = apart > 0 ? Vec3(at.way / apart) : Vec3(Vec3::UnitX());
  out.hold_n =
      friction_of(rod, supports, pair.other) * out.stiffness * std::max(out.reach_m - apart, 0.0);
  if (stick) out.stick_m = stick->way_m;
  return out;
}

}  // namespace

std::vector<RodSample> samples_of(const Rod& rod) {
  std::vector<RodSample> out;
  double arc = 0;
  for (std::size_t i = 0; i < rod.segments(); ++i) {
    const double l = rod.length_m[i];
    const double wanted = std::ceil(l / (kSpacing * rod.radius_m));
    const auto n = static_cast<std::size_t>(std::clamp(wanted, 1.0, 32.0));
    for (std::size_t k = 0; k < n; ++k) {
      const double share = (static_cast<double>(k) + 0.5) / static_cast<double>(n);
      out.push_back({static_cast<std::uint32_t>(i), share,
                     rod.material.young_pa * l / static_cast<double>(n), arc + share * l, 0, 0});
    }
    arc += l;
  }
  return out;
}

std::optional<RodPair> passes_through_itself(const Rod& rod) {
  std::vector<double> arc(1, 0.0);
  for (const double l : rod.length_m) arc.push_back(arc.back() + l);
  // Near both ends at once: a ring, closed.
  const double end = kApart * rod.radius_m;
  for (const RodSample& s : samples_of(rod)) {
    const Vec3 p = place(s, rod.start_W);
    for (std::uint32_t j = 0; j < s.segment; ++j) {
      if (s.arc_m - arc[j + 1] <= kApart * rod.radius_m) continue;
      if (arc[j] < end && arc.back() - s.arc_m < end) continue;
      const Vec3 way = nearest_on(rod.start_W[j], rod.start_W[j + 1], p).way;
      if (way.squaredNorm() < rod.radius_m * rod.radius_m) return RodPair{s.segment, j};
    }
  }
  return std::nullopt;
}

ContactFinder::ContactFinder(const Rod& rod, const std::vector<bool>& held_frame)
    : samples_(samples_of(rod)), held_(held_frame), arc_m_(1, 0.0) {
  for (const double l : rod.length_m) arc_m_.push_back(arc_m_.back() + l);
  margin_m_ = std::max(kListed * rod.radius_m, arc_m_.back() / static_cast<double>(rod.segments()));
  mark_apart(rod);
}

// Segments so far along the rod that a sample may touch them.
void ContactFinder::mark_apart(const Rod& rod) {
  const double apart = kApart * rod.radius_m;
  for (RodSample& s : samples_) {
    while (s.before < s.segment && s.arc_m - arc_m_[s.before + 1] > apart) ++s.before;
    s.after = s.segment + 1;
    while (s.after < rod.segments() && !(arc_m_[s.after] - s.arc_m > apart)) ++s.after;
  }
}

bool ContactFinder::may_touch(const Rod& rod, const RodSample& s, std::uint32_t other) const {
  if (other >= s.before && other < s.after) return false;
  return other >= rod.segments() || !(held_[s.segment] && held_[other]);
}

// Segments go by groups, so that what is far is passed over many at a time.
void ContactFinder::list_near(const Rod& rod, const RodSupports& supports,
                              const std::vector<Vec3>& x) {
  const auto segments = static_cast<std::uint32_t>(rod.segments());
  listed_at_ = x;
  near_.resize(segments);
  std::vector<RodBall> balls(segments), groups;
  for (std::uint32_t i = 0; i < segments; ++i)
    balls[i] = {0.5 * (x[i] + x[i + 1]), 0.5 * (x[i + 1] - x[i]).norm()};
  for (std::uint32_t first = 0; first < segments; first += kGroup)
    groups.push_back(ball_about(balls, first, std::min(first + kGroup, segments)));
  const double far = 2 * rod.radius_m + margin_m_;
  for (std::uint32_t i = 0; i < segments; ++i) {
    near_[i].clear();
    for (std::uint32_t g = 0; g < groups.size(); ++g) {
      if (!within(groups[i / kGroup], groups[g], far)) continue;
      for (std::uint32_t other = kGroup * g; other < std::min(kGroup * (g + 1), segments); ++other)
        if (within(balls[i], balls[other], far) && could_touch(rod, i, other))
          near_[i].push_back(other);
    }
    for (std::uint32_t o = 0; o < supports.obstacles.size(); ++o)
      if (apart_at_least(rod, supports, {i, segments + o}, x) <
          reach_of(rod, supports, segments + o) + margin_m_)
        near_[i].push_back(segments + o);
  }
}

// Neighbours share a node: they fold before they touch; and no sample is further along the rod than
// both segments' far ends.
bool ContactFinder::could_touch(const Rod& rod, std::uint32_t i, std::uint32_t other) const {
  const auto [low, high] = std::minmax(i, other);
  const double gap = std::max(arc_m_[high] - arc_m_[low], arc_m_[high + 1] - arc_m_[low + 1]);
  return high - low > 1 && gap > kApart * rod.radius_m;
}

void ContactFinder::look(const Rod& rod, const RodSupports& supports, const RodState& state,
                         std::uint32_t sample, std::vector<RodTouch>& out) const {
  const RodSample& s = samples_[sample];
  const Vec3 p = place(s, state.at_W);
  for (const std::uint32_t other : near_[s.segment]) {
    if (!may_touch(rod, s, other)) continue;
    const RodPair pair{sample, other};
    const NearestOnRod at = nearest(rod, supports, pair, p, state.at_W);
    const double reach = reach_of(rod, supports, other) + kReach * rod.radius_m;
    if (!(at.way.squaredNorm() < reach * reach)) continue;
    out.push_back(touch_of(rod, supports, pair, s, at, stick_of(state.sticks, pair)));
  }
}

std::vector<RodTouch> ContactFinder::find(const Rod& rod, const RodSupports& supports,
                                          const RodState& state) {
  const double far = 0.25 * margin_m_;
  bool moved = listed_at_.size() != state.at_W.size();
  for (std::size_t i = 0; !moved && i < listed_at_.size(); ++i)
    moved = !((state.at_W[i] - listed_at_[i]).squaredNorm() < far * far);
  if (moved) list_near(rod, supports, state.at_W);
  std::vector<bool> busy(near_.size(), false);
  for (std::uint32_t i = 0; i < near_.size(); ++i)
    for (const std::uint32_t other : near_[i])
      busy[i] = busy[i] || apart_at_least(rod, supports, {i, other}, state.at_W) <
                               reach_of(rod, supports, other) + kReach * rod.radius_m;
  std::vector<RodTouch> out;
  for (std::uint32_t k = 0; k < samples_.size(); ++k)
    if (busy[samples_[k].segment]) look(rod, supports, state, k, out);
  return out;
}

RodContact contact_at(const Rod& rod, const RodSupports& supports, const RodTouch& touch,
                      const std::vector<RodSample>& samples, const std::vector<Vec3>& x0,
                      const std::vector<Vec3>& x) {
  RodContact c;
  const RodSample& s = samples[touch.pair.sample];
  const bool own = touch.pair.other < rod.segments();
  c.count = own ? 4 : 2;
  const std::size_t other = own ? touch.pair.other : 0;
  c.node = {s.segment, s.segment + 1u, other, other + 1};
  c.weight = touch.weight;
  Vec3 moved = Vec3::Zero();
  for (std::size_t k = 0; k < c.count; ++k)
    moved += touch.weight[k] * (x[c.node[k]] - x0[c.node[k]]);
  const NearestOnRod at = nearest(rod, supports, touch.pair, place(s, x), x);
  const double apart = at.way.norm(), depth = touch.reach_m - apart;
  if (own) c.weight = {1 - s.share, s.share, at.share - 1, -at.share};
  if (depth > 0 && apart > 0) {
    const Vec3 n = at.way / apart;
    c.force_n = touch.stiffness * depth;
    c.energy_j = 0.5 * touch.stiffness * depth * depth;
    c.slope = -c.force_n * n;
    c.stiffness = (touch.stiffness * n) * n.transpose();
  }
  if (touch.hold_n > 0) add_friction(touch, moved, c);
  return c;
}

}  // namespace osteon::rods
