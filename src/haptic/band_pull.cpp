#include "band_pull.h"

#include <algorithm>
#include <cmath>

#include "osteon/scene/tool_rods.h"

namespace osteon {
namespace {

// The damper comes in over this depth: a touch is felt as a slope.
constexpr double kDamped_m = 0.0005;

// The way of a body's point that is at p_W now.
Vec3 way_with(const Pose& before_WB, const Pose& X_WB, const Vec3& p_W) {
  return p_W - before_WB * (X_WB.inverse() * p_W);
}

}  // namespace

BandPull::BandPull(const Tool& tool) : shapes_(soft_shapes(tool)), on_skin_(tool_shapes(tool)) {}

struct BandPull::Pressed {
  Vec3 nhat_W, p_W;
  double force_n = 0, deep_m = 0;
  Vec3 carried_W = Vec3::Zero();  // way of the part there since the tick before
  FrictionRatios ratios;
};

void BandPull::set(const std::vector<SoftBand>* bands, const BandContacts* contacts,
                   const SoftFriction& friction) {
  bands_ = bands;
  contacts_ = contacts;
  friction_ = friction;
}

// A spring and a damper that only push.
void BandPull::add(const PullingHand& hand, const Pressed& pressed, BandForce& out) {
  const double share = pressed.deep_m / (pressed.deep_m + kDamped_m);
  const double damped = share * hand.damping_n_s_per_m * pressed.nhat_W.dot(hand.v_W);
  out.force_W += std::max(0.0, pressed.force_n - damped) * pressed.nhat_W;
  out.rests_W += pressed.force_n * pressed.nhat_W;
  out.pressed_n += pressed.force_n;
  out.resting_n += pressed.ratios.resting * pressed.force_n;
  out.sliding_n += pressed.ratios.sliding * pressed.force_n;
  out.way_W +=
      pressed.force_n * (way_with(hand.before_WP, hand.X_WP, pressed.p_W) - pressed.carried_W);
}

// A band goes along with both of its bones, each as near as it is.
void BandPull::add_band(const PullingHand& hand, const Bones& bones, const BandContact& contact,
                        BandForce& out) const {
  if (contact.band >= bands_->size() || contact.part >= shapes_.size()) return;
  const SoftBand& band = (*bands_)[contact.band];
  const Pose &from = bones.X_WB[band.from.index], &to = bones.X_WB[band.to.index];
  const BandSpan span{from * band.from_B, to * band.to_B};
  const RoundBox part_W = placed(hand.X_WP, shapes_[contact.part]);
  // What is left of a cut one yields less, as it is thinner.
  const double surface = band.surface_n_per_m / std::sqrt(std::sqrt(contact.left));
  const double k = std::min(hand.stiffness_n_per_m, surface);
  const BandPress press = press_band(band, span_at(span, contact), part_W, contact, k);
  if (!press.presses || !(press.force_n > 0)) return;
  const Vec3 way = span.b_W - span.a_W;
  const double share = std::clamp((press.p_W - span.a_W).dot(way) / way.squaredNorm(), 0.0, 1.0);
  const Vec3 carried = (1 - share) * way_with(bones.before_WB[band.from.index], from, press.p_W) +
                       share * way_with(bones.before_WB[band.to.index], to, press.p_W);
  add(hand, {contact.nhat_W, press.p_W, press.force_n, press.deep_m, carried, friction_.band}, out);
}

void BandPull::add_solid(const PullingHand& hand, const Bones& bones, const SolidContact& contact,
                         BandForce& out) const {
  if (contact.bone >= bones.X_WB.size() || contact.part >= shapes_.size()) return;
  const Pose& X = bones.X_WB[contact.bone];
  const RoundBox part_B = placed(X.inverse() * hand.X_WP, shapes_[contact.part]);
  const SolidPress press = press_solid(contact, part_B, hand.stiffness_n_per_m);
  if (!(press.force_n > 0)) return;
  const Vec3 p_W = X * Vec3(pressed_place(contact, part_B) - part_B.rod.radius * contact.nhat_B);
  add(hand,
      {X.q * contact.nhat_B, p_W, press.force_n, press.deep_m,
       way_with(bones.before_WB[contact.bone], X, p_W), friction_.solid},
      out);
}

// A shaft in its hole is damped every way and does not rub: the hole's friction is in the force.
// What a portal holds, the patch about it does not hold as well.
void BandPull::add_skin(const PullingHand& hand, const Bones& bones, const SkinContact& contact,
                        BandForce& out) const {
  if (contact.bone >= bones.X_WB.size() || contact.part >= on_skin_.size()) return;
  const Pose& X = bones.X_WB[contact.bone];
  const Pose X_BP = X.inverse() * hand.X_WP;
  const SkinPushed press = press_skin(contact, placed(X_BP, on_skin_[contact.part]), X_BP);
  const Vec3 nhat_W = X.q * contact.nhat_B, p_W = X * press.p_B;
  if (contact.through) {
    const double share = press.deep_m > 0 ? press.deep_m / (press.deep_m + kDamped_m) : 0;
    const bool held = contact.made != kNotMade && contact.made == hand.made;
    const double left = held ? 1 - hand.grip : 1;
    out.force_W += left * (press.force_n * nhat_W + X.q * press.aside_B -
                           share * hand.damping_n_s_per_m * hand.v_W);
  } else if (press.force_n > 0) {
    add(hand,
        {nhat_W, p_W, press.force_n, press.deep_m, way_with(bones.before_WB[contact.bone], X, p_W),
         friction_.skin},
        out);
  }
}

// What suction holds pulls straight to its mouth, no harder than the suction.
Vec3 BandPull::suction_on(const PullingHand& hand, const Bones& bones) const {
  const SoftHold& hold = contacts_->hold;
  const Vec3 mouth_W = hand.X_WP * hold.p_T;
  if (hold.of == SoftHold::Of::kSolid) {
    if (hold.bone >= bones.X_WB.size()) return Vec3::Zero();
    const Pose& X = bones.X_WB[hold.bone];
    return suck_solid(hold, X * hold.p_B, X.q * hold.nhat_B, mouth_W);
  }
  if (!bands_ || hold.part >= bands_->size()) return Vec3::Zero();
  const SoftBand& band = (*bands_)[hold.part];
  const BandSpan span{bones.X_WB[band.from.index] * band.from_B,
                      bones.X_WB[band.to.index] * band.to_B};
  const BandPress press =
      draw_band(band, span, mouth_W, hold.others_taken_m, hold.stiffness_n_per_m, hold.left);
  const Vec3 way_W = press.p_W - mouth_W;
  const double length = way_W.norm();
  if (!press.presses || !(length > 0)) return Vec3::Zero();
  return std::min(press.force_n, hold.most_n) / length * way_W;
}

// What jaws hold pulls every way, and is damped every way. Nothing rubs there.
void BandPull::add_hold(const PullingHand& hand, const Bones& bones, BandForce& out) const {
  const SoftHold& hold = contacts_->hold;
  if (hold.of == SoftHold::Of::kNothing) return;
  if (hold.most_n > 0) {
    out.force_W += suction_on(hand, bones);
    return;
  }
  const double k = std::min(hand.stiffness_n_per_m, kJawSpring_n_per_m);
  const Vec3 grip_W = hand.X_WP * hold.p_T;
  Vec3 force = Vec3::Zero();
  if (hold.of == SoftHold::Of::kSolid && hold.bone < bones.X_WB.size()) {
    force = hold_solid(hold, bones.X_WB[hold.bone] * hold.p_B, grip_W, k);
  } else if (hold.of == SoftHold::Of::kBand && bands_ && hold.part < bands_->size()) {
    const SoftBand& band = (*bands_)[hold.part];
    const BandSpan span{bones.X_WB[band.from.index] * band.from_B,
                        bones.X_WB[band.to.index] * band.to_B};
    force = hold_band(band, span, grip_W, hold, k).force_W;
  }
  const double stretched_m = force.norm() / k;
  const double share = stretched_m / (stretched_m + kDamped_m);
  out.force_W += force - share * hand.damping_n_s_per_m * hand.v_W;
}

BandForce BandPull::force(const PullingHand& hand, std::span<const Pose> before_WB,
                          std::span<const Pose> X_WB) const {
  BandForce sum;
  if (!contacts_ || contacts_->instrument != hand.instrument || contacts_->epoch != hand.epoch)
    return sum;
  const Bones bones{before_WB, X_WB};
  const std::size_t count = bands_ ? std::min<std::size_t>(contacts_->count, kMaxBandContacts) : 0;
  for (std::size_t i = 0; i < count; ++i) add_band(hand, bones, contacts_->all[i], sum);
  const std::size_t solids = std::min<std::size_t>(contacts_->solid_count, kMaxSolidContacts);
  for (std::size_t i = 0; i < solids; ++i) add_solid(hand, bones, contacts_->solids[i], sum);
  const std::size_t skins = std::min<std::size_t>(contacts_->skin_count, kMaxSkins);
  for (std::size_t i = 0; i < skins; ++i) add_skin(hand, bones, contacts_->skins[i], sum);
  add_hold(hand, bones, sum);
  if (sum.pressed_n > 0) sum.way_W /= sum.pressed_n;
  const bool sound = is_finite(sum.force_W) && is_finite(sum.way_W);
  return sound ? sum : BandForce{};
}

}  // namespace osteon
