#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"

namespace osteon {

struct Instrument;

/// Jaws that hold soft parts. The mouth is what they sweep when they shut: a wedge from the hinge.
struct SoftGripper {
  Vec3 hinge_T = Vec3::Zero();
  Vec3 axis_T = Vec3::UnitX();   ///< unit, of the hinge
  Vec3 along_T = Vec3::UnitZ();  ///< unit, from the hinge to the tip, between the shut jaws
  Vec3 rise_T = Vec3::UnitY();   ///< unit, across both
  double length_m = 0, half_width_m = 0;
  double low_rad = 0, high_rad = 0;  ///< of the wide open jaws, from along_T towards rise_T
  double holds_n = 0;                ///< what is pulled harder slips out
  std::uint64_t jaws = 0;            ///< which of tool_rods() they are, bit by bit
  std::vector<Plane> mouth_T;        ///< a place is inside where it is inside of all
};

/// None: it has no jaws that hold anything.
std::optional<SoftGripper> gripper_of(const Instrument& instrument, std::size_t size);
/// Of each name of a tray ("grasper", "grasper:2.7"). Fails where the instruments cannot be read.
Result<std::vector<std::optional<SoftGripper>>> make_soft_grippers(
    std::span<const std::string> tray);

}  // namespace osteon
