#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "osteon/collide/capsule_contact.h"
#include "osteon/collide/convex_body.h"
#include "osteon/collide/primitive.h"
#include "osteon/hull/hull.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// What an instrument does to soft parts and to the water in a joint.
struct ToolUse {
  bool cuts = false;     ///< with an edge, without power
  bool removes = false;  ///< bone or tissue, under power
  bool burns = false;    ///< seals with heat, under power
  bool sucks = false;    ///< under power
};

/// How a scope looks: the middle of its view leans from the shaft towards +y of Tool.
struct ToolOptics {
  double angle_rad = 0;
  double half_field_rad = 0.9;
};

/// Jaws are drawn in so many steps of their way.
inline constexpr std::size_t kJawSteps = 8;
/// The step nearest to an opening of 0 to 1; 0: shut.
inline std::size_t jaw_step(double opening) {
  if (!(opening > 0)) return 0;
  return opening < 1 ? static_cast<std::size_t>(kJawSteps * opening + 0.5) : kJawSteps;
}

/// A hand instrument. Tool frame: origin at the middle of the tip, the shaft along +z.
struct Tool {
  std::string name;
  std::vector<Hull> pieces;        ///< what touches, in Tool
  std::vector<ConvexBody> bodies;  ///< one a piece
  /// What touches a bone that is felt as a distance field, in Tool; none: the ball about each body.
  std::vector<Capsule> rods;
  /// The whole instrument as balls, rods and boxes, in Tool. Where there are any, they are what
  /// touches everything, and there are no pieces, bodies and rods.
  std::vector<Primitive> parts;
  /// What passes through a portal, in Tool; no length: nothing does.
  Capsule shaft;
  TriMesh mesh;  ///< what is drawn, in Tool
  /// The same with jaws that are open: by n / kJawSteps of their way, n = 1 to kJawSteps. None: it
  /// has no jaws.
  std::vector<TriMesh> opened;
  double tip_radius_m = 0.00075;
  ToolUse use;
  std::optional<ToolOptics> optics;  ///< of a scope
};

/// Arthroscopic hook probe of the wrist: a ball-shaped tip (32 corners) on a shaft. Only the tip is
/// felt, as in the wrist simulator's paper; on a distance field it is a true ball.
Tool make_wrist_probe(double tip_radius_m = 0.00075);

}  // namespace osteon
