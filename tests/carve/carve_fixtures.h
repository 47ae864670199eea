#pragma once

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "osteon/base/random.h"
#include "osteon/base/turn.h"
#include "osteon/carve/carved_field.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon::test {

/// A box about the origin, outward.
inline TriMesh box_mesh(const Vec3& half) {
  TriMesh mesh;
  for (int c = 0; c < 8; ++c)
    mesh.vertices.emplace_back((c & 1) ? half.x() : -half.x(), (c & 2) ? half.y() : -half.y(),
                               (c & 4) ? half.z() : -half.z());
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

template <class T>
T value(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message());
  return std::move(*result);
}

inline std::shared_ptr<const UncutField> block_field(double half_m, double cell_m = 0.00025) {
  UncutFieldOptions options;
  options.cell_m = cell_m;
  return value(UncutField::make(box_mesh(Vec3::Constant(half_m)), options));
}

inline Cutter cutter(const std::string& name, double size_mm) {
  return value(make_cutter(name, 1e-3 * size_mm));
}

/// Tool at p with its shaft along `up`.
inline Pose pose_along(const Vec3& p, const Vec3& up) {
  Pose X;
  X.p = p;
  X.q = turn_between(Vec3::UnitZ(), up);
  return X;
}

}  // namespace osteon::test
