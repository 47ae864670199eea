#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "osteon/mesh/tri_mesh.h"
#include "osteon/xray/c_arm.h"

namespace osteon {

/// A vertex on the detector.
struct DetectorPoint {
  std::int64_t x, y;  ///< 1 / kSubpixels of a pixel, from the middle of pixel (0, 0)
  double q;           ///< 1 over the share of the way from source to detector, at the vertex
};
inline constexpr int kSubpixelBits = 12;
inline constexpr std::int64_t kSubpixels = 1 << kSubpixelBits;

/// Takes points of World to the detector.
class DetectorFrame {
 public:
  explicit DetectorFrame(const XrayView& view);
  /// Along the detector's u and v, and along its normal, m; the origin is the source.
  Vec3 from_source(const Vec3& p_W) const;
  /// Of such a point that lies in front of the source.
  DetectorPoint on_detector(const Vec3& p_D) const;
  double source_detector_m() const { return distance_; }

 private:
  Vec3 source_W_, u_W_, v_W_, n_W_;
  double distance_, u0_, v0_, per_pixel_, x0_, y0_;
};

using DetectorTriangle = std::array<DetectorPoint, 3>;

/// A ray enters or leaves a surface.
struct Crossing {
  float share;  ///< of the way from source to detector
  std::int16_t layer;
  std::int16_t enters;  ///< 1; leaves: -1
};
struct PixelCrossing {
  std::uint32_t pixel;  ///< from the first of the rows that are worked on
  Crossing crossing;
};

/// Rows first <= row < last of a picture.
struct RowBand {
  int first, last, width;
};

/// Adds the crossings of all rays of the band with the triangle.
void add_crossings(const DetectorTriangle& triangle, int layer, const RowBand& band,
                   std::vector<PixelCrossing>& out);

/// The triangles of a mesh that reach the picture, by the bands of rows that they reach.
struct BandedTriangles {
  std::vector<DetectorTriangle> triangles;
  std::vector<std::vector<std::uint32_t>> of_band;
};
BandedTriangles banded_triangles(const TriMesh& mesh_M, const Pose& X_WM, const XrayView& view,
                                 int rows_a_band);

}  // namespace osteon
