#include "soft/soft_field.h"

#include <algorithm>

#include "bone/largest_piece.h"
#include "bone/nearby_surface.h"
#include "bone/sampled_field.h"
#include "osteon/mesh/isosurface.h"
#include "soft/near_band.h"
#include "soft/skin_field.h"

namespace osteon {
namespace {

constexpr double kRoundCells = 1.5;  // of a volume's edge beside an obstacle (D)

/// The obstacles near a shape, as it is asked for point after point.
class NearestObstacle {
 public:
  /// `least`: thickness that is left between obstacles of two bones.
  NearestObstacle(const std::vector<Obstacle>& all, const Aabb& box, double least) : least_(least) {
    for (const Obstacle& o : all)
      if (o.box.overlaps(box)) near_.push_back({NearbySurface(*o.surface, o.box), o.bone});
  }
  /// Least distance to an obstacle, at most `limit`; between two bones that leave too little room,
  /// more by half of what is missing.
  double operator()(const Vec3& p, double limit) {
    double first = limit, second = limit;  // of one bone, and of any other
    std::optional<std::size_t> bone;
    for (Near& o : near_) {
      const double nearer = least_ > 0 ? second : first;
      if (distance_to_box(p, o.surface.box()) >= nearer) continue;
      const auto at = o.surface.nearer_than(nearer, p);
      if (!at || at->signed_distance >= nearer) continue;
      if (at->signed_distance >= first) {
        if (o.bone != bone) second = at->signed_distance;
        continue;
      }
      if (o.bone != bone) second = first;
      first = at->signed_distance;
      bone = o.bone;
    }
    return first + std::max(0.0, 0.5 * (least_ - first - second));
  }

 private:
  struct Near {
    NearbySurface surface;
    std::optional<std::size_t> bone;
  };
  std::vector<Near> near_;
  double least_;
};

/// What a shape holds and defects and obstacles leave. Obstacles count where the shape itself is;
/// `beyond` it its own distance is a bound that will do. Where it would thin out beside one to an
/// edge that the cells cannot follow, it ends round, `round` in metres. Shape: NearSolid or
/// NearBandSpans.
template <class Shape>
class ClippedField : public LocalField {
 public:
  ClippedField(const Shape& shape, const std::vector<BoundPart>& defects, double beyond,
               double sink, double round, SampledField& nearest)
      : shape_(shape), beyond_(beyond), sink_(sink), round_(round), nearest_(nearest) {
    for (const BoundPart& defect : defects) defects_.push_back(&defect.part);
  }

  double at(const Vec3& p) const override {
    double d = shape_(p);
    for (const Part* defect : defects_) d = less(d, *defect, p);
    if (d > beyond_) return d;
    return smooth_max(d, -nearest_(p) - sink_, round_);
  }

  Near near(const Vec3& center, double radius) const override {
    const Vicinity where{center, radius};
    Spread values;
    const Shape shape = shape_.within(where, values);
    auto here = std::make_unique<ClippedField>(shape, std::vector<BoundPart>{}, beyond_, sink_,
                                               round_, nearest_);
    for (const Part* defect : defects_) {
      const Spread own = spread(defect->primitive, where);
      if (surely_less(negated(values), own, defect->blend)) continue;
      values = smooth_max(values, negated(own), defect->blend);
      here->defects_.push_back(defect);
    }
    // Obstacles only raise it.
    return {values.least > 0 ? 1 : 0, std::move(here)};
  }

 private:
  Shape shape_;
  std::vector<const Part*> defects_;
  double beyond_, sink_, round_;
  SampledField& nearest_;
};

/// Surface of what `shape` holds and the defects and obstacles leave; no point of the shape is
/// deeper in it than `depth`. `least`: thickness that they leave between two bones.
template <class Shape>
Result<TriMesh> grow_clipped(const Shape& shape, const Aabb& box, double depth, double sink,
                             double least, double round, const SoftDescription& soft,
                             const std::vector<Obstacle>& obstacles) {
  IsosurfaceOptions options;
  options.cell_m = soft.cell;
  options.uncrossed = true;
  const double beyond = 2 * soft.cell;
  NearestObstacle nearest(obstacles, box.grown(soft.cell), least);
  SampledField sampled([&](const Vec3& p) { return nearest(p, depth + beyond); },
                       box.grown(3 * soft.cell), soft.cell);
  const ClippedField<Shape> field(shape, soft.defects, beyond, sink, round, sampled);
  auto mesh = isosurface(field, box.grown(soft.cell), options);
  if (mesh) keep_largest_pieces(*mesh, soft.pieces);
  return mesh;
}

Solid solid_of(const std::vector<BoundPart>& parts) {
  Solid solid;
  for (const BoundPart& part : parts) solid.parts.push_back(part.part);
  return solid;
}

}  // namespace

Result<TriMesh> grow_band(const LaidBand& band, double sink, const SoftDescription& soft,
                          const std::vector<Obstacle>& obstacles) {
  double depth = 0;
  for (const BandSection& s : band.sections) depth = std::max(depth, s.half_thickness);
  return grow_clipped(NearBandSpans(band), bounds(band), depth, sink, 0, 0, soft, obstacles);
}

Result<TriMesh> grow_volume(const VolumeDescription& volume, const SoftDescription& soft,
                            const std::vector<Obstacle>& obstacles) {
  const Solid solid = solid_of(volume.parts);
  const Aabb box = bounds(solid);
  const double depth = 0.5 * box.extent().minCoeff();
  const double round = kRoundCells * soft.cell;
  return grow_clipped(NearSolid(solid), box, depth, volume.sink, volume.least, round, soft,
                      obstacles);
}

Result<TriMesh> grow_skin(const SkinDescription& skin, double cell_m,
                          const std::vector<BoneDescription>& bones,
                          const std::vector<Pose>& poses) {
  const SkinField field(skin, bones, poses);
  IsosurfaceOptions options;
  options.cell_m = cell_m;
  auto mesh = isosurface(field, field.bounds_W().grown(cell_m), options);
  if (mesh) keep_largest_pieces(*mesh, 1);
  return mesh;
}

}  // namespace osteon
