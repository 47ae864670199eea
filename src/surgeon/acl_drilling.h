#pragma once

#include <string_view>
#include <vector>

#include "acl_knee.h"
#include "acl_lines.h"
#include "osteon/surgeon/acl_driller.h"

namespace osteon {

/// What both tunnels are drilled with, as trays name it.
inline constexpr const char* kAclPin = "guide_pin";
inline constexpr const char* kAclTibialAimer = "tibial_aimer";
inline constexpr const char* kAclFemoralAimer = "femoral_offset_aimer:4";

/// Widths and depths of what is drilled, m.
struct AclDrillPlan {
  AclLine tibia, femur;
  double reamed_m = 0.008, channel_m = 0.0045, socket_m = 0.025;
  bool drills_tibia = true, drills_femur = true;
};

/// Pin, drill, pin out through the tibia; then aimer, pin, channel, socket, pin out of the femur;
/// of those bones that are to be drilled. `fault`: "no_pin", "plunged" or "short_socket" is done
/// wrong.
std::vector<AclMove> drill_both(const AclKnee& knee, const AclDrillPlan& plan,
                                std::string_view fault, double begin_s, double pace);

}  // namespace osteon
