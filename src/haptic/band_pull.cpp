#include "band_pull.h"

#include <algorithm>

#include "osteon/scene/tool_rods.h"

namespace osteon {
namespace {

// The damper comes in over this depth: a touch is felt as a slope.
constexpr double kDamped_m = 0.0005;

}  // namespace

BandPull::BandPull(const Tool& tool) : rods_(tool_rods(tool)) {}

void BandPull::set(const std::vector<SoftBand>* bands, const BandContacts* contacts) {
  bands_ = bands;
  contacts_ = contacts;
}

Vec3 BandPull::of_contact(const PullingHand& hand, std::span<const Pose> X_WB,
                          const BandContact& contact) const {
  if (contact.band >= bands_->size() || contact.part >= rods_.size()) return Vec3::Zero();
  const SoftBand& band = (*bands_)[contact.band];
  const Capsule& rod = rods_[contact.part];
  const BandSpan span{X_WB[band.from.index] * band.from_B, X_WB[band.to.index] * band.to_B};
  const Capsule part_W{hand.X_WP * rod.p0, hand.X_WP * rod.p1, rod.radius};
  const double k = std::min(hand.stiffness_n_per_m, band.surface_n_per_m);
  const BandPress press = press_band(band, span, part_W, contact, k);
  if (!press.presses || !(press.force_n > 0)) return Vec3::Zero();
  const double share = press.deep_m / (press.deep_m + kDamped_m);
  const double damped = share * hand.damping_n_s_per_m * contact.nhat_W.dot(hand.v_W);
  return std::max(0.0, press.force_n - damped) * contact.nhat_W;
}

// As of a band: a spring and a damper that only push.
Vec3 BandPull::of_solid(const PullingHand& hand, std::span<const Pose> X_WB,
                        const SolidContact& contact) const {
  if (contact.bone >= X_WB.size() || contact.part >= rods_.size()) return Vec3::Zero();
  const Pose& X = X_WB[contact.bone];
  const Pose X_BP = X.inverse() * hand.X_WP;
  const Capsule& rod = rods_[contact.part];
  const SolidPress press =
      press_solid(contact, {X_BP * rod.p0, X_BP * rod.p1, rod.radius}, hand.stiffness_n_per_m);
  if (!(press.force_n > 0)) return Vec3::Zero();
  const Vec3 nhat_W = X.q * contact.nhat_B;
  const double share = press.deep_m / (press.deep_m + kDamped_m);
  const double damped = share * hand.damping_n_s_per_m * nhat_W.dot(hand.v_W);
  return std::max(0.0, press.force_n - damped) * nhat_W;
}

Vec3 BandPull::force_W(const PullingHand& hand, std::span<const Pose> X_WB) const {
  Vec3 sum = Vec3::Zero();
  if (!bands_ || !contacts_ || contacts_->instrument != hand.instrument ||
      contacts_->epoch != hand.epoch)
    return sum;
  const std::size_t count = std::min<std::size_t>(contacts_->count, kMaxBandContacts);
  for (std::size_t i = 0; i < count; ++i) sum += of_contact(hand, X_WB, contacts_->all[i]);
  const std::size_t solids = std::min<std::size_t>(contacts_->solid_count, kMaxSolidContacts);
  for (std::size_t i = 0; i < solids; ++i) sum += of_solid(hand, X_WB, contacts_->solids[i]);
  return is_finite(sum) ? sum : Vec3(Vec3::Zero());
}

}  // namespace osteon
