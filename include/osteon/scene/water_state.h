#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "osteon/base/id.h"
#include "osteon/base/types.h"

namespace osteon {

inline constexpr std::uint32_t kNoWound = 0xffffffffu;
inline constexpr std::size_t kMaxWounds = 12;

/// A place of a soft part that bleeds into the joint.
struct Wound {
  std::uint32_t soft = kNoWound;  ///< in Case::softs; kNoWound: the place is free
  BoneId bone;                    ///< that it goes with
  Vec3 p_B = Vec3::Zero();
  double open_m2 = 0;  ///< of its surface
  bool operator==(const Wound&) const = default;
};

/// The water in a joint of a session and what clouds it: part of the physics' state, the same bits
/// after the same inputs. Its law is in physics/joint_fluid.h.
struct WaterState {
  bool on = false;           ///< the case has a joint that is filled
  bool hashed = false;       ///< it counts for a state's hash; not in recordings made before it did
  double pump_pa = 0;        ///< as the user has set it
  double outlet_open = 0;    ///< likewise, 0 to 1
  double pressure_pa = 0;    ///< in the joint, above the air's
  double blood = 0;          ///< share of the volume, 0 to 1
  double debris = 0;         ///< likewise
  double suction = 0;        ///< of the last step: the strongest of all hands, 0 to 1
  double bleeding_m3_s = 0;  ///< of all sources, into a joint without pressure
  double debris_m3_s = 0;    ///< slurry that the tools make
  double removed_m3 = 0;     ///< bone that was gone when it was looked at last
  double vascular_m3 = 0;    ///< of that, soft bone and marrow
  double opened_m3 = 0;      ///< of that, what bleeds into the joint
  std::array<Wound, kMaxWounds> wounds{};
  bool operator==(const WaterState&) const = default;
};

}  // namespace osteon
