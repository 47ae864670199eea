#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "osteon/base/types.h"

namespace osteon {

/// Where the voxels of a grid lie in Patient (DICOM LPS: x to the left hand, y to the back, z to
/// the head), metres. `axes_P` is a rotation: its columns are the directions of i, j and k.
struct GridFrame {
  std::array<int, 3> size = {0, 0, 0};
  Vec3 spacing_m = Vec3::Constant(0.001);
  Vec3 origin_P = Vec3::Zero();  ///< centre of voxel (0, 0, 0)
  Mat3 axes_P = Mat3::Identity();

  std::size_t count() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
  /// Place of voxel (i, j, k) in memory: i runs fastest.
  std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size[1]) +
            static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(size[0]) +
           static_cast<std::size_t>(i);
  }
  bool contains(int i, int j, int k) const {
    return i >= 0 && j >= 0 && k >= 0 && i < size[0] && j < size[1] && k < size[2];
  }
  Vec3 point_P(const Vec3& ijk) const { return origin_P + axes_P * spacing_m.cwiseProduct(ijk); }
  /// Continuous voxel coordinates of a point; whole numbers are voxel centres.
  Vec3 voxel(const Vec3& p_P) const {
    return (axes_P.transpose() * (p_P - origin_P)).cwiseQuotient(spacing_m);
  }
  double voxel_volume_m3() const { return spacing_m.prod(); }
};

/// Values on a grid; `values.size() == frame.count()`.
template <class T>
struct Grid {
  GridFrame frame;
  std::vector<T> values;

  T& at(int i, int j, int k) { return values[frame.index(i, j, k)]; }
  T at(int i, int j, int k) const { return values[frame.index(i, j, k)]; }
};

using Volume = Grid<std::int16_t>;        ///< Hounsfield units
using LabelVolume = Grid<std::uint16_t>;  ///< 0: nothing
using Mask = Grid<std::uint8_t>;          ///< 0 or 1

/// A block of voxels: lo <= n < hi.
struct VoxelBox {
  std::array<int, 3> lo = {0, 0, 0};
  std::array<int, 3> hi = {0, 0, 0};
  bool empty() const { return hi[0] <= lo[0] || hi[1] <= lo[1] || hi[2] <= lo[2]; }
};

/// `box` with `margin` voxels more on each side, cut to the grid.
VoxelBox grown(const VoxelBox& box, int margin, const GridFrame& frame);
/// Frame of the voxels of `box` alone.
GridFrame cropped(const GridFrame& frame, const VoxelBox& box);

template <class T>
Grid<T> crop(const Grid<T>& grid, const VoxelBox& box) {
  Grid<T> out;
  out.frame = cropped(grid.frame, box);
  out.values.reserve(out.frame.count());
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j) {
      const auto row =
          grid.values.begin() + static_cast<std::ptrdiff_t>(grid.frame.index(box.lo[0], j, k));
      out.values.insert(out.values.end(), row, row + (box.hi[0] - box.lo[0]));
    }
  return out;
}

/// Value between voxel centres by trilinear interpolation; beyond the grid that of its rim.
template <class T>
double sample_linear(const Grid<T>& grid, const Vec3& ijk) {
  int lo[3], hi[3];
  double t[3];
  for (int a = 0; a < 3; ++a) {
    const int last = grid.frame.size[static_cast<std::size_t>(a)] - 1;
    const double x = ijk[a] < 0 ? 0 : ijk[a] > last ? last : ijk[a];
    lo[a] = static_cast<int>(x);
    hi[a] = lo[a] < last ? lo[a] + 1 : last;
    t[a] = x - lo[a];
  }
  const auto along_i = [&](int j, int k) {
    const double a = static_cast<double>(grid.at(lo[0], j, k));
    return a + t[0] * (static_cast<double>(grid.at(hi[0], j, k)) - a);
  };
  const auto along_j = [&](int k) {
    const double a = along_i(lo[1], k);
    return a + t[1] * (along_i(hi[1], k) - a);
  };
  const double a = along_j(lo[2]);
  return a + t[2] * (along_j(hi[2]) - a);
}

}  // namespace osteon
