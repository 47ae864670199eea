#pragma once

#include <memory>

#include "osteon/collide/distance_field.h"

namespace osteon {

/// Radius of the thickest part of an instrument, m: a field holds off no more.
inline constexpr double kThickestFelt_m = 0.018;

/// Of a bone felt as a field: where a part thicker than the fine field's band looks for the nearest
/// place. Its band holds kThickestFelt_m, its cells are 2 mm (more on a long bone).
FieldOptions wide_field_options();
/// None when the mesh has no field.
std::shared_ptr<const DistanceField> make_wide_field(const TriMesh& mesh);

}  // namespace osteon
