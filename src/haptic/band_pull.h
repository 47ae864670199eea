#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/scene/soft_band.h"
#include "osteon/scene/soft_friction.h"
#include "osteon/scene/state.h"
#include "osteon/scene/tool.h"

namespace osteon {

/// The hand's side of the bands near it, for one tool.
struct PullingHand {
  Pose X_WP;       ///< the tool as bone leaves it
  Pose before_WP;  ///< the same a tick ago
  Vec3 v_W = Vec3::Zero();
  std::uint32_t instrument = 0, epoch = 0;
  double stiffness_n_per_m = 0;  ///< of the coupling
  double damping_n_s_per_m = 0;
  std::uint32_t made = kNotMade;  ///< the made portal that holds the shaft
  double grip = 0;                ///< 0 to 1: how far it does
};

/// What all bands, solids and skin do with a tool in a tick.
struct BandForce {
  Vec3 force_W = Vec3::Zero();          ///< on the hand, along the normals, with the damper's
  Vec3 rests_W = Vec3::Zero();          ///< the same without it
  double pressed_n = 0;                 ///< sizes of those forces, in all
  double resting_n = 0, sliding_n = 0;  ///< the most that friction holds, and while it slides
  Vec3 way_W = Vec3::Zero();  ///< of the tool over them since the tick before: their mean by force
};

/// What bands, solids and skin do with a tool in a tick. Allocates, locks and logs nothing.
class BandPull {
 public:
  explicit BandPull(const Tool& tool);
  /// Both must outlive this; null: there are no bands.
  void set(const std::vector<SoftBand>* bands, const BandContacts* contacts,
           const SoftFriction& friction);
  bool any() const {
    return contacts_ && (contacts_->count > 0 || contacts_->solid_count > 0 ||
                         contacts_->skin_count > 0 || contacts_->hold.of != SoftHold::Of::kNothing);
  }
  /// Zero where it is not finite, or where the contacts are of another instrument or epoch.
  /// `before_WB`: the bones a tick ago.
  BandForce force(const PullingHand& hand, std::span<const Pose> before_WB,
                  std::span<const Pose> X_WB) const;

 private:
  struct Pressed;  ///< one contact
  struct Bones {
    std::span<const Pose> before_WB, X_WB;
  };
  void add_band(const PullingHand& hand, const Bones& bones, const BandContact& contact,
                BandForce& out) const;
  void add_solid(const PullingHand& hand, const Bones& bones, const SolidContact& contact,
                 BandForce& out) const;
  void add_skin(const PullingHand& hand, const Bones& bones, const SkinContact& contact,
                BandForce& out) const;
  Vec3 suction_on(const PullingHand& hand, const Bones& bones) const;
  void add_hold(const PullingHand& hand, const Bones& bones, BandForce& out) const;
  static void add(const PullingHand& hand, const Pressed& pressed, BandForce& out);

  std::vector<RoundBox> shapes_;   ///< as they meet bands and solids
  std::vector<RoundBox> on_skin_;  ///< the same parts as they meet skin
  const std::vector<SoftBand>* bands_ = nullptr;
  const BandContacts* contacts_ = nullptr;
  SoftFriction friction_;
};

}  // namespace osteon
