#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "gl/gpu_mesh.h"
#include "osteon/base/types.h"
#include "surface/moved_light.h"

namespace osteon {

/// As tissue.frag knows them.
enum class TissuePattern : int {
  kBone,
  kCartilage,
  kMeniscus,
  kFibres,
  kSynovium,
  kFat,
  kSteel,
  kDisc
};

inline constexpr std::size_t kNoModel = std::numeric_limits<std::size_t>::max();

/// A surface with its pattern.
struct TissuePart {
  GpuMesh surface;
  /// Which it is: the bones of a case, after them the soft parts; else none.
  std::size_t model = kNoModel;
  Pose X_WM;
  bool faces_out = false;  ///< closed: its back faces are seen from within alone
  TissuePattern pattern = TissuePattern::kBone;
  std::array<float, 3> tint{0.89f, 0.84f, 0.73f};
  std::vector<std::size_t> rides_on;  ///< bones; of a soft part
  RestLight light;                    ///< of a soft part
  Vec3 middle = Vec3::Zero();         ///< at rest, of a soft part
  float fineness = 1;                 ///< of a ligament's fibres
  Eigen::Vector3f fibre = Eigen::Vector3f::UnitX(), center = Eigen::Vector3f::Zero();
  /// Of a disc: along its longest and its next axis, 1 / metres: its product with the way from the
  /// centre is 1 at the rim.
  Eigen::Vector3f to_end = Eigen::Vector3f::Zero(), to_side = Eigen::Vector3f::Zero();
};

}  // namespace osteon
