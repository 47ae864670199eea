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

/// Jaws or a mouth with suction that hold soft parts. The mouth of jaws is what they sweep when
/// they shut: a wedge from the hinge.
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
  double bore_m = 0;                 ///< diameter of what sucks; 0: these are jaws
  Vec3 bore_T = Vec3::Zero();        ///< its middle; it opens along -z
};

/// Of a cannula's outer diameter; own default.
inline constexpr double kBoreOfOuter = 0.75;
/// Force of full suction on what lies `gap_m` before its mouth, N: `holds_n` at the mouth. Beyond
/// it goes as the square of the speed of what flows in, v / v0 = A / (A + 10 gap^2) on the axis of
/// a round opening of area A (DallaValle 1939, Exhaust Hoods).
double suction_at(const SoftGripper& mouth, double gap_m);
/// None: it does not suck by a mouth of its own. Holds by the suction of a joint's water
/// (FluidJoint) on the area of its bore.
std::optional<SoftGripper> sucker_of(const Instrument& instrument, std::size_t size);

/// None: it has no jaws that hold anything.
std::optional<SoftGripper> gripper_of(const Instrument& instrument, std::size_t size);
/// Jaws and what sucks, of each name of a tray ("grasper", "suction:3"). Fails where the
/// instruments cannot be read.
Result<std::vector<std::optional<SoftGripper>>> make_soft_grippers(
    std::span<const std::string> tray);

}  // namespace osteon
