#include "osteon/mesh/bone_surface.h"

#include <algorithm>
#include <cmath>

#include "osteon/mesh/decimate.h"
#include "osteon/mesh/isosurface.h"
#include "osteon/mesh/repair.h"
#include "osteon/mesh/taubin.h"
#include "surface/half_maximum.h"
#include "surface/label_field.h"

namespace osteon {
namespace {

constexpr double kMostCells = 5e7;

/// The wanted cell, or a larger one that keeps the grid within memory.
double cell_for(const Aabb& box, double wanted_m) {
  const double volume_m3 = box.extent().prod();
  return std::max(wanted_m, std::cbrt(volume_m3 / kMostCells));
}

}  // namespace

Result<TriMesh> bone_surface(const Volume& volume, const LabelVolume& labels, std::uint16_t label,
                             const VoxelBox& box, const BoneSurfaceOptions& options) {
  const LabelField field(volume, labels, label, box, options.threshold_hu);
  IsosurfaceOptions surface;
  const double finest_m = labels.frame.spacing_m.minCoeff();
  surface.cell_m = cell_for(field.box_V(), options.cell_m > 0 ? options.cell_m : finest_m);
  surface.slack_m = finest_m;  // the field is bounded and tells nothing far off
  surface.relax_steps = 1;
  auto mesh = isosurface([&](const Vec3& p) { return field(p); }, field.box_V(), surface);
  if (!mesh) return mesh;
  snap_to_half_maximum(volume, options.soft_hu, *mesh);
  smooth_taubin(*mesh);
  decimate(*mesh, options.decimate_m);
  const GridFrame& frame = labels.frame;
  for (Vec3& v : mesh->vertices) v = frame.origin_P + frame.axes_P * v;
  return mesh;
}

}  // namespace osteon
