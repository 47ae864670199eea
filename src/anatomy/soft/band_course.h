#pragma once

#include "soft/soft_band.h"

namespace osteon {

/// The motion, in World, of a band's cross-section when the band comes from one course to another:
/// of the section that lies nearest to `near_W` on the first one. It goes to the same share of the
/// way between the band's ends, turned as the course and the flat side turn there.
Pose motion_along(const LaidBand& from, const LaidBand& to, const Vec3& near_W);

}  // namespace osteon
