#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "osteon/image/volume.h"
#include "scan/scan_parts.h"

namespace osteon {

struct CellsPerVoxel {
  int in_slice, along;
};

/// Works out one slice after the other on cells finer than the voxels, which it averages. A block
/// of cells that no border crosses takes one distance query a part; at a border the distance is
/// queried every half millimetre and continued along its gradient.
class SlabScanner {
 public:
  /// `parts`: what is seen first comes first.
  SlabScanner(const ScanParts& parts, double air_hu, const GridFrame& frame, CellsPerVoxel cells);
  /// Writes the HU of slice k, without noise.
  void scan(int k, std::int16_t* slice);

 private:
  /// Cells i0 <= i < i1 and so on of the slice.
  struct Block {
    int i0, i1, j0, j1, k0, k1;
    bool single() const { return (i1 - i0) * (j1 - j0) * (k1 - k0) == 1; }
  };
  /// A part whose border may cross the block.
  struct Open {
    std::size_t part;
    NearSurface near;
  };

  void fill(const Block& block, std::size_t first, std::size_t last, double behind_hu);
  void halve(const Block& block, std::size_t first, std::size_t last, double behind_hu);
  void paint(const Block& block, std::size_t first, double behind_hu);
  double cell_mean(const Vec3& from_center, double width_m, bool closer, std::size_t first,
                   double behind_hu) const;
  double mean_of_parts(const Vec3& from_center, double width_m, std::size_t first,
                       double behind_hu) const;
  double cell_m(std::size_t first) const;
  void add(int i, int j, float hu);
  Vec3 cell_center(double i, double j, double k) const;

  const ScanParts& parts_;
  double air_hu_;
  GridFrame frame_;
  CellsPerVoxel cells_;
  Vec3 cell_size_m_;
  double cell_width_m_;
  int slice_ = 0;
  NearestSurfaces nearest_;
  std::vector<Open> open_;   ///< a stack: each block's after those of the block that holds it
  std::vector<float> sums_;  ///< of each voxel of the slice
};

}  // namespace osteon
