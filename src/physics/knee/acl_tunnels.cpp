#include "osteon/physics/acl_tunnels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "knee/acl_frame.h"

namespace osteon {
namespace {

constexpr double kTargetDepth = 0.248, kTargetHeight = 0.285;  // K: the footprint's middle
constexpr double kNotchWidth_m = 0.0204;  // of the clock: hindawi ari/2012/679658
constexpr double kWalkedOut_m = 1e-5;

// A drilled line as in KneeParts.
struct Axis {
  Vec3 from, to, along;
  double length = 0, radius = 0;
  bool open = false;  // at both ends, as was seen in the drilled bone
};

// Of a line through a bone the stretch that was drilled: from the mouth inwards.
struct Bore {
  Vec3 mouth, inwards;
  double channel = 0, drilled = 0;
  bool through = false;
};

Result<Axis> axis_of(const KneeParts& parts, const KneeParts::Bone& bone, const DrilledLine& line) {
  const std::string where = "the line in the " + std::string(bone.name);
  if (!is_finite(line.from_W) || !is_finite(line.to_W) || !std::isfinite(line.diameter_m))
    return fail("holds a number that is not finite", where);
  if (!(line.diameter_m >= 0.001 && line.diameter_m <= 0.02))
    return fail("is not 1 to 20 mm thick", where);
  Axis axis;
  axis.from = parts.place(bone, line.from_W);
  axis.to = parts.place(bone, line.to_W);
  axis.length = (axis.to - axis.from).norm();
  axis.radius = 0.5 * line.diameter_m;
  axis.open = line.open;
  if (!(axis.length > 0.001)) return fail("is shorter than a millimetre", where);
  axis.along = (axis.to - axis.from) / axis.length;
  return axis;
}

// Of the line's stretches in bone the one that the drill went farthest in; the mouth is its end
// nearest to where the joint is.
Result<Bore> bore_of(const KneeParts::Bone& bone, const Axis& axis, const Vec3& joint) {
  std::pair<double, double> best{0, 0};
  double most = 0;
  for (const auto& [in, out] : stretches_inside(bone.surface->mesh(), axis.from, axis.along)) {
    const double drilled = std::min(out, axis.length) - std::max(in, 0.0);
    if (!(drilled > most)) continue;
    most = drilled;
    best = {in, out};
  }
  if (!(most > 0.001))
    return fail("the drill's axis misses the bone", "the " + std::string(bone.name),
                "Give its start and end, in mm, World");
  const Vec3 in = axis.from + best.first * axis.along, out = axis.from + best.second * axis.along;
  const bool begins = (in - joint).norm() < (out - joint).norm();
  Bore bore;
  bore.mouth = begins ? in : out;
  bore.inwards = begins ? axis.along : Vec3(-axis.along);
  bore.channel = best.second - best.first;
  bore.drilled = most;
  bore.through = axis.open || (axis.length > best.second && best.first > 0);
  return bore;
}

// From a place inside along a unit direction to the surface: each stride is no longer than the
// distance to it, so none is crossed; it ends since strides shorter than the last one stop it.
double way_out(const MeshDistance& surface, const Vec3& p, const Vec3& direction) {
  double way = 0;
  for (int stride = 0; stride < 200; ++stride) {
    const double inside = -surface.closest(p + way * direction).signed_distance;
    if (inside < kWalkedOut_m) break;
    way += inside;
  }
  return way;
}

// At the mouth: from its hind edge to the hind border of the condyle at that height.
double rim_behind(const KneeParts& parts, const QuadrantGrid& grid, const Vec3& mouth,
                  double radius) {
  constexpr double kSlice_m = 0.0015;
  double border = grid.front;
  for (const Vec3& p : parts.femur.surface->mesh().vertices)
    if (p.y() < grid.axes.origin.y() && std::abs(grid.axes.v(p) - grid.axes.v(mouth)) < kSlice_m)
      border = std::min(border, grid.axes.u(p));
  return grid.axes.u(mouth) - radius - border;
}

// What stands behind a tunnel: bone from its axis out, over the hind third of the way round.
class BehindTunnel {
 public:
  BehindTunnel(const KneeParts& parts, const QuadrantGrid& grid, const Bore& bore, double radius)
      : surface_(*parts.femur.surface), bore_(bore), radius_(radius) {
    const Vec3& w = bore.inwards;
    hind_ = (-grid.axes.along + grid.axes.along.dot(w) * w).normalized();
    side_ = w.cross(hind_);
  }

  // The least at one depth; 0 or less where the tunnel is open.
  double wall_m(double depth_m) const {
    constexpr int kAround = 5;
    double least = 1e9;
    for (int k = -kAround; k <= kAround; ++k) {
      const double a = std::numbers::pi / 3 * k / kAround;
      const Vec3 out = std::cos(a) * hind_ + std::sin(a) * side_;
      const Vec3 p = bore_.mouth + depth_m * bore_.inwards;
      least = std::min(least, way_out(surface_, p, out) - radius_);
    }
    return least;
  }

  // A slanted mouth is closed all round only so deep, with a millimetre for its thin lip. What is
  // still open at the deepest is no mouth but a missing wall.
  double mouth_depth_m(double deepest_m) const {
    constexpr double kStride_m = 0.0005, kLip_m = 0.001;
    for (double depth = 0; depth < deepest_m; depth += kStride_m)
      if (wall_m(depth) > 0) return std::min(depth + kLip_m, deepest_m);
    return deepest_m;
  }

 private:
  const MeshDistance& surface_;
  const Bore& bore_;
  double radius_;
  Vec3 hind_, side_;
};

// Least bone behind the tunnel: at its mouth, and from where that is closed to as deep as it was
// drilled.
double back_wall(const KneeParts& parts, const QuadrantGrid& grid, const Bore& bore,
                 double radius) {
  constexpr int kAlong = 12;
  constexpr double kDeepestMouth_m = 0.0125;
  const BehindTunnel behind(parts, grid, bore, radius);
  const double first = behind.mouth_depth_m(std::min(kDeepestMouth_m, bore.drilled));
  // Of one that goes through, the far mouth is open by its nature.
  const bool open_end = bore.drilled > bore.channel - 0.001;
  const double last = std::max(first, open_end ? bore.drilled - 2 * radius : bore.drilled);
  double least = rim_behind(parts, grid, bore.mouth, radius);
  for (int i = 0; i <= kAlong; ++i)
    least = std::min(least, behind.wall_m(first + (last - first) * i / kAlong));
  return least;
}

// Back from KneeParts to World.
Vec3 place_W(const KneeParts& parts, const KneeParts::Bone& bone, Vec3 p) {
  if (parts.left) p.y() = -p.y();
  return bone.X_FW.inverse() * p;
}

Result<FemoralTunnel> measure_femur(const CaseDef& def, const KneeParts& parts,
                                    const DrilledLine& line) {
  const auto grid = quadrant_grid(def, parts);
  if (!grid) return tl::unexpected(grid.error());
  const auto axis = axis_of(parts, parts.femur, line);
  if (!axis) return tl::unexpected(axis.error());
  // The mouth lies in the notch: its far end, on the outer side, is nearer to that.
  const Vec3 notch = grid->axes.origin + 0.5 * grid->height * grid->axes.across;
  const auto bore = bore_of(parts.femur, *axis, notch);
  if (!bore) return tl::unexpected(bore.error());
  FemoralTunnel out;
  const Vec3& mouth = bore->mouth;
  out.aperture_W = place_W(parts, parts.femur, mouth);
  out.inwards_W = place_W(parts, parts.femur, mouth + bore->inwards) - out.aperture_W;
  out.depth_share = grid->depth_share(mouth);
  out.height_share = grid->height_share(mouth);
  out.off_target_m = std::hypot((out.depth_share - kTargetDepth) * (grid->front - grid->hind),
                                (out.height_share - kTargetHeight) * grid->height);
  const double up = 0.5 * kNotchWidth_m * parts.scale - grid->axes.v(mouth);
  out.from_roof_rad = std::atan2(grid->axes.origin.y() - mouth.y(), up);
  out.channel_m = bore->channel;
  out.drilled_m = bore->drilled;
  out.diameter_m = line.diameter_m;
  out.through = bore->through;
  out.back_wall_m = back_wall(parts, *grid, *bore, axis->radius);
  out.blow_out = out.back_wall_m <= 0;
  return out;
}

// Where the roof of the notch, led on straight, meets the plane of the plateau through a place:
// how far behind that the place lies.
double behind_roof(const QuadrantGrid& roof, const PlateauGrid& plateau, const Vec3& p) {
  const Vec3 along = plateau.axes.along;
  const double rise = roof.axes.across.dot(along);
  return std::abs(rise) > 1e-6 ? roof.axes.v(p) / rise : 0;
}

Result<TibialTunnel> measure_tibia(const CaseDef& def, const KneeParts& parts,
                                   const DrilledLine& line) {
  const auto plateau = plateau_grid(def, parts);
  if (!plateau) return tl::unexpected(plateau.error());
  const auto roof = quadrant_grid(def, parts);
  if (!roof) return tl::unexpected(roof.error());
  const auto axis = axis_of(parts, parts.tibia, line);
  if (!axis) return tl::unexpected(axis.error());
  const Vec3 joint = plateau->axes.origin - 0.01 * plateau->axes.across;
  const auto bore = bore_of(parts.tibia, *axis, joint);
  if (!bore) return tl::unexpected(bore.error());
  TibialTunnel out;
  out.aperture_W = place_W(parts, parts.tibia, bore->mouth);
  out.inwards_W = place_W(parts, parts.tibia, bore->mouth + bore->inwards) - out.aperture_W;
  out.front_share = plateau->front_share(bore->mouth);
  out.medial_share = plateau->medial_share(bore->mouth);
  out.length_m = bore->drilled;
  out.diameter_m = line.diameter_m;
  out.through = bore->through;
  const double rise = std::abs(bore->inwards.dot(plateau->axes.across));
  out.to_plateau_rad = std::atan2(rise, std::abs(bore->inwards.dot(plateau->axes.along)));
  out.behind_roof_m =
      behind_roof(*roof, *plateau, bore->mouth) - axis->radius / std::sin(out.to_plateau_rad);
  return out;
}

}  // namespace

Result<AclTunnels> measure_tunnels(const CaseDef& def, const AclDrilling& drilling) {
  // Widths are counted against the built-in knee's own, as the table of ligaments has them.
  constexpr double kWidth_m = 0.084;
  const auto parts = find_knee_parts(def, kWidth_m);
  if (!parts) return tl::unexpected(parts.error());
  AclTunnels out;
  if (drilling.femur) {
    auto femur = measure_femur(def, *parts, *drilling.femur);
    if (!femur) return tl::unexpected(femur.error());
    out.femur = std::move(*femur);
  }
  if (drilling.tibia) {
    auto tibia = measure_tibia(def, *parts, *drilling.tibia);
    if (!tibia) return tl::unexpected(tibia.error());
    out.tibia = std::move(*tibia);
  }
  return out;
}

}  // namespace osteon
