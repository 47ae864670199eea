#pragma once

#include "osteon/image/volume.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Moves the vertices of a surface near bone, metres along the volume's axes from its voxel (0, 0,
/// 0), to where the grey value along the normal is half way from `soft_hu` to the brightest value
/// just inside. The moves are evened out over the surface; where the values do not tell, neighbours
/// do.
void snap_to_half_maximum(const Volume& volume, double soft_hu, TriMesh& mesh_V);

}  // namespace osteon
