#pragma once

#include <vector>

#include "osteon/anatomy/name_bones.h"
#include "recognise/point_cloud.h"

namespace osteon {

/// Pairs of points that belong together.
struct Pairs {
  std::vector<Vec3> model_M, data_P;
};

/// Similarity of least squares that takes model points to data points (Umeyama 1991), its scale
/// kept within `scales`; the mirror of `fit` stays.
struct ScaleRange {
  double lo, hi;
};
ModelFit best_fit(const Pairs& pairs, ScaleRange scales, bool mirrored);

/// Principal axes as columns, longest first, right-handed.
Mat3 principal_axes(const std::vector<Vec3>& points);
Vec3 mean_of(const std::vector<Vec3>& points);

/// Rough and then fine alignment of the whole model; both hands and every turn are tried.
ModelFit align_model(const std::vector<Vec3>& model_M, const std::vector<Vec3>& data_P);

/// Moves one bone of the model, rigidly and by little, onto the data.
ModelFit align_bone(const ModelFit& start, const std::vector<Vec3>& bone_M, const PointCloud& data,
                    const std::vector<Vec3>& data_P);

}  // namespace osteon
