#include "soft/solid_fields.h"

#include "soft/solid_cutting.h"

namespace osteon {
namespace {

constexpr double kSolidCell_m = 0.0005, kSolidOutside_m = 0.0065, kSolidInside_m = 0.001;
// Of the field that is cut: a blade's slit is wider, so no line of nodes leads across it.
constexpr double kCutCell_m = 0.0003;

}  // namespace

Result<void> make_solid_fields(const TriMesh& mesh_B, const std::string& what, SoftSolid& out) {
  auto field = DistanceField::make(mesh_B, {kSolidCell_m, kSolidOutside_m, kSolidInside_m});
  if (!field) {
    field.error().where = what;
    return tl::unexpected(field.error());
  }
  out.field = std::make_shared<const DistanceField>(std::move(*field));
  UncutFieldOptions options;
  options.cell_m = kCutCell_m;
  options.room_m = kSolidCutAir_m + 3 * kCutCell_m;
  auto uncut = UncutField::make(mesh_B, options);
  if (!uncut) {
    uncut.error().where = what;
    return tl::unexpected(uncut.error());
  }
  out.uncut = std::move(*uncut);
  return {};
}

}  // namespace osteon
