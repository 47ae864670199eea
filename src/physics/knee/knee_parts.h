#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "osteon/base/pose_track.h"
#include "osteon/base/result.h"
#include "osteon/mesh/distance.h"
#include "osteon/scene/build_case.h"

namespace osteon {

/// What a laxity test needs of a case, all as a right knee stretched out, in the femur's frame.
struct KneeParts {
  /// World at rest to here; of bones that move, to where they are when stretched.
  struct Bone {
    std::string_view name;
    Pose X_FW;
    std::shared_ptr<const MeshDistance> surface;
  };
  Bone femur, tibia;
  std::optional<Bone> fibula;
  /// Of the femur: its cartilage, closed, and what of both can be touched.
  std::shared_ptr<const MeshDistance> femoral_cartilage, femoral_surface;
  double femoral_thickness_m = 0;
  std::vector<TriMesh> plateaus;  ///< layers of cartilage on the tibia
  PoseTrack X_FT;
  Pose straight_BF;  ///< the femur's frame in the tibia's, stretched out, not mirrored
  bool left = false;
  double scale = 1;  ///< against a knee of the table's width

  Vec3 place(const Bone& bone, const Vec3& p_W) const;
};

/// The bones and the bending alone.
Result<KneeParts> find_knee_bones(const CaseDef& def);
/// With cartilage, and the scale against a width between the epicondyles.
Result<KneeParts> find_knee_parts(const CaseDef& def, double width_m);

}  // namespace osteon
