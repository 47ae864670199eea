#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "osteon/physics/soft_setup.h"
#include "osteon/physics/soft_state.h"
#include "osteon/scene/state.h"
#include "soft/solid_presses.h"

namespace osteon {

/// What has become of a hand's grip in a step.
struct GripNews {
  bool held = false, freed = false, slipped = false;
  SoftHold hold;  ///< which one
  double force_n = 0, holds_n = 0, pulled_mm = 0;
  double since_s = 0, peak_n = 0;
  Vec3 p_W = Vec3::Zero();
};

/// How a hand's jaws pull what they hold.
struct GripPull {
  SoftHold::Of of = SoftHold::Of::kNothing;
  std::uint32_t part = 0;
  double force_n = 0;                 ///< on it
  double tension_n = 0, taken_m = 0;  ///< of a band
  double pulled_m = 0;                ///< from where it is at rest
  Vec3 p_W = Vec3::Zero();            ///< of the jaws
};

/// Jaws that hold soft parts, at the physics' rate. Jaws that have stood wide open and shut take
/// what is in their mouth: a band whose straight way leads through it, or else the solid that has
/// most in it. They draw the place between them as they shut, and hold it until they open, until it
/// is pulled out, or until it is not felt any more. A step allocates, locks and logs nothing.
class SoftGrips {
 public:
  SoftGrips(const SoftSetup& setup, double coupling_n_per_m, double step_s)
      : setup_(setup),
        spring_n_per_m_(std::min(coupling_n_per_m, kJawSpring_n_per_m)),
        step_s_(step_s) {}

  /// What soft parts look like in a step.
  struct Parts {
    std::span<const BandSpan> spans;
    const SolidPresses* solids = nullptr;  ///< null: there are none
  };

  /// Parts of the tool that soft parts do not feel, because its jaws stand open.
  std::uint64_t lifted(const ToolState& tool) const;
  /// Of one hand. `tool`: null: it is not there, and holds nothing.
  GripNews step(SoftState& state, std::size_t hand, const ToolState* tool, const Parts& parts,
                std::uint64_t step, GripPull& pull) const;
  bool fits(const SoftState& state) const;

 private:
  const SoftGripper* gripper(std::uint32_t instrument) const;
  bool is_felt(const SoftState& state, const SoftHold& hold, const Parts& parts) const;
  bool bites(std::uint32_t instrument) const;
  bool take_band(const SoftState& state, const SoftGripper& jaws, const Pose& X_WT,
                 const Parts& parts, SoftHold& hold) const;
  bool take_solid(const SoftState& state, const SoftGripper& jaws, const Pose& X_WT,
                  const Parts& parts, SoftHold& hold) const;
  void draw_in(const SoftGripper& jaws, SoftHold& hold) const;
  GripPull pull_of(SoftState& state, std::size_t hand, const ToolState& tool,
                   const Parts& parts) const;

  const SoftSetup& setup_;
  double spring_n_per_m_, step_s_;
};

/// By so much the jaws of all hands but one make a band's path longer.
double taken_by_grips(const SoftState& state, std::size_t band, std::size_t but_hand = kMaxHands);

}  // namespace osteon
