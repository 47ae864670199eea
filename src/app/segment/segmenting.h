#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "osteon/image/label_tools.h"
#include "osteon/image/threshold.h"
#include "segment/segment_requests.h"
#include "segment/slice_picture.h"
#include "segment/slice_plane.h"

namespace osteon {

/// A scan that is being segmented by hand: the labels, and where and with which tool the user
/// works. Knows neither window nor picture: it takes what the user asked for and changes.
class Segmenting {
 public:
  /// `edit` with the levels that find_bone_levels says of its scan.
  Segmenting(LabelEdit edit, const BoneLevels& levels);

  const LabelEdit& edit() const { return edit_; }
  const BoneLevels& levels() const { return levels_; }
  const ToolSettings& tools() const { return tools_; }
  const GreyWindow& grey() const { return grey_; }
  const std::array<SlicePlane, 3>& planes() const { return planes_; }
  const std::array<SliceWindow, 3>& windows() const { return windows_; }
  /// Voxel under the cross-hair: its slices are shown.
  const std::array<int, 3>& cross() const { return cross_; }
  int slice(std::size_t pane) const { return cross_[axis(planes_[pane].normal)]; }
  std::uint16_t chosen() const { return chosen_; }
  bool is_shown(std::uint16_t label) const { return !hidden_.count(label); }
  SliceLook look() const;
  /// Rises with everything that a slice shows but its place.
  std::uint64_t look_version() const { return look_version_ + edit_.version(); }
  /// The start of a split that is being drawn, and where the pointer is; both in one pane.
  struct Stroke {
    std::size_t pane = 0;
    Vec3 from_voxel = Vec3::Zero(), to_voxel = Vec3::Zero();
  };
  const std::optional<Stroke>& split_stroke() const { return split_; }

  /// Size of a pane in pixels; shows its whole slice the first time and keeps its scale after.
  void resize_pane(std::size_t pane, int width, int height);
  /// Changes what was asked for. What could not be done is said in the error; nothing of it is.
  Result<void> apply(const SegmentRequests& requests, const Progress& progress = {});
  /// The labels that the import finds, as one step that can be undone.
  Result<void> take_labels(const LabelVolume& labels,
                           const std::map<std::uint16_t, std::string>& names);
  void mark_saved() { edit_.mark_saved(); }

 private:
  static std::size_t axis(int a) { return static_cast<std::size_t>(a); }
  Result<void> apply_bones(const SegmentRequests& requests, const Progress& progress);
  void apply_history(const SegmentRequests& requests);
  // segmenting_pointer.cpp
  Result<void> point(const PaneInput& input, const Progress& progress);
  void look_around(const PaneInput& input);
  void wheel(const PaneInput& input);
  Result<void> press(const PaneInput& input, const Vec3& voxel, const Progress& progress);
  void drag(const PaneInput& input, const Vec3& voxel);
  Result<void> release(const Progress& progress);
  Result<void> begin_paint(const PaneInput& input, const Vec3& voxel, bool erase);
  Result<void> grow_at(const Vec3& voxel, bool fresh, const Progress& progress);
  Result<void> merge_at(const Vec3& voxel);
  Result<void> end_split(const Progress& progress);
  Result<void> find_bodies(const Progress& progress);
  LabelBrush brush(const PaneInput& input, bool erase) const;
  std::array<int, 3> voxel_of(const Vec3& voxel) const;
  std::uint16_t label_at(const Vec3& voxel) const;
  void put_cross(const Vec3& voxel);
  void go_to(std::uint16_t label);
  void choose(std::uint16_t label);
  void keep_choice();

  LabelEdit edit_;
  BoneLevels levels_;
  ToolSettings tools_;
  GreyWindow grey_ = kBoneWindow;
  std::array<SlicePlane, 3> planes_;
  std::array<SliceWindow, 3> windows_;
  std::array<int, 3> cross_{};
  std::uint16_t chosen_ = 0;
  std::set<std::uint16_t> hidden_;
  std::uint64_t look_version_ = 0;
  std::optional<Vec3> painted_to_;  ///< of the stroke under way, voxel coordinates
  bool erasing_ = false;
  std::optional<Stroke> split_;
};

}  // namespace osteon
