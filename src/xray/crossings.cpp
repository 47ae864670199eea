#include "crossings.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace osteon {
namespace {

/// Nothing nearer to the source's plane is projected: there pixels run to infinity.
constexpr double kNear_m = 0.01;
/// No point of a picture's triangles lies farther out: products of two such differences fit.
constexpr double kFarthest_px = 131072;

std::int64_t rounded(double pixels) {
  return std::llround(std::clamp(pixels, -kFarthest_px, kFarthest_px) * kSubpixels);
}

std::int64_t twice_area(const DetectorPoint& a, const DetectorPoint& b, const DetectorPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The last pixel whose middle is not beyond x.
std::int64_t pixel_below(std::int64_t x) { return x >> kSubpixelBits; }
/// The first that is not before it.
std::int64_t pixel_above(std::int64_t x) { return -pixel_below(-x); }

/// Twice the area of (a, b, pixel), less one where the edge itself belongs to the triangle beyond:
/// a pixel is inside when none of the three is negative.
struct Edge {
  std::int64_t dx, dy, at_origin;
  Edge(const DetectorPoint& a, const DetectorPoint& b)
      : dx(b.x - a.x), dy(b.y - a.y), at_origin(-dx * a.y + dy * a.x) {
    if (!(dy < 0 || (dy == 0 && dx > 0))) at_origin -= 1;
  }
  std::int64_t at(std::int64_t x, std::int64_t y) const { return dx * y - dy * x + at_origin; }
};

/// 1 / share is linear over the picture of a plane; never beyond the corners' values.
struct InverseShare {
  double q0, gx, gy, lo, hi;
  std::int64_t x0, y0;
  explicit InverseShare(const DetectorTriangle& t) : q0(t[0].q), x0(t[0].x), y0(t[0].y) {
    const auto x1 = static_cast<double>(t[1].x - x0), y1 = static_cast<double>(t[1].y - y0);
    const auto x2 = static_cast<double>(t[2].x - x0), y2 = static_cast<double>(t[2].y - y0);
    const double q1 = t[1].q - q0, q2 = t[2].q - q0, area = x1 * y2 - x2 * y1;
    gx = (q1 * y2 - q2 * y1) / area;
    gy = (q2 * x1 - q1 * x2) / area;
    lo = std::min({t[0].q, t[1].q, t[2].q});
    hi = std::max({t[0].q, t[1].q, t[2].q});
  }
  double at(std::int64_t x, std::int64_t y) const {
    const double q = q0 + gx * static_cast<double>(x - x0) + gy * static_cast<double>(y - y0);
    return std::clamp(q, lo, hi);
  }
};

struct PixelBox {
  int x0, x1, y0, y1;  ///< all inclusive; x1 < x0 or y1 < y0: empty
};

PixelBox pixels_of(const DetectorTriangle& t, const RowBand& band) {
  const auto [x_lo, x_hi] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [y_lo, y_hi] = std::minmax({t[0].y, t[1].y, t[2].y});
  PixelBox box;
  box.x0 = static_cast<int>(std::max<std::int64_t>(0, pixel_above(x_lo)));
  box.x1 = static_cast<int>(std::min<std::int64_t>(band.width - 1, pixel_below(x_hi)));
  box.y0 = static_cast<int>(std::max<std::int64_t>(band.first, pixel_above(y_lo)));
  box.y1 = static_cast<int>(std::min<std::int64_t>(band.last - 1, pixel_below(y_hi)));
  return box;
}

/// Cuts a triangle off at the near plane: the corners of what is left, none to four. Both triangles
/// of an edge get the same point on it: it is reckoned from the same end.
int cut_near(const std::array<Vec3, 3>& in, std::array<Vec3, 4>& out) {
  int count = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &a = in[k], &b = in[(k + 1) % 3];
    const bool a_in = a.z() >= kNear_m, b_in = b.z() >= kNear_m;
    if (a_in) out[static_cast<std::size_t>(count++)] = a;
    if (a_in == b_in) continue;
    const Vec3 &from = a_in ? a : b, &to = a_in ? b : a;
    Vec3 p = from + (kNear_m - from.z()) / (to.z() - from.z()) * (to - from);
    p.z() = kNear_m;
    out[static_cast<std::size_t>(count++)] = p;
  }
  return count;
}

bool reaches(const DetectorTriangle& t, const XrayView& view) {
  const PixelBox box = pixels_of(t, {0, view.height, view.width});
  return box.x0 <= box.x1 && box.y0 <= box.y1 && twice_area(t[0], t[1], t[2]) != 0;
}

class Bander {
 public:
  Bander(const XrayView& view, int rows_a_band) : view_(view), rows_(rows_a_band) {
    out_.of_band.resize(static_cast<std::size_t>((view.height + rows_ - 1) / rows_));
  }
  void add(const DetectorTriangle& t) {
    if (!reaches(t, view_)) return;
    const PixelBox box = pixels_of(t, {0, view_.height, view_.width});
    const auto index = static_cast<std::uint32_t>(out_.triangles.size());
    out_.triangles.push_back(t);
    for (int band = box.y0 / rows_; band <= box.y1 / rows_; ++band)
      out_.of_band[static_cast<std::size_t>(band)].push_back(index);
  }
  BandedTriangles take() { return std::move(out_); }

 private:
  const XrayView& view_;
  int rows_;
  BandedTriangles out_;
};

}  // namespace

DetectorFrame::DetectorFrame(const XrayView& view)
    : source_W_(view.source_W), u_W_(view.u_W), v_W_(view.v_W), n_W_(view.normal_W()) {
  const Vec3 middle = view.detector_center_W - view.source_W;
  distance_ = middle.dot(n_W_);
  u0_ = middle.dot(u_W_);
  v0_ = middle.dot(v_W_);
  per_pixel_ = 1 / view.pixel_m;
  x0_ = 0.5 * (view.width - 1);
  y0_ = 0.5 * (view.height - 1);
}

Vec3 DetectorFrame::from_source(const Vec3& p_W) const {
  const Vec3 d = p_W - source_W_;
  return {d.dot(u_W_), d.dot(v_W_), d.dot(n_W_)};
}

DetectorPoint DetectorFrame::on_detector(const Vec3& p_D) const {
  const double q = distance_ / p_D.z();
  return {rounded((p_D.x() * q - u0_) * per_pixel_ + x0_),
          rounded((p_D.y() * q - v0_) * per_pixel_ + y0_), q};
}

/// A pixel belongs to a triangle when its middle lies inside, or on an edge that by its direction
/// belongs to this one of the two triangles there (the top-left rule). Corners are whole numbers
/// and so are the tests, so of a closed surface every ray crosses exactly as many triangles on the
/// way in as on the way out: at a silhouette's edge both triangles decide alike. v runs down the
/// picture, so a triangle that faces the source has a negative area there.
void add_crossings(const DetectorTriangle& t, int layer, const RowBand& band,
                   std::vector<PixelCrossing>& out) {
  const std::int64_t area = twice_area(t[0], t[1], t[2]);
  if (area == 0) return;
  const DetectorPoint &a = t[0], &b = area > 0 ? t[1] : t[2], &c = area > 0 ? t[2] : t[1];
  const Edge edges[3] = {{a, b}, {b, c}, {c, a}};
  const InverseShare inverse(t);
  const PixelBox box = pixels_of(t, band);
  for (int row = box.y0; row <= box.y1; ++row) {
    const std::int64_t y = row * kSubpixels;
    for (int column = box.x0; column <= box.x1; ++column) {
      const std::int64_t x = column * kSubpixels;
      if ((edges[0].at(x, y) | edges[1].at(x, y) | edges[2].at(x, y)) < 0) continue;
      const auto pixel = static_cast<std::uint32_t>((row - band.first) * band.width + column);
      out.push_back({pixel,
                     {static_cast<float>(1 / inverse.at(x, y)), static_cast<std::int16_t>(layer),
                      static_cast<std::int16_t>(area < 0 ? 1 : -1)}});
    }
  }
}

BandedTriangles banded_triangles(const TriMesh& mesh_M, const Pose& X_WM, const XrayView& view,
                                 int rows_a_band) {
  const DetectorFrame frame(view);
  std::vector<Vec3> corners_D(mesh_M.vertices.size());
  std::vector<DetectorPoint> points(mesh_M.vertices.size());
  for (std::size_t n = 0; n < points.size(); ++n) {
    corners_D[n] = frame.from_source(X_WM * mesh_M.vertices[n]);
    points[n] = corners_D[n].z() >= kNear_m ? frame.on_detector(corners_D[n]) : DetectorPoint{};
  }
  Bander bander(view, rows_a_band);
  for (const Triangle& t : mesh_M.triangles) {
    const bool all_in_front = corners_D[t[0]].z() >= kNear_m && corners_D[t[1]].z() >= kNear_m &&
                              corners_D[t[2]].z() >= kNear_m;
    if (all_in_front) {
      bander.add({points[t[0]], points[t[1]], points[t[2]]});
      continue;
    }
    std::array<Vec3, 4> cut;
    const int count = cut_near({corners_D[t[0]], corners_D[t[1]], corners_D[t[2]]}, cut);
    for (int k = 2; k < count; ++k)
      bander.add({frame.on_detector(cut[0]),
                  frame.on_detector(cut[static_cast<std::size_t>(k) - 1]),
                  frame.on_detector(cut[static_cast<std::size_t>(k)])});
  }
  return bander.take();
}

}  // namespace osteon
