#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "osteon/collide/cut_field.h"
#include "osteon/haptic/haptic_state.h"
#include "osteon/scene/case.h"
#include "osteon/scene/soft_band.h"
#include "osteon/scene/soft_friction.h"
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
  /// `tray`: the tools that other hands may hold, see OtherTool::instrument; none: they are not
  /// felt.
  HapticLoop(std::shared_ptr<const Case> the_case, std::shared_ptr<const Tool> tool,
             std::span<const std::shared_ptr<const Tool>> tray = {});
  ~HapticLoop();
  HapticLoop(HapticLoop&&) noexcept;

  /// One tick: `bones` is the newest snapshot that physics has published (poses are carried forward
  /// by their velocities over `bones_age_s`). Returns the tool's state with the force on the hand,
  /// N, World. The reference stays valid until the next call. Ticks count from 1. An input or a
  /// bone that is not finite gives zero force and leaves the proxy where it was. `others`: the
  /// tools of other hands as they were last published; a tool may push those, and feels half of the
  /// overlap of what both hands want. While the bones are of another epoch than the tool, nothing
  /// is felt.
  const ToolState& tick(const ToolInput& input, const BoneSnapshot& bones, double bones_age_s,
                        const HapticParams& params, const OtherTools& others = {}) noexcept;

  /// Puts the proxy at the hand of the next tick with no force, as at the start. A hand that is
  /// then inside bone feels nothing until it has once been free; the proxy is put out of the bone
  /// meanwhile where there is room within 20 mm.
  void reset();
  /// The holes in the skin that a tool with a shaft may pass through (PortalPivot in
  /// src/haptic/portal_pivot.h). Before the first tick; a case has none unless told. Those that can
  /// be made in skin stand at the end, by Portal::made; BandContacts says which are open, and
  /// where.
  void set_portals(std::vector<Portal> portals);
  /// What was cut out of each bone, by its number; null: nothing, ever. Looked at in each tick, and
  /// must outlive the loop; who changes it does so between two ticks. Bones felt as pieces or hulls
  /// are felt whole.
  void set_cuts(std::span<const CutField* const> by_bone);
  /// The soft bands of the case, and those near the tool as physics has published them: changed
  /// between two ticks. Both must outlive the loop; null: there are none. `friction`: of them and
  /// of the solids.
  void set_bands(const std::vector<SoftBand>* bands, const BandContacts* contacts,
                 const SoftFriction& friction = {});
  /// Which hand of the session it is: whose line of BoneSnapshot::guides leads the tool. Before the
  /// first tick.
  void set_hand(std::uint32_t hand);
  /// `reset` in the middle of a run, for a loop that goes on where another one was at `last`, or
  /// itself: ticks go on, the force fades to zero within kFade_s, and rises again once the hand has
  /// been free. Allocates, locks and logs nothing.
  void begin_anew(const ToolState& last) noexcept;
  static constexpr double kFade_s = 0.020;
  /// The tool goes over to the next epoch: the bones will be those of a restore point.
  void next_epoch() noexcept;
  /// What the hand holds and how, for the tool's state; the loop's own tool stays.
  void set_grip(std::uint32_t instrument, double power, double jaw) noexcept;
  /// Hash over everything that a later tick depends on.
  std::uint64_t state_hash() const;
  /// Saves and restores exactly what state_hash covers.
  std::unique_ptr<HapticState> save() const;
  const HapticState& state() const;
  /// Allocates nothing where the state's lists are of the loop's size, as those of `state()` are.
  void restore(const HapticState& state);
  const Tool& tool() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace osteon
