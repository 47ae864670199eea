#pragma once

#include <vector>

#include "osteon/mesh/distance.h"
#include "osteon/tissue/held_joint.h"

namespace osteon {

struct CartilageLaw {
  double young_pa = 0, poisson = 0;
  double other_m = 0;  ///< thickness of the layer that it meets
};

/// Springs under a layer of cartilage on a bone: one to a fine triangle of its free surface
/// and four to a larger one. A layer of
/// thickness h between bones is stiff by E (1 - nu) / ((1 + nu) (1 - 2 nu) h) for each area
/// (elastic foundation; Blankevoort and others 1991, J Biomech 24:1019).
std::vector<JointBed> lay_beds(const TriMesh& layer, const MeshDistance& bone,
                               const CartilageLaw& law);

/// The same on the spines between the plateaus, up whose slopes cartilage runs that has no layer of
/// its own in a case: it is reckoned as thick as the layer that it meets.
std::vector<JointBed> lay_spine_beds(const MeshDistance& tibia, const MeshDistance& femur,
                                     const std::vector<TriMesh>& plateaus, double scale,
                                     const CartilageLaw& law);

}  // namespace osteon
