#pragma once

#include <string_view>

#include "acl_knee.h"
#include "osteon/surgeon/acl_surgeon.h"

namespace osteon {

inline constexpr double kAclTurn = 3.14159265358979323846 / 180;

/// Where a pin is set on a bone, and which way it looks.
struct AclLine {
  Vec3 at_W = Vec3::Zero(), in_W = Vec3::UnitZ();
};

/// From the front of the tibia's inner side to its footprint, 40 to 60 degrees to the plateau and
/// about 45 mm long. `miss_W`: how far the place that is aimed at lies beside the footprint.
Result<AclLine> tibial_line(const AclKnee& knee, std::string_view fault, const Vec3& miss_W,
                            double reamed_m);

/// On the femoral footprint, see plan_acl.
Result<AclLine> femoral_line(const AclKnee& knee, std::string_view fault, const Vec3& miss_W,
                             double reamed_m);

}  // namespace osteon
