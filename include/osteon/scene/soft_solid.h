#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "osteon/base/types.h"
#include "osteon/collide/capsule_contact.h"

namespace osteon {

/// Where a part of a tool and a soft solid can meet: what physics tells the 1 kHz tick. The solid
/// is a plane there that gives way, and goes with its bone.
struct SolidContact {
  std::uint32_t solid = 0;
  std::uint32_t bone = 0;        ///< that the solid goes with
  std::uint32_t part = 0;        ///< of tool_rods() of the instrument
  double along = 0;              ///< 0 to 1: the place on the part's axis that is pressed
  Vec3 p_B = Vec3::Zero();       ///< of the surface at rest
  Vec3 nhat_B = Vec3::UnitZ();   ///< unit, out of the solid, on the side where the part came
  double stiffness_n_per_m = 0;  ///< of the solid there
  double others_m = 0;           ///< by so much other contacts press it away
  bool operator==(const SolidContact&) const = default;
};

inline constexpr std::size_t kMaxSolids = 4;
inline constexpr std::size_t kMaxSolidContacts = 6;  ///< of a hand

/// How a part of a tool presses a solid.
struct SolidPress {
  double deep_m = 0;   ///< over the surface at rest
  double force_n = 0;  ///< on the tool, along the contact's normal; never negative
};

/// `part_B`: in the frame of the solid's bone. `coupling_n_per_m`: of the hand, which is not to
/// meet anything stiffer.
inline SolidPress press_solid(const SolidContact& contact, const Capsule& part_B,
                              double coupling_n_per_m) {
  SolidPress out;
  const Vec3 axis = part_B.p0 + contact.along * (part_B.p1 - part_B.p0);
  out.deep_m = part_B.radius - contact.nhat_B.dot(axis - contact.p_B);
  const double k =
      contact.stiffness_n_per_m < coupling_n_per_m ? contact.stiffness_n_per_m : coupling_n_per_m;
  const double pressed = out.deep_m - contact.others_m;
  out.force_n = out.deep_m > 0 && pressed > 0 ? k * pressed : 0;
  return out;
}

}  // namespace osteon
