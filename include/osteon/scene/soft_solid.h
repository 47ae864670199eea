#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "osteon/base/types.h"
#include "osteon/collide/round_box.h"

namespace osteon {

/// Where a part of a tool and a soft solid can meet: what physics tells the 1 kHz tick. The solid
/// is a plane there that gives way, and goes with its bone.
struct SolidContact {
  std::uint32_t solid = 0;
  std::uint32_t bone = 0;        ///< that the solid goes with
  std::uint32_t part = 0;        ///< of tool_rods() of the instrument
  double along = 0;              ///< 0 to 1: the place on the part's axis that is pressed
  Vec3 core = Vec3::Zero();      ///< of a box: the place on its core, in the box's axes
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

/// On the core of the part that is pressed, in the frame of `part_B`.
inline Vec3 pressed_place(const SolidContact& contact, const RoundBox& part_B) {
  if (part_B.is_box) return part_B.X * contact.core;
  return part_B.rod.p0 + contact.along * (part_B.rod.p1 - part_B.rod.p0);
}

/// `part_B`: in the frame of the solid's bone. `coupling_n_per_m`: of the hand, which is not to
/// meet anything stiffer.
inline SolidPress press_solid(const SolidContact& contact, const RoundBox& part_B,
                              double coupling_n_per_m) {
  SolidPress out;
  const Vec3 core = pressed_place(contact, part_B);
  out.deep_m = part_B.rod.radius - contact.nhat_B.dot(core - contact.p_B);
  const double k =
      contact.stiffness_n_per_m < coupling_n_per_m ? contact.stiffness_n_per_m : coupling_n_per_m;
  const double pressed = out.deep_m - contact.others_m;
  out.force_n = out.deep_m > 0 && pressed > 0 ? k * pressed : 0;
  return out;
}

}  // namespace osteon
