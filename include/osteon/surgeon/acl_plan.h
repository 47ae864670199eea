#pragma once

#include <string_view>

#include "osteon/base/result.h"
#include "osteon/scene/case.h"

namespace osteon {

/// Lines of both tunnels as a virtual surgeon sets them: where the pin stands, and which way it
/// looks, in the frame of the bone.
struct AclPlan {
  Vec3 femur_B = Vec3::Zero(), femur_in_B = Vec3::UnitZ();
  Vec3 tibia_B = Vec3::Zero(), tibia_in_B = Vec3::UnitZ();
};

/// Of an expert in a bent knee; `fault`: one of acl_faults() that is about a tunnel, or nothing.
/// `spares_softs`: the way to the femur keeps off menisci and the other cruciate ligament, which
/// are felt. Fails as plan_acl does.
Result<AclPlan> plan_tunnels(const Case& the_case, std::string_view fault, double reamed_m,
                             bool spares_softs = false);

}  // namespace osteon
