#include "soft/soft_layer.h"

#include <algorithm>
#include <cmath>

#include "bone/nearby_surface.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/taubin.h"
#include "soft/soft_patch.h"
#include "soft/soft_rim.h"

namespace osteon {
namespace {

constexpr double kRim_m = 1e-4;    // the facets of a convex bone stay under it (D)
constexpr double kLeast_m = 5e-5;  // where bones nearly meet
constexpr int kRimRounds = 8;
constexpr double kBorder_m = 4e-4;       // half-width of the groove between two layers on a bone
constexpr double kLeastArea_m2 = 4e-6;   // smaller islands are no joint surface (D)
constexpr double kLeastFacing = 0.3;     // cosine between the normal and the way to the other bone
constexpr double kBare_m = 5e-5;         // beside a defect (D)
constexpr double kAtDefect_m = 1e-4;     // a rim so near to one is the defect's
constexpr double kFacingReach_m = 5e-3;  // metres inside a cosine of 1 more counts as

double rim_height(const LayerDescription& layer) {
  return std::min(layer.rim > 0 ? layer.rim : kRim_m, layer.thickness);
}

/// Rises from the rim in a round shoulder, so that no ledge stands there and the edge is still a
/// wedge that elements of good shape fill.
double shoulder(double share) { return share * (1 + share * (1 - share)); }

/// How far the nearest of `bones` lies, at most `limit`, and whether the normal points at it.
struct Facing {
  double distance = 0;
  double cosine = 1;
};

Facing nearest(const Vec3& p, const Vec3& normal, const std::vector<std::size_t>& bones,
               std::vector<NearbySurface>& surfaces, double limit) {
  Facing best{limit, 1};
  for (const std::size_t i : bones) {
    if (distance_to_box(p, surfaces[i].box()) >= best.distance) continue;
    const auto at = surfaces[i].nearer_than(best.distance, p);
    if (!at || at->signed_distance >= best.distance) continue;
    const Vec3 way = at->point - p;
    const double length = way.norm();
    best = {at->signed_distance, length > 1e-9 ? normal.dot(way) / length : 1.0};
  }
  return best;
}

std::vector<std::size_t> all_but(std::size_t self, std::size_t count) {
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < count; ++i)
    if (i != self) others.push_back(i);
  return others;
}

/// Takes the waves out of the rim that the facets of both bones leave in it.
void smooth_rim(const VertexRings& rings, CoveredPatch& patch) {
  for (int round = 0; round < kRimRounds; ++round) {
    std::vector<double> evened;
    for (std::size_t v = 0; v < patch.vertices.size(); ++v) {
      double sum = patch.vertices[v].inside;
      for (std::uint32_t k = rings.first[v]; k < rings.first[v + 1]; ++k)
        sum += patch.vertices[rings.neighbour[k]].inside;
      evened.push_back(sum / (1.0 + rings.first[v + 1] - rings.first[v]));
    }
    for (std::size_t v = 0; v < evened.size(); ++v) patch.vertices[v].inside = evened[v];
  }
}

class LayerMaker {
 public:
  LayerMaker(const LayerDescription& layer,
             const std::vector<const LayerDescription*>& on_same_bone, const GroundView& ground,
             const std::vector<BoundPart>& defects)
      : layer_(layer),
        ground_(ground),
        defects_(defects),
        others_(all_but(layer.bone, ground.size())) {
    for (const LayerDescription* other : on_same_bone)
      if (other != &layer)
        rivals_.insert(rivals_.end(), other->facing.begin(), other->facing.end());
    for (const BoundPart& part : layer.region) region_.parts.push_back(part.part);
    for (const SoftGround* bone : ground) surfaces_.emplace_back(bone->surface, bone->box);
  }

  TriMesh make() {
    const SoftGround& bone = *ground_[layer_.bone];
    CoveredPatch whole;
    whole.triangles = bone.surface.mesh().triangles;
    for (std::size_t i = 0; i < bone.normals.size(); ++i) {
      const Vec3& p = bone.surface.mesh().vertices[i];
      const double from_rim = std::clamp(inside(p, bone.normals[i]), -layer_.taper, layer_.taper);
      whole.vertices.push_back({p, bone.normals[i], from_rim, kLeast_m});
    }
    smooth_rim(vertex_rings(bone.surface.mesh()), whole);
    CoveredPatch patch = cut(whole);
    // The height is that without defects, so that one has a steep edge where the rim thins out.
    for (std::size_t v = 0; v < whole.vertices.size(); ++v)
      patch.vertices[v].inside = whole.vertices[v].inside;
    const auto at_defect = [&](const Vec3& p) { return outside_defects(p) < kAtDefect_m; };
    even_rim(bone.surface, whole, at_defect, patch);
    raise(patch);
    unfold(patch);
    return raise_patch(patch);
  }

 private:
  /// What is covered and no defect takes.
  CoveredPatch cut(CoveredPatch whole) const {
    for (CoveredVertex& v : whole.vertices) v.inside = std::min(v.inside, outside_defects(v.p));
    return cut_patch(whole, kLeastArea_m2);
  }

  void raise(CoveredPatch& patch) {
    std::vector<bool> wanted(patch.vertices.size(), false);
    for (const Triangle& t : patch.triangles)
      for (const std::uint32_t v : t) wanted[v] = true;
    for (std::size_t v = 0; v < wanted.size(); ++v)
      if (wanted[v]) patch.vertices[v].height = height(patch.vertices[v]);
  }

  /// Lowers the corners of triangles whose outer side would turn over. It ends: each round lowers a
  /// height by three tenths, and none goes below the least.
  static void unfold(CoveredPatch& patch) {
    constexpr double kLowered = 0.7;
    const auto outer = [&](std::uint32_t v) -> Vec3 {
      return patch.vertices[v].p + patch.vertices[v].height * patch.vertices[v].normal;
    };
    for (bool again = true; again;) {
      again = false;
      for (const Triangle& t : patch.triangles) {
        const Vec3& a = patch.vertices[t[0]].p;
        const Vec3 under = (patch.vertices[t[1]].p - a).cross(patch.vertices[t[2]].p - a);
        const Vec3 b = outer(t[0]);
        if ((outer(t[1]) - b).cross(outer(t[2]) - b).dot(under) > 0) continue;
        for (const std::uint32_t v : t) {
          double& height = patch.vertices[v].height;
          again = again || height > kLeast_m;
          height = std::max(kLowered * height, kLeast_m);
        }
      }
    }
  }

  /// Metres from the rim, negative outside.
  double inside(const Vec3& p, const Vec3& normal) {
    double inside = 1;
    if (!region_.parts.empty()) inside = -distance(region_, p);
    if (inside <= 0 || layer_.facing.empty()) return inside;
    const double limit = layer_.reach + layer_.taper;
    const Facing own = nearest(p, normal, layer_.facing, surfaces_, limit);
    inside = std::min(inside, layer_.reach - own.distance);
    inside = std::min(inside, (own.cosine - kLeastFacing) * kFacingReach_m);
    if (inside <= 0 || rivals_.empty()) return inside;
    const Facing rival = nearest(p, normal, rivals_, surfaces_, limit);
    return std::min(inside, 0.5 * (rival.distance - own.distance) * layer_.taper / kBorder_m);
  }

  double outside_defects(const Vec3& p) const {
    double outside = layer_.taper;
    for (const BoundPart& defect : defects_)
      outside = std::min(outside, distance(defect.part.primitive, p) - kBare_m);
    return outside;
  }

  double height(const CoveredVertex& v) {
    const double share = std::clamp(v.inside / layer_.taper, 0.0, 1.0);
    const double rim = rim_height(layer_);
    const double wanted = rim + (layer_.thickness - rim) * shoulder(share);
    const double reach = 2 * layer_.thickness + layer_.clearance;
    const double gap = nearest(v.p, v.normal, others_, surfaces_, reach).distance;
    const double room = 0.5 * (gap - layer_.clearance);
    return std::max(std::min(wanted, room), kLeast_m);
  }

  const LayerDescription& layer_;
  const GroundView& ground_;
  const std::vector<BoundPart>& defects_;
  std::vector<std::size_t> others_, rivals_;
  Solid region_;
  std::vector<NearbySurface> surfaces_;  ///< of the bones
};

/// Normals of a meshed surface waver from facet to facet; the layer over it should not.
void even_out(const TriMesh& mesh, std::vector<Vec3>& normals) {
  const VertexRings rings = vertex_rings(mesh);
  for (int round = 0; round < 2; ++round) {
    std::vector<Vec3> evened = normals;
    for (std::size_t v = 0; v < normals.size(); ++v) {
      for (std::uint32_t k = rings.first[v]; k < rings.first[v + 1]; ++k)
        evened[v] += normals[rings.neighbour[k]];
      const double length = evened[v].norm();
      evened[v] = length > 1e-9 ? Vec3(evened[v] / length) : normals[v];
    }
    normals = std::move(evened);
  }
}

}  // namespace

SoftGround make_ground(MeshDistance surface_W) {
  const TriMesh& mesh_W = surface_W.mesh();
  std::vector<Vec3> normals = vertex_normals(mesh_W);
  even_out(mesh_W, normals);
  const Aabb box = bounds(mesh_W);
  return {std::move(surface_W), std::move(normals), box};
}

TriMesh grow_layer(const LayerDescription& layer,
                   const std::vector<const LayerDescription*>& on_same_bone,
                   const GroundView& ground, const std::vector<BoundPart>& defects) {
  return LayerMaker(layer, on_same_bone, ground, defects).make();
}

}  // namespace osteon
