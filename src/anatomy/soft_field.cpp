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

/// Surface of what `shape` holds and the defects and obstacles leave; no point of the shape is
/// deeper in it than `depth`.
template <class Shape>
Result<TriMesh> grow_clipped(const Shape& shape, const Aabb& box, double depth, double sink,
                             const SoftDescription& soft, const std::vector<Obstacle>& all,
                             IsosurfaceOptions options) {
  options.uncrossed = true;
  for (const BoundPart& defect : soft.defects) {
    options.stretch = std::max(options.stretch, stretch(defect.part.primitive));
    options.slack_m += 0.25 * defect.part.blend;
  }
  const std::vector<Obstacle> obstacles = near_box(all, box.grown(options.cell_m));
  // Obstacles count where the shape itself is; elsewhere its own distance is a bound that will do.
  const double beyond = 2 * options.cell_m;
  const double farthest = depth + beyond;
  SampledField nearest([&](const Vec3& p) { return nearest_obstacle(obstacles, p, farthest); },
                       box.grown(3 * options.cell_m), options.cell_m);
  const auto field = [&](const Vec3& p) {
    double d = shape(p);
    for (const BoundPart& defect : soft.defects) d = less(d, defect.part, p);
    if (d > beyond) return d;
    return std::max(d, -nearest(p) - sink);
  };
  options.slack_m += beyond + sink;
  auto mesh = isosurface(field, box.grown(options.cell_m), options);
  if (mesh) keep_largest_pieces(*mesh, soft.pieces);
  return mesh;
}

Solid solid_of(const std::vector<BoundPart>& parts) {
  Solid solid;
  for (const BoundPart& part : parts) solid.parts.push_back(part.part);
  return solid;
}

/// A bone's parts, whose own distances are near enough for an outline and quick.
struct FleshBone {
  const Solid* solid;
  Aabb box_W;
  Mat3 R_BW;
  Vec3 p_BW;
};

FleshBone place(const BoneDescription& bone, const Pose& X_WB) {
  const Mat3 R_WB = X_WB.q.toRotationMatrix();
  FleshBone placed{&bone.solid, {}, R_WB.transpose(), {}};
  placed.p_BW = -(placed.R_BW * X_WB.p);
  const Aabb box_B = bounds(bone.solid);
  const Vec3 center_W = R_WB * box_B.center() + X_WB.p;
  const Vec3 half = R_WB.cwiseAbs() * (0.5 * box_B.extent());
  placed.box_W = {center_W - half, center_W + half};
  return placed;
}

IsosurfaceOptions options_for(const Solid& solid, double cell_m) {
  IsosurfaceOptions options;
  options.cell_m = cell_m;
  options.stretch = stretch(solid);
  for (const Part& part : solid.parts) options.slack_m += 0.25 * part.blend;
  return options;
}

}  // namespace

Result<TriMesh> grow_band(const LaidBand& band, double sink, const SoftDescription& soft,
                          const std::vector<Obstacle>& obstacles) {
  IsosurfaceOptions options;
  options.cell_m = soft.cell;
  // Distances beside a bent or widening band are not exact.
  double depth = 0;
  for (const BandSection& s : band.sections) {
    options.slack_m = std::max(options.slack_m, 0.5 * s.half_width);
    depth = std::max(depth, s.half_thickness);
  }
  return grow_clipped([&](const Vec3& p) { return distance(band, p); }, bounds(band), depth, sink,
                      soft, obstacles, options);
}

Result<TriMesh> grow_volume(const VolumeDescription& volume, const SoftDescription& soft,
                            const std::vector<Obstacle>& obstacles) {
  const Solid solid = solid_of(volume.parts);
  const Aabb box = bounds(solid);
  const double depth = 0.5 * box.extent().minCoeff();
  return grow_clipped([&](const Vec3& p) { return distance(solid, p); }, box, depth, volume.sink,
                      soft, obstacles, options_for(solid, soft.cell));
}

Result<TriMesh> grow_skin(const SkinDescription& skin, double cell_m,
                          const std::vector<BoneDescription>& bones,
                          const std::vector<Pose>& poses) {
  Solid flesh, cuts;
  for (const BoundPart& part : skin.parts)
    (part.part.operation == Operation::kAdd ? flesh : cuts).parts.push_back(part.part);
  IsosurfaceOptions options = options_for(flesh, cell_m);
  options.slack_m += 0.25 * skin.blend * static_cast<double>(bones.size());
  Aabb box = bounds(flesh);
  std::vector<FleshBone> placed;
  for (std::size_t i = 0; i < bones.size(); ++i) {
    placed.push_back(place(bones[i], poses[i]));
    options.stretch = std::max(options.stretch, stretch(bones[i].solid));
    box.include(placed.back().box_W.lo - Vec3::Constant(skin.offset + 0.5 * skin.blend));
    box.include(placed.back().box_W.hi + Vec3::Constant(skin.offset + 0.5 * skin.blend));
  }
  const auto field = [&](const Vec3& p) {
    double d = distance(flesh, p);
    for (const FleshBone& bone : placed) {
      if (distance_to_box(p, bone.box_W) - skin.offset > d + skin.blend) continue;
      const Vec3 p_B = bone.R_BW * p + bone.p_BW;
      d = smooth_min(d, distance(*bone.solid, p_B) - skin.offset, skin.blend);
    }
    for (const Part& cut : cuts.parts) d = smooth_max(d, -distance(cut.primitive, p), cut.blend);
    return d;
  };
  auto mesh = isosurface(field, box.grown(cell_m), options);
  if (mesh) keep_largest_pieces(*mesh, 1);
  return mesh;
}

}  // namespace osteon
