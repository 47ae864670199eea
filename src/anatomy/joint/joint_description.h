#pragma once

#include <optional>
#include <string>
#include <vector>

#include "soft/soft_description.h"

namespace osteon {

/// A bone that a rolling joint draws along a groove of its fixed bone by a tendon: the patella.
struct GlidingBone {
  std::size_t bone = 0;
  std::size_t cartilage = 0;     ///< soft part: the layer that glides
  std::size_t tendon = 0;        ///< soft part: a band of constant length from it to a moved bone
  std::vector<double> turn_deg;  ///< how far it has turned about World y, one a step
};

/// Two condyles of a fixed bone on two plateaus of a moved one, which rolls, glides and turns as it
/// bends: about World y, its x towards -z. What is said here is where the condyles go over the
/// plateaus and how far the moved bone turns about its long axis (World x at rest); how high they
/// stand is found from the grown surfaces (roll_glide.h). Row k of a list is at k steps.
struct RollingJoint {
  std::string name;
  std::size_t fixed = 0;
  std::vector<std::size_t> moves;  ///< rigidly together; the first has the plateaus
  double step_deg = 10;
  BoundPoint medial, lateral;  ///< centres of the condyles where they bear when bent; of `fixed`
  std::size_t medial_plateau = 0, lateral_plateau = 0;  ///< soft parts: layers
  std::vector<double> inward_deg;  ///< turn of the moved bones' front towards medial
  std::vector<double> back;        ///< metres: way of the medial centre to the back of the plateau
  std::optional<GlidingBone> glides;
  double at_deg = 0;  ///< how far it is bent
};

}  // namespace osteon
