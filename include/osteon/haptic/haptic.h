#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "osteon/haptic/haptic_state.h"
#include "osteon/scene/case.h"
#include "osteon/scene/state.h"
#include "osteon/scene/tool.h"

namespace osteon {

/// Settings of the tick; device limits come from the device's profile.
///
/// Stability. With k the stiffness, b the damping and T the tick, a sampled wall is passive while
/// the damping of device and coupling together exceeds k T / 2 (Colgate and Brown, ICRA 1994). For
/// the emulated hand, which takes the force in the tick that made it, every k up to
/// 4 mass / T^2 settles; when the force comes one tick late, the damping of grip and coupling must
/// exceed k T. The default damping meets both up to 3000 N/m with the loosest grip (2 N s/m).
struct HapticParams {
  double tick_s = 0.001;
  double stiffness_n_per_m = 2000;  ///< of the virtual coupling; bounded by each bone's material
  double damping_n_s_per_m = 2.0;   ///< of the virtual coupling, in contact
  double friction_scale = 1.0;      ///< factor on the materials' friction; 0 switches it off
  double max_force_n = 8.0;
  double max_slew_n_per_s = 4000;
  double max_turn_rad_per_tick = 0.05;  ///< how fast the proxy may turn
  bool force_on = true;
  /// Above 0 the hand drags what it has grabbed, see grab in docs/meshes.md; set by a command, not
  /// a setting of a session.
  double grab_n_per_m = 0;
};

/// Contact between one tool and the bones of one case at 1 kHz (figure 6 of the wrist simulator's
/// paper): a proxy that never enters bone, tied to the hand by a spring and a damper, with
/// stick-slip friction. `tick` allocates, locks and logs nothing. Not for use by two threads at
/// once.
class HapticLoop {
 public:
  HapticLoop(std::shared_ptr<const Case> the_case, std::shared_ptr<const Tool> tool);
  ~HapticLoop();
  HapticLoop(HapticLoop&&) noexcept;

  /// One tick: `bones` is the newest snapshot that physics has published (poses are carried forward
  /// by their velocities over `bones_age_s`). Returns the tool's state with the force on the hand,
  /// N, World. The reference stays valid until the next call. Ticks count from 1. An input or a
  /// bone that is not finite gives zero force and leaves the proxy where it was.
  const ToolState& tick(const ToolInput& input, const BoneSnapshot& bones, double bones_age_s,
                        const HapticParams& params) noexcept;

  /// Puts the proxy at the hand of the next tick with no force, as at the start. A hand that is
  /// then inside bone feels nothing until it has once been free; the proxy is put out of the bone
  /// meanwhile where there is room within 20 mm.
  void reset();
  /// The holes in the skin that a tool with a shaft may pass through (PortalPivot in
  /// src/haptic/portal_pivot.h). Before the first tick; a case has none unless told.
  void set_portals(std::vector<Portal> portals);
  /// Hash over everything that a later tick depends on.
  std::uint64_t state_hash() const;
  /// Saves and restores exactly what state_hash covers.
  std::unique_ptr<HapticState> save() const;
  void restore(const HapticState& state);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace osteon
