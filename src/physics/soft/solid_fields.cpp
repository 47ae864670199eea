#include "soft/solid_fields.h"

#include "osteon/scene/field_cache.h"
#include "soft/solid_cutting.h"

namespace osteon {
namespace {

constexpr double kSolidCell_m = 0.0005, kSolidOutside_m = 0.0065, kSolidInside_m = 0.001;
// Of the field that is cut: a blade's slit is wider, so no line of nodes leads across it.
constexpr double kCutCell_m = 0.0003;

Result<FieldCache::Field> field_of(const TriMesh& mesh_B, FieldCache* known) {
  const FieldOptions options{kSolidCell_m, kSolidOutside_m, kSolidInside_m};
  const std::uint64_t key = known ? field_key(mesh_B, options) : 0;
  if (const FieldCache::Field found = known ? known->find(key) : nullptr) return found;
  auto made = DistanceField::make(mesh_B, options);
  if (!made) return tl::unexpected(made.error());
  FieldCache::Field field = std::make_shared<const DistanceField>(std::move(*made));
  if (known) known->put(key, field);
  return field;
}

}  // namespace

Result<void> make_solid_fields(const TriMesh& mesh_B, const std::string& what, FieldCache* known,
                               SoftSolid& out) {
  auto field = field_of(mesh_B, known);
  if (!field) {
    field.error().where = what;
    return tl::unexpected(field.error());
  }
  out.field = std::move(*field);
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
