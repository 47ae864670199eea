#pragma once

#include <array>

#include "osteon/image/volume.h"

namespace osteon {

enum class SliceView { kAxial, kCoronal, kSagittal };
inline constexpr std::array<SliceView, 3> kSliceViews = {SliceView::kAxial, SliceView::kCoronal,
                                                         SliceView::kSagittal};

/// How one of the three slice views looks at the grid of a scan, by radiologists' convention: the
/// patient's left is on the right, front and head are up, in a sagittal slice the front is left.
struct SlicePlane {
  SliceView view = SliceView::kAxial;
  int normal = 2, right = 0, down = 1;  ///< voxel axes: across the slice, and along the screen's
  int right_sign = 1, down_sign = 1;    ///< -1: the axis runs to the left, or upwards
  char left_letter = 'R', right_letter = 'L', top_letter = 'A', bottom_letter = 'P';
};

/// "Axial"
const char* name_of(SliceView view);

/// The three planes of a grid, in the order of kSliceViews. An oblique scan's axes count as those
/// of the patient that they are nearest to, each for another one.
std::array<SlicePlane, 3> slice_planes(const GridFrame& frame);

/// The part of a slice that a pane shows: its middle, in voxel coordinates of the plane's two axes,
/// and its scale. Both axes have the same scale in metres, whatever the voxels' spacing.
struct SliceWindow {
  double middle_right = 0, middle_down = 0;
  double m_per_px = 0.0005;
  int width = 1, height = 1;  ///< of the pane, pixels
};

/// Shows the whole slice in a pane of this size.
SliceWindow whole_slice(const SlicePlane& plane, const GridFrame& frame, int width, int height);

/// Voxel coordinates of a place of the pane, pixels from its top left, in slice `slice`.
Vec3 voxel_at(const SlicePlane& plane, const GridFrame& frame, const SliceWindow& window, double x,
              double y, int slice);

/// Where a place, in voxel coordinates, lies in the pane.
struct PanePoint {
  double x = 0, y = 0;
};
PanePoint pane_point(const SlicePlane& plane, const GridFrame& frame, const SliceWindow& window,
                     const Vec3& voxel);

/// Nearer or farther about a place of the pane, which stays where it is; `factor` below 1 goes
/// nearer. Bounded to between a twentieth of a voxel and eight slices a pane.
SliceWindow zoomed(const SlicePlane& plane, const GridFrame& frame, const SliceWindow& window,
                   double factor, double x, double y);

/// Follows a drag by pixels.
SliceWindow panned(const SlicePlane& plane, const GridFrame& frame, const SliceWindow& window,
                   double dx, double dy);

}  // namespace osteon
