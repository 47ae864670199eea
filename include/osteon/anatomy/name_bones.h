#pragma once

#include <span>
#include <string>
#include <vector>

#include "osteon/base/types.h"

namespace osteon {

/// A bone of the anatomy that names are taken from: points of its surface, in Model.
struct ModelBone {
  std::string name;
  std::vector<Vec3> points_M;
};

/// Where the model lies in the scan: p_P = X_PM * (scale * mirror * p_M), mirror = diag(1, -1, 1)
/// where `mirrored`.
struct ModelFit {
  Pose X_PM;
  double scale = 1;
  bool mirrored = false;
  double residual_m = 1e9;  ///< trimmed mean distance between both surfaces
  Vec3 to_patient(const Vec3& p_M) const {
    return X_PM * Vec3(scale * Vec3(p_M.x(), mirrored ? -p_M.y() : p_M.y(), p_M.z()));
  }
  Vec3 to_model(const Vec3& p_P) const {
    const Vec3 p = X_PM.inverse() * p_P / scale;
    return Vec3(p.x(), mirrored ? -p.y() : p.y(), p.z());
  }
};

/// A fit is taken as the anatomy itself only below this residual, m (D).
inline constexpr double kLargestFitResidual_m = 0.0035;

struct BoneNames {
  ModelFit fit;
  std::vector<ModelFit> fit_of_bone;  ///< each model bone fitted on its own, from `fit`
  /// Of each region: index of its bone, -1 where it is none of them. Regions that are pieces of one
  /// bone have the same.
  std::vector<int> bone_of_region;
  /// Of each region: the bones that it holds; several where bones have grown together in the scan.
  std::vector<std::vector<int>> bones_in_region;
  bool recognised() const { return fit.residual_m < kLargestFitResidual_m; }
};

/// Lays the model over the regions of a scan, of either hand and in any position: similarity from
/// principal axes, then iterated closest points (Besl and McKay 1992; Umeyama 1991, eq. 40-42),
/// each bone on its own at the end. Regions and bones are matched by how much of their surfaces lie
/// together (assignment of greatest sum).
BoneNames name_bones(std::span<const ModelBone> model,
                     const std::vector<std::vector<Vec3>>& regions_P);

/// Assignment of rows to columns with the least sum of costs (Kuhn 1955, in the form of Jonker and
/// Volgenant 1987); `cost[row][column]`, rows not more than columns. Returns the column of each
/// row.
std::vector<int> least_cost_assignment(const std::vector<std::vector<double>>& cost);

}  // namespace osteon
