#include "exercises/surface_heat.h"

#include <cstddef>
#include <cstdint>

namespace osteon {

// Of vertices that are gone, cells of bone beside them tell.
void SurfaceHeat::finish(DamageMaker& damage) const {
  if (!heat_.bones()) return;
  for (std::uint32_t b = 0; b < case_->bones.size(); ++b) {
    const BoneHeat* const heat = heat_.bones()->bone(b);
    if (!heat) continue;
    for (const Vec3& p_B : case_->bones[b].mesh.vertices)
      if (const double celsius = heat->hottest_at(p_B); celsius > heat->body_c())
        damage.warm(b, p_B, celsius);
  }
}

}  // namespace osteon
