#include "osteon/physics/loose_rings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "osteon/base/hash.h"

namespace osteon {
namespace {

constexpr double kGravity_m_per_s2 = 9.81;
constexpr int kRoundPoints = 24, kKeepOutRounds = 4;
constexpr double kAlongJaws = 0.8;  // most cosine between the ring and the way in which jaws shut
constexpr double kSecondSlip = 2;   // times kReach_m: where jaws that do not lead lose it
constexpr std::uint32_t kNotKnown = 0xffffffffu;

// Nearest point of a ring's middle line to p, both about its middle.
Vec3 nearest_on_circle(const Vec3& p, double radius_m) {
  const double across = std::hypot(p.x(), p.y());
  if (!(across > 1e-12)) return {radius_m, 0, 0};
  return {p.x() / across * radius_m, p.y() / across * radius_m, 0};
}

bool is_hand(std::uint8_t hand) { return hand < kMaxHands || hand == kNoHand; }

bool is_sound(const LooseRing& ring) {
  const bool held = ring.is == LooseRing::Is::kHeld;
  return ring.is <= LooseRing::Is::kFalling && is_finite(ring.X_WB) && is_finite(ring.X_PB) &&
         std::isfinite(ring.falls_m_per_s) && is_hand(ring.hand) && is_hand(ring.second) &&
         held == (ring.hand != kNoHand);
}

}  // namespace

LooseRings::LooseRings(std::shared_ptr<const Case> the_case, double step_s)
    : case_(std::move(the_case)), set_(find_rings(*case_)), step_s_(step_s) {
  state_.on = true;
  state_.count = static_cast<std::uint32_t>(set_.rings.size());
  state_.shut.fill(true);
  state_.instrument.fill(kNotKnown);
  for (std::size_t i = 0; i < count(); ++i) {
    state_.rings[i].X_WB = case_->bones[bone(i)].X_WB;
    before_W_[i] = center_W(i);
  }
}

Vec3 LooseRings::center_W(std::size_t ring) const {
  return state_.rings[ring].X_WB * set_.rings[ring].center_B;
}

void LooseRings::put_center(std::size_t ring, const Vec3& center) {
  state_.rings[ring].X_WB.p += center - center_W(ring);
}

bool LooseRings::is_in_jaws(std::size_t i, const ToolState& tool, double reach_m) const {
  const RingShape& shape = set_.rings[i];
  const Pose& X_WB = state_.rings[i].X_WB;
  const Vec3 grip = X_WB.inverse() * (tool.X_WP * Vec3(0, 0, kGrip_m)) - shape.center_B;
  const Vec3 on = nearest_on_circle(grip, shape.middle_m);
  if (!((grip - on).norm() <= reach_m)) return false;
  const Vec3 along_W = X_WB.rotate(Vec3(-on.y(), on.x(), 0).normalized());
  return std::abs(along_W.dot(tool.X_WP.rotate(Vec3::UnitY()))) <= kAlongJaws;
}

// Jaws that shut take the nearest ring between them.
void LooseRings::take(std::uint8_t hand, const ToolState& tool) {
  std::size_t best = count();
  double least = kReach_m;
  for (std::size_t i = 0; i < count(); ++i) {
    const LooseRing& ring = state_.rings[i];
    if (ring.hand == hand || ring.second != kNoHand || !is_in_jaws(i, tool, least)) continue;
    const Vec3 grip =
        ring.X_WB.inverse() * (tool.X_WP * Vec3(0, 0, kGrip_m)) - set_.rings[i].center_B;
    const double off = (grip - nearest_on_circle(grip, set_.rings[i].middle_m)).norm();
    if (best < count() && off >= least) continue;
    least = off;
    best = i;
  }
  if (best == count()) return;
  LooseRing& ring = state_.rings[best];
  if (ring.is == LooseRing::Is::kHeld) {
    ring.second = hand;
    return;
  }
  ring.is = LooseRing::Is::kHeld;
  ring.hand = hand;
  ring.falls_m_per_s = 0;
  ring.X_PB = tool.X_WP.inverse() * ring.X_WB;
}

void LooseRings::let_go(std::uint8_t hand, std::span<const ToolState* const> tools) {
  for (std::size_t i = 0; i < count(); ++i) {
    LooseRing& ring = state_.rings[i];
    if (ring.second == hand) ring.second = kNoHand;
    if (ring.hand != hand) continue;
    if (ring.second < tools.size() && is_finite(tools[ring.second]->X_WP)) {
      ring.hand = ring.second;
      ring.second = kNoHand;
      ring.X_PB = tools[ring.hand]->X_WP.inverse() * ring.X_WB;
    } else {
      begin_to_fall(i);
    }
  }
}

void LooseRings::begin_to_fall(std::size_t i) {
  LooseRing& ring = state_.rings[i];
  const Vec3 center = center_W(i);
  ring.is = LooseRing::Is::kFalling;
  ring.hand = ring.second = kNoHand;
  ring.falls_m_per_s = 0;
  ring.X_WB.q = case_->bones[bone(i)].X_WB.q;
  put_center(i, center);
}

// How far a ring must go so that it meets no peg: the deepest place first. A peg is a rod with a
// round top.
Vec3 LooseRings::out_of_pegs(std::size_t i, bool sideways) const {
  const RingShape& shape = set_.rings[i];
  const Pose& X_WB = state_.rings[i].X_WB;
  Vec3 moved = Vec3::Zero();
  for (int round = 0; round < kKeepOutRounds; ++round) {
    double deepest = 0;
    Vec3 out = Vec3::Zero();
    for (const RingPeg& peg : set_.pegs)
      for (int k = 0; k < kRoundPoints; ++k) {
        const double a = 2 * std::numbers::pi * k / kRoundPoints;
        const Vec3 on(shape.middle_m * std::cos(a), shape.middle_m * std::sin(a), 0);
        const Vec3 p_W = X_WB * Vec3(shape.center_B + on) + moved;
        const double top = std::max(peg.low_z_m, peg.top_W.z() - peg.radius_m);
        const double z = std::clamp(p_W.z(), peg.low_z_m, top);
        const Vec3 from = p_W - Vec3(peg.top_W.x(), peg.top_W.y(), z);
        const double in = 0.5 * shape.thick_m + peg.radius_m - from.norm();
        if (in <= deepest) continue;
        Vec3 way = sideways ? Vec3(from.x(), from.y(), 0) : from;
        if (!(way.norm() > 1e-9)) way = Vec3::UnitX();
        deepest = in;
        out = way.normalized() * in;
      }
    if (deepest <= 0) break;
    moved += out;
  }
  return moved;
}

double LooseRings::height_of_rest(std::size_t ring) const {
  std::array<Vec3, kMaxRings> centers{};
  for (std::size_t i = 0; i < count(); ++i) centers[i] = center_W(i);
  return rest_height_m(set_, ring, centers[ring], std::span(centers).first(count()));
}

void LooseRings::carry(std::size_t i, const ToolState& tool) {
  LooseRing& ring = state_.rings[i];
  ring.X_WB = tool.X_WP * ring.X_PB;
  Vec3 gives = out_of_pegs(i, false);
  ring.X_WB.p += gives;
  const double under = height_of_rest(i) - center_W(i).z();
  if (under > 0) {
    ring.X_WB.p.z() += under;
    gives.z() += under;
  }
  if (gives.norm() > kSlip_m) begin_to_fall(i);
}

void LooseRings::fall(std::size_t i) {
  LooseRing& ring = state_.rings[i];
  ring.falls_m_per_s += kGravity_m_per_s2 * step_s_;
  ring.X_WB.p += out_of_pegs(i, true);
  const double lies = height_of_rest(i);
  Vec3 center = center_W(i);
  center.z() -= ring.falls_m_per_s * step_s_;
  if (center.z() <= lies) {
    center.z() = lies;
    ring.is = LooseRing::Is::kResting;
    ring.falls_m_per_s = 0;
  }
  put_center(i, center);
}

// Whoever takes another instrument lets go; jaws must have been open before they can shut.
void LooseRings::heed(std::uint8_t hand, std::span<const ToolState* const> tools) {
  const ToolState& tool = *tools[hand];
  const bool shut = tool.jaw < kShut;
  const bool same = state_.instrument[hand] == tool.instrument;
  if (!same || !shut) let_go(hand, tools);
  if (same && shut && !state_.shut[hand]) take(hand, tool);
  state_.instrument[hand] = tool.instrument;
  state_.shut[hand] = shut;
}

void LooseRings::step(std::span<const ToolState* const> tools, std::uint32_t epoch) {
  const std::size_t hands = std::min<std::size_t>(tools.size(), kMaxHands);
  for (std::size_t i = 0; i < count(); ++i) before_W_[i] = center_W(i);
  for (std::size_t h = 0; h < hands; ++h)
    if (tools[h]->epoch == epoch && is_finite(tools[h]->X_WP))
      heed(static_cast<std::uint8_t>(h), tools.first(hands));
  for (std::size_t i = 0; i < count(); ++i) {
    LooseRing& ring = state_.rings[i];
    if (ring.is == LooseRing::Is::kHeld && ring.hand < hands && is_finite(tools[ring.hand]->X_WP))
      carry(i, *tools[ring.hand]);
    if (ring.second < hands && !is_in_jaws(i, *tools[ring.second], kSecondSlip * kReach_m))
      ring.second = kNoHand;
    if (ring.is == LooseRing::Is::kFalling) fall(i);
  }
}

BoneMotion LooseRings::motion(std::size_t i) const {
  BoneMotion motion{state_.rings[i].X_WB, Vec3::Zero(), Vec3::Zero()};
  if (state_.rings[i].is != LooseRing::Is::kResting)
    motion.v_W = (center_W(i) - before_W_[i]) / step_s_;
  return motion;
}

std::uint64_t LooseRings::hash() const {
  Hasher hasher;
  for (std::size_t i = 0; i < count(); ++i) {
    const LooseRing& ring = state_.rings[i];
    hasher.add(static_cast<std::uint8_t>(ring.is));
    hasher.add(ring.X_WB);
    hasher.add(ring.hand);
    hasher.add(ring.second);
    hasher.add(ring.X_PB);
    hasher.add(ring.falls_m_per_s);
  }
  for (const bool shut : state_.shut) hasher.add(shut);
  for (const std::uint32_t instrument : state_.instrument) hasher.add(instrument);
  return hasher.value();
}

bool LooseRings::fits(const RingsState& state) const {
  return state.on && state.count == count() &&
         std::all_of(state.rings.begin(), state.rings.begin() + state.count, is_sound);
}

void LooseRings::restore(const RingsState& state) {
  state_ = state;
  for (std::size_t i = 0; i < count(); ++i) before_W_[i] = center_W(i);
}

void LooseRings::go_back(const RingsState& state) {
  restore(state);
  state_.shut.fill(true);
  state_.instrument.fill(kNotKnown);
  for (std::size_t i = 0; i < count(); ++i)
    if (state_.rings[i].is == LooseRing::Is::kHeld) begin_to_fall(i);
}

}  // namespace osteon
