#pragma once

#include "osteon/base/types.h"

namespace osteon {

/// Resistance to dragging a grabbed vertex, N, World: proportional to its displacement (vKASS,
/// section 3.2) and against it, with a damper: -k u - b v. `displacement_W`: the hand from where it
/// grabbed, m; `v_W`: of the hand, m/s.
Vec3 grab_force(const Vec3& displacement_W, const Vec3& v_W, double stiffness_n_per_m,
                double damping_n_s_per_m);

}  // namespace osteon
