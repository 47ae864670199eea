#pragma once

#include <cstddef>
#include <cstdint>

#include "osteon/base/types.h"
#include "osteon/collide/round_box.h"

namespace osteon {

/// Instead of the number of a portal that was made in skin: none.
inline constexpr std::uint32_t kNotMade = 0xffffffffu;

/// Where a part of a tool and a patch of skin meet: what physics tells the 1 kHz tick. The force is
/// that of the last step and grows from there with the depth, so that it has no steps of 2 ms.
struct SkinContact {
  std::uint32_t patch = 0;
  std::uint32_t bone = 0;        ///< that the patch goes with
  std::uint32_t part = 0;        ///< of tool_rods() of the instrument
  double along = 0;              ///< 0 to 1: the place on the part's axis that is deepest
  Vec3 core = Vec3::Zero();      ///< of a box: the place on its core, in the box's axes
  Vec3 p_B = Vec3::Zero();       ///< of the skin at rest
  Vec3 nhat_B = Vec3::UnitZ();   ///< unit, out of the skin
  double deep_m = 0;             ///< of the part in the last step
  double force_n = 0;            ///< on the tool there, along the normal
  double stiffness_n_per_m = 0;  ///< by so much more for each metre deeper
  /// The tool has gone through: the force also holds it back, and the hole holds it sideways.
  bool through = false;
  Vec3 hole_B = Vec3::Zero();
  double aside_n_per_m = 0;
  /// Number of the made portal that it goes through. A hand that is held there feels so much less
  /// of this contact.
  std::uint32_t made = kNotMade;
  bool operator==(const SkinContact&) const = default;
};

inline constexpr std::size_t kMaxSkins = 4;  ///< of a session; a hand has one contact with each

/// Force of the skin on a tool.
struct SkinPushed {
  double deep_m = 0;            ///< over the skin at rest
  double force_n = 0;           ///< along the normal; below 0 it holds back
  Vec3 aside_B = Vec3::Zero();  ///< across it, N
  Vec3 p_B = Vec3::Zero();      ///< of the tool, where it is pressed
};

/// `part_B`: in the frame of the patch's bone; `X_BT`: the tool there, whose shaft goes along z.
inline SkinPushed press_skin(const SkinContact& contact, const RoundBox& part_B, const Pose& X_BT) {
  SkinPushed out;
  const Vec3& n = contact.nhat_B;
  const Vec3 axis = part_B.is_box
                        ? part_B.X * contact.core
                        : Vec3(part_B.rod.p0 + contact.along * (part_B.rod.p1 - part_B.rod.p0));
  out.p_B = axis - part_B.rod.radius * n;
  out.deep_m = n.dot(contact.p_B - out.p_B);
  if (!(out.deep_m > 0)) return out;
  const double force_n =
      contact.force_n + contact.stiffness_n_per_m * (out.deep_m - contact.deep_m);
  out.force_n = contact.through || force_n > 0 ? force_n : 0;
  if (!contact.through) return out;
  const Vec3 along = X_BT.rotate(Vec3::UnitZ());
  const double rise = n.dot(along);
  if (!(rise > 0.1)) return out;  // it lies on the skin
  const Vec3 passes = X_BT.p + n.dot(contact.hole_B - X_BT.p) / rise * along;
  const Vec3 off = passes - contact.hole_B;
  out.aside_B = -contact.aside_n_per_m * (off - n.dot(off) * n);
  return out;
}

}  // namespace osteon
