#pragma once

#include <string>

#include "osteon/carve/tunnel.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon::test {

/// Volume of `bone` less a cylinder between two points, by CGAL's corefinement with a
/// prism of 256 sides and the cylinder's volume; negative where CGAL gives up, m^3.
double cgal_volume_less_cylinder(const TriMesh& bone, const Vec3& from, const Vec3& to,
                                 double diameter_m);

/// Everything that must hold of a cut, checked by code of its own: closed, manifold, no crossings,
/// rims on the cylinder within 0.02 mm. Empty when all holds, else what does not.
std::string faults_of(const TriMesh& bone, const TunnelPlan& plan, const TunnelCut& cut);

}  // namespace osteon::test
