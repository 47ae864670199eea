#pragma once

#include <vector>

#include "osteon/mesh/distance.h"
#include "osteon/mesh/tri_mesh.h"
#include "soft/soft_description.h"

namespace osteon {

/// A finished bone as soft parts see it, in World.
struct SoftGround {
  MeshDistance surface;
  std::vector<Vec3> normals;  ///< of the vertices, evened out over their neighbours
  Aabb box;
};

/// All bones of an anatomy, in their order.
using GroundView = std::vector<const SoftGround*>;

SoftGround make_ground(MeshDistance surface_W);

/// Grows cartilage on the surface of ground[layer.bone]. No point of it lies nearer to another bone
/// than to its own by less than the clearance: its height over a vertex is at most half of what the
/// gap there has room for, so two layers that face each other never meet. Where several layers
/// cover one bone (`on_same_bone`, facing others), each keeps to the places that are nearest to its
/// own facing bones. The bone's triangles are cut along the rim, which is drawn into smooth curves.
/// What lies in a defect stays bare, up to a steep edge that follows it. Empty when nothing is
/// covered.
TriMesh grow_layer(const LayerDescription& layer,
                   const std::vector<const LayerDescription*>& on_same_bone,
                   const GroundView& ground, const std::vector<BoundPart>& defects = {});

}  // namespace osteon
