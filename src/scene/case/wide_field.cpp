#include "osteon/scene/wide_field.h"

#include <utility>

namespace osteon {

FieldOptions wide_field_options() {
  constexpr double kCell = 0.002;
  FieldOptions options;
  options.cell_m = kCell;
  // Cells may be doubled twice on a long bone.
  options.outside_m = kThickestFelt_m + 4 * kCell;
  options.inside_m = 0.002;
  options.most_blocks = 512;
  return options;
}

std::shared_ptr<const DistanceField> make_wide_field(const TriMesh& mesh) {
  auto made = DistanceField::make(mesh, wide_field_options());
  return made ? std::make_shared<const DistanceField>(std::move(*made)) : nullptr;
}

}  // namespace osteon
