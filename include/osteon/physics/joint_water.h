#pragma once

#include <optional>
#include <span>
#include <vector>

#include "osteon/physics/bone_loss.h"
#include "osteon/physics/joint_fluid.h"
#include "osteon/scene/case.h"
#include "osteon/scene/state.h"
#include "osteon/scene/tool.h"
#include "osteon/scene/water_state.h"

namespace osteon {

/// The joint of a case that is filled with water: that of a wrist or a knee. None: the boxes of
/// exercises are dry.
std::optional<FluidJoint> filled_joint(const Case& the_case);

/// A soft part was cut, torn or wounded in a step.
struct SoftOpening {
  std::uint32_t soft = 0;  ///< in Case::softs
  BoneId bone;             ///< that the place goes with
  Vec3 p_W = Vec3::Zero();
  double area_m2 = 0;  ///< of new surface that bleeds
};

/// The water of a session, step by step: what is removed becomes slurry, soft bone and marrow that
/// are laid open and wounds of soft parts bleed, pressure stops the bleeding, flow and suction
/// clear the water, and heat near a wound of a soft part seals it. A function of its state and of
/// what it is given. A step allocates, locks and logs nothing.
class JointWater {
 public:
  /// Gone bone is to be given in each step whose number this divides.
  static constexpr std::uint64_t kLookEvery = 50;

  /// `tray`: the instruments by ToolState::instrument.
  JointWater(const FluidJoint& joint, std::span<const std::shared_ptr<const Tool>> tray,
             double step_s);

  /// Distended by clear water, the pump as it stands where nobody has set it.
  WaterState begin() const;
  /// What user and tools do in a step. `gone`: null in the steps between two looks.
  void step(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
            std::span<const SoftOpening> openings, const GoneBone* gone, WaterState& state) const;
  /// As it was at a restore point; the pump stands as it does now.
  static WaterState gone_back(const WaterState& kept, const WaterState& now);
  /// A state may hold these numbers.
  static bool fits(const WaterState& state);

  const FluidJoint& joint() const { return joint_; }

 private:
  void open(const SoftOpening& opening, const BoneSnapshot& bones, WaterState& state) const;
  void seal(const ToolState& tool, const BoneSnapshot& bones, WaterState& state) const;

  FluidJoint joint_;
  std::vector<ToolUse> uses_;  ///< by place in the tray
  double step_s_;
};

/// The pump of a state, its pressure and outlet; what is out of range is not taken.
void set_pump(double pump_pa, WaterState& state);
void set_outlet(double outlet_open, WaterState& state);
inline constexpr double kMostPump_pa = 300 * kPa_per_mmHg;

/// What a wound bleeds into a joint of that pressure, m3/s.
double wound_flow(const FluidJoint& joint, const Wound& wound, double pressure_pa);

/// What flows and bleeds in a state's last step, and what is in the joint.
FluidDrive drive_of(const WaterState& state);
FluidState fluid_of(const WaterState& state);

}  // namespace osteon
