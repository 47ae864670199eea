#include "osteon/scene/rings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace osteon {
namespace {

constexpr double kNoGround_m = -10;
constexpr int kEdgePoints = 24;

bool is_numbered(std::string_view name, std::string_view prefix) {
  if (!name.starts_with(prefix) || name.size() == prefix.size()) return false;
  const std::string_view rest = name.substr(prefix.size());
  return std::all_of(rest.begin(), rest.end(), [](char c) { return c >= '0' && c <= '9'; });
}
bool is_ring(const Bone& bone) { return is_numbered(bone.name, "ring_"); }
bool is_peg(const Bone& bone) { return is_numbered(bone.name, "peg_"); }

RingShape ring_of(const Bone& bone, std::uint32_t index) {
  RingShape ring;
  ring.bone = index;
  Aabb box;
  for (const Vec3& v : bone.mesh.vertices) box.include(v);
  if (box.empty()) return ring;
  ring.center_B = box.center();
  double inner = std::numeric_limits<double>::infinity(), outer = 0;
  for (const Vec3& v : bone.mesh.vertices) {
    const double out = std::hypot(v.x() - ring.center_B.x(), v.y() - ring.center_B.y());
    inner = std::min(inner, out);
    outer = std::max(outer, out);
  }
  ring.middle_m = 0.5 * (inner + outer);
  ring.thick_m = box.extent().z();
  return ring;
}

RingPeg peg_of(const Bone& bone) {
  Aabb box;
  for (const Vec3& v : bone.mesh.vertices) box.include(bone.X_WB * v);
  if (box.empty()) return {};
  const Vec3 middle = box.center();
  return {{middle.x(), middle.y(), box.hi.z()},
          0.25 * (box.extent().x() + box.extent().y()),
          box.lo.z()};
}

bool has_peg(const Case& the_case) {
  return std::any_of(the_case.bones.begin(), the_case.bones.end(), is_peg);
}

// Where the vertical line through (x, y) comes out of the piece at its top; none: it misses it. The
// line is clipped by the hull's planes (Cyrus and Beck 1978).
std::optional<double> top_at(const RingSet::Ground& ground, double x, double y) {
  const Aabb& box = ground.box_W;
  if (x < box.lo.x() || x > box.hi.x() || y < box.lo.y() || y > box.hi.y()) return std::nullopt;
  const Vec3 from = ground.X_BW * Vec3(x, y, box.lo.z() - 0.001);
  const Vec3 to = ground.X_BW * Vec3(x, y, box.hi.z() + 0.001);
  double enter = 0, leave = 1;
  for (const Plane& plane : ground.piece->planes) {
    const double a = plane.signed_distance(from), b = plane.signed_distance(to);
    if (a >= 0 && b >= 0) return std::nullopt;
    if (a > 0) enter = std::max(enter, a / (a - b));
    if (b > 0) leave = std::min(leave, a / (a - b));
    if (enter >= leave) return std::nullopt;
  }
  return box.lo.z() - 0.001 + leave * (box.extent().z() + 0.002);
}

}  // namespace

RingSet find_rings(const Case& the_case) {
  RingSet set;
  if (!has_peg(the_case)) return set;
  for (std::uint32_t i = 0; i < the_case.bones.size(); ++i) {
    const Bone& bone = the_case.bones[i];
    if (is_loose_ring(the_case, i)) {
      set.rings.push_back(ring_of(bone, i));
    } else if (is_peg(bone)) {
      set.pegs.push_back(peg_of(bone));
    } else if (!is_ring(bone)) {
      for (const Hull& piece : bone.pieces) {
        RingSet::Ground ground{&piece, bone.X_WB.inverse(), {}};
        for (const Vec3& v : piece.vertices) ground.box_W.include(bone.X_WB * v);
        set.grounds.push_back(ground);
      }
    }
  }
  if (set.rings.empty()) return {};
  return set;
}

bool is_loose_ring(const Case& the_case, std::uint32_t bone) {
  if (bone >= the_case.bones.size() || !is_ring(the_case.bones[bone]) || !has_peg(the_case))
    return false;
  std::size_t before = 0;
  for (std::uint32_t i = 0; i < bone; ++i) before += is_ring(the_case.bones[i]) ? 1 : 0;
  return before < kMaxRings;
}

const RingPeg* peg_in_ring(const RingSet& set, const RingShape& ring, const Vec3& center_W) {
  for (const RingPeg& peg : set.pegs) {
    const double off = std::hypot(center_W.x() - peg.top_W.x(), center_W.y() - peg.top_W.y());
    if (off < ring.middle_m && center_W.z() < peg.top_W.z() && center_W.z() > peg.low_z_m)
      return &peg;
  }
  return nullptr;
}

double rest_height_m(const RingSet& set, std::size_t which, const Vec3& center_W,
                     std::span<const Vec3> centers_W) {
  const RingShape& ring = set.rings[which];
  const double half = 0.5 * ring.thick_m, inner = ring.middle_m - half;
  // What is higher than this is beside the ring and not under it.
  const double highest = center_W.z() + ring.thick_m;
  double lies = kNoGround_m;
  for (int k = 0; k < kEdgePoints; ++k) {
    const double a = 2 * std::numbers::pi * k / kEdgePoints;
    for (const double radius : {inner, ring.middle_m})
      for (const RingSet::Ground& ground : set.grounds) {
        const auto top = top_at(ground, center_W.x() + radius * std::cos(a),
                                center_W.y() + radius * std::sin(a));
        if (top && *top <= highest) lies = std::max(lies, *top + half);
      }
  }
  for (std::size_t i = 0; i < std::min(set.rings.size(), centers_W.size()); ++i) {
    const Vec3& other = centers_W[i];
    const double apart = std::hypot(other.x() - center_W.x(), other.y() - center_W.y());
    if (i == which || other.z() > center_W.z() || apart > 2 * ring.middle_m + ring.thick_m)
      continue;
    if (other.z() + half <= highest)
      lies = std::max(lies, other.z() + 0.5 * (ring.thick_m + set.rings[i].thick_m));
  }
  return lies;
}

}  // namespace osteon
