#include "runs/reports/drilled_bone.h"

#include <algorithm>
#include <cmath>

#include "osteon/carve/carved_surface.h"
#include "osteon/carve/measure_holes.h"

namespace osteon {
namespace {

constexpr double kLedOn_m = 0.002;  // a line ends so far outside of the bone
constexpr double kOpens_m = 0.006;  // at most so far before the middle of its rim is no bone
// The same where neither end has a bottom: the rim of a flat tunnel is long.
constexpr double kOpensFlat_m = 0.010;
constexpr double kSameTurn = 0.9986;  // cosine of 3 degrees

HoleOptions for_graft(double roundness_m) {
  HoleOptions how;
  how.least_diameter_m = 0.004;
  how.largest_diameter_m = 0.014;
  how.roundness_m = roundness_m;
  return how;
}

// Whether most of a hole's axis runs in what was bone.
bool is_new(const Hole& hole, const MeshDistance& before) {
  constexpr int kPlaces = 9;
  int inside = 0;
  for (int i = 1; i <= kPlaces; ++i) {
    const Vec3 p = hole.entry + i / (kPlaces + 1.0) * (hole.exit - hole.entry);
    if (before.closest(p).signed_distance < 0) ++inside;
  }
  return 2 * inside > kPlaces;
}

double volume_of(const Hole& hole) { return hole.diameter_m * hole.diameter_m * hole.length_m; }

bool opens(const MeshDistance& whole, const Vec3& rim_B, const Vec3& out_B,
           double reach_m = kOpens_m) {
  constexpr int kPlaces = 6;
  for (int i = 1; i <= kPlaces; ++i)
    if (whole.closest(rim_B + i * reach_m / kPlaces * out_B).signed_distance > 0) return true;
  return false;
}

// Whether a narrower hole goes on from the bottom of a wide one to the far side: its end lies whole
// within that bottom. A reamer that was pushed aside stands a little beside its channel.
bool goes_on(const Hole& wide, const Hole& other, const MeshDistance& whole) {
  if (!(other.diameter_m < 0.9 * wide.diameter_m)) return false;
  const double along = wide.axis.dot(other.axis);
  const Vec3 near =
      (other.entry - wide.entry).squaredNorm() < (other.exit - wide.entry).squaredNorm()
          ? other.entry
          : other.exit;
  const Vec3 off = near - wide.entry;
  const double aside_m = (off - off.dot(wide.axis) * wide.axis).norm();
  const bool same =
      std::abs(along) > kSameTurn && aside_m < 0.5 * (wide.diameter_m - other.diameter_m);
  return same && (opens(whole, other.exit, other.axis) || opens(whole, other.entry, -other.axis));
}

}  // namespace

std::optional<DrilledHole> find_drilled(const CarvedField& field, const MeshDistance& whole,
                                        const MeshDistance& before, double roundness_m) {
  CarvedSurface surface(field);
  surface.update(field);
  std::vector<Hole> holes = find_holes(surface.joined(), for_graft(roundness_m));
  std::erase_if(holes, [&](const Hole& hole) { return !is_new(hole, before); });
  const Hole* best = nullptr;
  for (const Hole& hole : holes)
    if (!best || volume_of(hole) > volume_of(*best)) best = &hole;
  if (!best) return std::nullopt;
  DrilledHole out;
  const double reach_m = best->through ? kOpensFlat_m : kOpens_m;
  const bool front = opens(whole, best->entry, -best->axis, reach_m);
  const bool back = opens(whole, best->exit, best->axis, reach_m);
  out.line = {best->entry - (front ? kLedOn_m : 0) * best->axis,
              best->exit + (back ? kLedOn_m : 0) * best->axis, best->diameter_m, front && back};
  out.length_m = best->length_m;
  out.through = front && back;
  for (const Hole& hole : holes)
    if (&hole != best && goes_on(*best, hole, whole)) out.channel_m = hole.diameter_m;
  return out;
}

std::vector<DrilledLine> holes_of(const TriMesh& bone, double roundness_m) {
  std::vector<Hole> holes = find_holes(bone, for_graft(roundness_m));
  std::stable_sort(holes.begin(), holes.end(),
                   [](const Hole& a, const Hole& b) { return volume_of(a) > volume_of(b); });
  std::vector<DrilledLine> lines;
  for (const Hole& hole : holes)
    lines.push_back({hole.entry, hole.exit, hole.diameter_m, hole.through});
  return lines;
}

}  // namespace osteon
