#pragma once

#include <memory>
#include <span>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/scene/soft_band.h"
#include "osteon/scene/state.h"
#include "osteon/scene/tool.h"

namespace osteon {

/// The hand's side of the bands near it, for one tool.
struct PullingHand {
  Pose X_WP;  ///< the tool as bone leaves it
  Vec3 v_W = Vec3::Zero();
  std::uint32_t instrument = 0, epoch = 0;
  double stiffness_n_per_m = 0;  ///< of the coupling
  double damping_n_s_per_m = 0;
};

/// What bands and solids do with a tool in a tick. Allocates, locks and logs nothing.
class BandPull {
 public:
  explicit BandPull(const Tool& tool);
  /// Both must outlive this; null: there are no bands.
  void set(const std::vector<SoftBand>* bands, const BandContacts* contacts);
  bool any() const { return contacts_ && (contacts_->count > 0 || contacts_->solid_count > 0); }
  /// On the hand, N. Zero where it is not finite, or where the contacts are of another instrument
  /// or epoch.
  Vec3 force_W(const PullingHand& hand, std::span<const Pose> X_WB) const;

 private:
  Vec3 of_contact(const PullingHand& hand, std::span<const Pose> X_WB,
                  const BandContact& contact) const;
  Vec3 of_solid(const PullingHand& hand, std::span<const Pose> X_WB,
                const SolidContact& contact) const;

  std::vector<Capsule> rods_;
  const std::vector<SoftBand>* bands_ = nullptr;
  const BandContacts* contacts_ = nullptr;
};

}  // namespace osteon
