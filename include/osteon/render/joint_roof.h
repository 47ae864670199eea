#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/mesh/tri_mesh.h"
#include "osteon/scene/case.h"
#include "osteon/scene/state.h"

namespace osteon {

/// What closes a joint in any direction: bones, soft parts without skin and fat, which gives way,
/// and the joint's inner wall. Needs no OpenGL; its calls may be made on any thread, several at
/// once.
class JointRoof {
 public:
  /// Keeps what it needs of the case. There is no wall yet.
  explicit JointRoof(const Case& the_case);
  /// The same with this wall (see JointRoom); the parts are shared.
  JointRoof with_wall(const TriMesh& wall_W) const;

  /// How far it is from a place along a unit direction, as the bones stand; soft parts follow the
  /// mean motion of theirs. None: nothing is there within `most_m`, or the place lies in a part.
  std::optional<double> distance(const BoneSnapshot& bones, const Vec3& p_W, const Vec3& dir_W,
                                 double most_m) const;

 private:
  struct Surface;
  struct Parts;
  struct Wall;
  std::shared_ptr<const Parts> parts_;
  std::shared_ptr<const Wall> wall_;
};

}  // namespace osteon
