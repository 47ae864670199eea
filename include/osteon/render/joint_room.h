#pragma once

#include <memory>

#include "osteon/base/result.h"
#include "osteon/mesh/tri_mesh.h"
#include "osteon/scene/case.h"
#include "osteon/scene/state.h"

namespace osteon {

/// The room that a joint's inner wall leaves around a tip. Needs no OpenGL; its calls may be made
/// on any thread, several at once.
class JointRoom {
 public:
  /// Keeps what it needs of the bones: some tenths of a second for a knee.
  explicit JointRoom(const Case& the_case);
  ~JointRoom();
  JointRoom(JointRoom&&) noexcept;
  JointRoom& operator=(JointRoom&&) noexcept;

  /// The wall in World: within 60 mm of the tip, some 10 mm off the bones as they stand there, less
  /// where they are small, and farther where the tip is. Takes about a second. Fails when the tip
  /// lies in a bone, which it names, or at a place that is not finite. Empty in a box for exercises
  /// (a case "fast_..."), which is open.
  Result<TriMesh> wall(const BoneSnapshot& bones, const Vec3& tip_W) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace osteon
