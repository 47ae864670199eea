#include "soft_field.h"

#include <algorithm>

#include "largest_piece.h"
#include "osteon/mesh/isosurface.h"
#include "sampled_field.h"

namespace osteon {
namespace {

double distance_to_box(const Vec3& p, const Aabb& box) {
  return (box.lo - p).cwiseMax(p - box.hi).cwiseMax(0.0).norm();
}

/// Least distance to an obstacle, at most `limit`.
double nearest_obstacle(const std::vector<Obstacle>& obstacles, const Vec3& p, double limit) {
  for (const Obstacle& o : obstacles)
    if (distance_to_box(p, o.box) < limit)
      limit = std::min(limit, o.surface->closest(p).signed_distance);
  return limit;
}

std::vector<Obstacle> near_box(const std::vector<Obstacle>& obstacles, const Aabb& box) {
  std::vector<Obstacle> near;
  for (const Obstacle& o : obstacles)
    if (o.box.overlaps(box)) near.push_back(o);
  return near;
}

/// Surface of what `shape` holds and the obstacles leave.
template <class Shape>
Result<TriMesh> grow_clipped(const Shape& shape, const Aabb& box, double sink,
                             const std::vector<Obstacle>& all, IsosurfaceOptions options) {
  const std::vector<Obstacle> obstacles = near_box(all, box.grown(options.cell_m));
  // Obstacles count where the shape itself is; elsewhere its own distance is a bound that will do.
  const double beyond = 2 * options.cell_m;
  const double farthest = 0.5 * box.extent().norm() + beyond;
  SampledField nearest([&](const Vec3& p) { return nearest_obstacle(obstacles, p, farthest); },
                       box.grown(3 * options.cell_m), options.cell_m);
  const auto field = [&](const Vec3& p) {
    const double d = shape(p);
    if (d > beyond) return d;
    return std::max(d, -nearest(p) - sink);
  };
  options.slack_m += beyond + sink;
  auto mesh = isosurface(field, box.grown(options.cell_m), options);
  if (mesh) keep_largest_piece(*mesh);
  return mesh;
}

Solid solid_of(const std::vector<BoundPart>& parts) {
  Solid solid;
  for (const BoundPart& part : parts) solid.parts.push_back(part.part);
  return solid;
}

IsosurfaceOptions options_for(const Solid& solid, double cell_m) {
  IsosurfaceOptions options;
  options.cell_m = cell_m;
  options.stretch = stretch(solid);
  for (const Part& part : solid.parts) options.slack_m += 0.25 * part.blend;
  return options;
}

}  // namespace

Result<TriMesh> grow_band(const LaidBand& band, double sink, double cell_m,
                          const std::vector<Obstacle>& obstacles) {
  IsosurfaceOptions options;
  options.cell_m = cell_m;
  // Distances beside a bent or widening band are not exact.
  for (const BandSection& s : band.sections)
    options.slack_m = std::max(options.slack_m, 0.5 * s.half_width);
  return grow_clipped([&](const Vec3& p) { return distance(band, p); }, bounds(band), sink,
                      obstacles, options);
}

Result<TriMesh> grow_volume(const VolumeDescription& volume, double cell_m,
                            const std::vector<Obstacle>& obstacles) {
  const Solid solid = solid_of(volume.parts);
  return grow_clipped([&](const Vec3& p) { return distance(solid, p); }, bounds(solid), volume.sink,
                      obstacles, options_for(solid, cell_m));
}

Result<TriMesh> grow_skin(const SkinDescription& skin, double cell_m, const GroundView& ground) {
  Solid flesh, cuts;
  for (const BoundPart& part : skin.parts)
    (part.part.operation == Operation::kAdd ? flesh : cuts).parts.push_back(part.part);
  IsosurfaceOptions options = options_for(flesh, cell_m);
  options.slack_m += 0.25 * skin.blend * static_cast<double>(ground.size());
  Aabb box = bounds(flesh);
  for (const SoftGround* bone : ground) {
    box.include(bone->box.lo - Vec3::Constant(skin.offset + 0.5 * skin.blend));
    box.include(bone->box.hi + Vec3::Constant(skin.offset + 0.5 * skin.blend));
  }
  // Bones count where they come near the outline.
  const double beyond = 3 * cell_m + skin.blend;
  SampledField over_bone(
      [&](const Vec3& p) {
        double d = beyond;
        for (const SoftGround* bone : ground)
          if (distance_to_box(p, bone->box) - skin.offset < d + skin.blend)
            d = smooth_min(d, bone->surface.closest(p).signed_distance - skin.offset, skin.blend);
        return d;
      },
      box.grown(2 * cell_m), cell_m);
  const auto field = [&](const Vec3& p) {
    double d = distance(flesh, p);
    if (d > -beyond) d = smooth_min(d, over_bone(p), skin.blend);
    for (const Part& cut : cuts.parts) d = smooth_max(d, -distance(cut.primitive, p), cut.blend);
    return d;
  };
  auto mesh = isosurface(field, box.grown(cell_m), options);
  if (mesh) keep_largest_piece(*mesh);
  return mesh;
}

}  // namespace osteon
