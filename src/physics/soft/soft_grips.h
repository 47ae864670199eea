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
  bool bit = false;  ///< a punch that bites bands has shut
  SoftHold hold;     ///< which one
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
/// is pulled out, or until it is not felt any more. A mouth that sucks holds what it draws to
/// itself against its pull. A step allocates, locks and logs nothing.
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
  /// What is held of a solid has come off it.
  bool is_cut_away(const SoftHold& hold, const Parts& parts) const;

 private:
  const SoftGripper* gripper(std::uint32_t instrument) const;
  bool is_felt(const SoftState& state, const SoftHold& hold, const Parts& parts) const;
  bool bites(std::uint32_t instrument) const;
  bool bites_bands(std::uint32_t instrument) const;
  bool take_band(const SoftState& state, const SoftGripper& jaws, const Pose& X_WT,
                 const Parts& parts, SoftHold& hold) const;
  bool take_solid(const SoftState& state, const SoftGripper& jaws, const Pose& X_WT,
                  const Parts& parts, SoftHold& hold) const;
  void draw_in(const SoftGripper& jaws, SoftHold& hold) const;
  GripPull pull_of(SoftState& state, std::size_t hand, const ToolState& tool,
                   const Parts& parts) const;
  void hold_on(SoftGrip& grip, const GripPull& pull) const;
  GripNews leave(SoftGrip& grip, const ToolState* tool, std::uint64_t step) const;
  // Suction.
  struct Drawn {
    double gap_m = 0;               ///< from the mouth to its surface at rest; below 0: pressed
    double target_n_per_m = 0;      ///< what the hold's stiffness goes to
    GripPull pull;                  ///< with the hold's stiffness
    Vec3 bend_W = Vec3::Zero();     ///< of a band
    Vec3 against_B = Vec3::Zero();  ///< of a solid
  };
  bool draws(const SoftState& state, std::size_t hand, const SoftGripper& mouth,
             const ToolState& tool, const Parts& parts, SoftHold& hold, Drawn& out) const;
  bool draws_band(const SoftState& state, std::size_t hand, const ToolState& tool,
                  const Parts& parts, SoftHold& hold, Drawn& out) const;
  bool draws_solid(const ToolState& tool, const Parts& parts, SoftHold& hold, Drawn& out) const;
  bool find_drawn(const SoftState& state, std::size_t hand, const SoftGripper& mouth,
                  const ToolState& tool, const Parts& parts, SoftHold& hold) const;
  GripNews suck(SoftState& state, std::size_t hand, const SoftGripper& mouth, const ToolState& tool,
                const Parts& parts, std::uint64_t step, GripPull& pull) const;
  double others_taken_m(const SoftState& state, std::size_t hand, std::size_t band) const;

  const SoftSetup& setup_;
  double spring_n_per_m_, step_s_;
};

/// What of the straight way from a (0) to b (1) is inside of all planes; empty: first > second.
std::array<double, 2> inside_of(std::span<const Plane> planes, const Vec3& a, const Vec3& b);
/// From a band's straight way to a place, across it.
Vec3 across(const BandSpan& span, const Vec3& p_W);
/// How far along a band's straight way a place is: 0 to 1.
double share_along(const BandSpan& span, const Vec3& p_W);

/// By so much the jaws of all hands but one make a band's path longer.
double taken_by_grips(const SoftState& state, std::size_t band, std::size_t but_hand = kMaxHands);

}  // namespace osteon
