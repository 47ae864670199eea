#include "segment/slice_plane.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

double spacing(const GridFrame& frame, int axis) { return frame.spacing_m[axis]; }

double extent_m(const GridFrame& frame, int axis) {
  return spacing(frame, axis) * frame.size[static_cast<std::size_t>(axis)];
}

/// Voxel axis for each axis of Patient: the assignment that lies nearest in sum.
std::array<int, 3> axes_of_patient(const GridFrame& frame) {
  constexpr std::array<std::array<int, 3>, 6> kOrders = {
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  std::array<int, 3> best = kOrders[0];
  double most = -1;
  for (const auto& order : kOrders) {
    double sum = 0;
    for (int p = 0; p < 3; ++p)
      sum += std::abs(frame.axes_P(p, order[static_cast<std::size_t>(p)]));
    if (sum > most + 1e-9) {
      most = sum;
      best = order;
    }
  }
  return best;
}

}  // namespace

const char* name_of(SliceView view) {
  switch (view) {
    case SliceView::kAxial:
      return "Axial";
    case SliceView::kCoronal:
      return "Coronal";
    case SliceView::kSagittal:
      break;
  }
  return "Sagittal";
}

std::array<SlicePlane, 3> slice_planes(const GridFrame& frame) {
  const std::array<int, 3> axis = axes_of_patient(frame);
  // Patient runs to the left, the back and the head; the screen shows the head above.
  const auto sign = [&](int patient, int wanted) {
    const int voxel = axis[static_cast<std::size_t>(patient)];
    return frame.axes_P(patient, voxel) * wanted < 0 ? -1 : 1;
  };
  SlicePlane axial{SliceView::kAxial, axis[2], axis[0], axis[1], sign(0, 1),
                   sign(1, 1),        'R',     'L',     'A',     'P'};
  SlicePlane coronal{SliceView::kCoronal, axis[1], axis[0], axis[2], sign(0, 1),
                     sign(2, -1),         'R',     'L',     'S',     'I'};
  SlicePlane sagittal{SliceView::kSagittal, axis[0], axis[1], axis[2], sign(1, 1),
                      sign(2, -1),          'A',     'P',     'S',     'I'};
  return {axial, coronal, sagittal};
}

SliceWindow whole_slice(const SlicePlane& plane, const GridFrame& frame, int width, int height) {
  SliceWindow window;
  window.width = std::max(1, width);
  window.height = std::max(1, height);
  window.middle_right = 0.5 * (frame.size[static_cast<std::size_t>(plane.right)] - 1);
  window.middle_down = 0.5 * (frame.size[static_cast<std::size_t>(plane.down)] - 1);
  window.m_per_px = std::max(extent_m(frame, plane.right) / window.width,
                             extent_m(frame, plane.down) / window.height);
  return window;
}

Vec3 voxel_at(const SlicePlane& plane, const GridFrame& frame, const SliceWindow& window, double x,
              double y, int slice) {
  Vec3 voxel;
  voxel[plane.normal] = slice;
  voxel[plane.right] = window.middle_right + plane.right_sign * (x - 0.5 * window.width) *
                                                 window.m_per_px / spacing(frame, plane.right);
  voxel[plane.down] = window.middle_down + plane.down_sign * (y - 0.5 * window.height) *
                                               window.m_per_px / spacing(frame, plane.down);
  return voxel;
}

PanePoint pane_point(const SlicePlane& plane, const GridFrame& frame, const SliceWindow& window,
                     const Vec3& voxel) {
  const double right = (voxel[plane.right] - window.middle_right) * spacing(frame, plane.right);
  const double down = (voxel[plane.down] - window.middle_down) * spacing(frame, plane.down);
  return {0.5 * window.width + plane.right_sign * right / window.m_per_px,
          0.5 * window.height + plane.down_sign * down / window.m_per_px};
}

SliceWindow zoomed(const SlicePlane& plane, const GridFrame& frame, const SliceWindow& window,
                   double factor, double x, double y) {
  const double nearest = 0.05 * std::min(spacing(frame, plane.right), spacing(frame, plane.down));
  const double farthest = 8 * std::max(extent_m(frame, plane.right), extent_m(frame, plane.down)) /
                          std::max(1, std::min(window.width, window.height));
  SliceWindow out = window;
  out.m_per_px = std::clamp(window.m_per_px * factor, nearest, std::max(nearest, farthest));
  const Vec3 before = voxel_at(plane, frame, window, x, y, 0);
  const Vec3 after = voxel_at(plane, frame, out, x, y, 0);
  out.middle_right += before[plane.right] - after[plane.right];
  out.middle_down += before[plane.down] - after[plane.down];
  return out;
}

SliceWindow panned(const SlicePlane& plane, const GridFrame& frame, const SliceWindow& window,
                   double dx, double dy) {
  SliceWindow out = window;
  out.middle_right -= plane.right_sign * dx * window.m_per_px / spacing(frame, plane.right);
  out.middle_down -= plane.down_sign * dy * window.m_per_px / spacing(frame, plane.down);
  return out;
}

}  // namespace osteon
