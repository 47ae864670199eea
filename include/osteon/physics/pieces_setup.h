#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/collide/primitive.h"
#include "osteon/physics/soft_gripper.h"
#include "osteon/scene/case.h"

namespace osteon {

/// What an instrument does to loose pieces of bone: its parts push them, its jaws hold them, its
/// bore draws them in.
struct PieceTool {
  std::vector<Primitive> parts;  ///< in Tool
  std::optional<SoftGripper> jaws;
  double bore_m = 0;           ///< diameter; 0: it does not suck
  Vec3 bore_T = Vec3::Zero();  ///< its middle, at the front of what is felt of the instrument
};

/// A bone as pieces of another one meet it, where it is not carved.
struct PieceObstacle {
  struct Part {
    Aabb box_B;
    std::vector<Plane> planes_B;  ///< convex
  };
  Aabb box_B;
  std::vector<Part> parts;
};

/// All that is made before pieces can fall. Immutable.
struct PiecesSetup {
  std::vector<PieceTool> tray;
  std::vector<PieceObstacle> bones;  ///< of the case
  Aabb box_W;                        ///< of all bones at rest, with what lies beside the patient
  /// About the bones of a patient (those with a number of the Foundational Model of Anatomy) with
  /// what covers them; empty: the case has none. Most sessions know no skin.
  Aabb limb_W;
};

/// Of an instrument's name in a tray ("grasper:2.7"). Fails where the instruments cannot be read or
/// have not that size.
Result<PiecesSetup> make_pieces(const Case& the_case, std::span<const std::string> tray);

}  // namespace osteon
