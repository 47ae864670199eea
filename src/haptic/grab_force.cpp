#include "grab_force.h"

namespace osteon {

Vec3 grab_force(const Vec3& displacement_W, const Vec3& v_W, double stiffness_n_per_m,
                double damping_n_s_per_m) {
  return -stiffness_n_per_m * displacement_W - damping_n_s_per_m * v_W;
}

}  // namespace osteon
