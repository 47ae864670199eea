#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "segment/scan_folder.h"
#include "segment/segment_requests.h"
#include "ui/loading_model.h"
#include "ui/toasts.h"
#include "ui/ui_layout.h"

namespace osteon {

/// Where the parts of the segmentation window lie, pixels from its top left: a tool card, a bone
/// card, and four panes between them.
struct SegmentLayout {
  UiRect top, tools, bones, middle;
  std::array<UiRect, 3> slices;  ///< in the order of kSliceViews
  UiRect solid;                  ///< the 3D view
};
SegmentLayout make_segment_layout(float width, float height, float scale, bool panels_open);

struct SegmentBoneRow {
  std::uint16_t label = 0;
  std::string name;
  int fma_id = 0;
  std::size_t voxels = 0;
  double volume_cm3 = 0;
  bool shown = true;
};

struct SlicePane {
  SlicePlane plane;
  void* image = nullptr;  ///< texture of the pane's size; null: none yet
  int slice = 0, slices = 1;
  PanePoint cross;
  double px_per_mm = 1;
};

/// While a scan is being chosen.
struct ScanChooserModel {
  ScanFolder folder;
  std::string series;
  Vec3 spacing_mm = Vec3(0.5, 0.5, 0.5);                ///< of pictures
  bool desktop_files = false, desktop_folders = false;  ///< the desktop has a chooser for them
  bool desktop_asks = false;                            ///< which is open
};

struct SegmentModel {
  float width = 1280, height = 720;
  float scale = 1;
  UiPhase phase = UiPhase::kReady;
  LoadingModel loading;                     ///< of the scan, or why it could not be opened
  std::optional<ScanChooserModel> chooser;  ///< in place of everything else
  bool returns = false;                     ///< the simulator's window comes after this one

  std::string title;  ///< the scan's file
  std::string shape;  ///< "60 x 60 x 80 voxels of 0.5 x 0.5 x 0.5 mm"
  ToolSettings tools;
  GreyWindow grey;
  HuRange values{-1024, 3071};  ///< of the scan: where the sliders end
  std::vector<SegmentBoneRow> bones;
  std::vector<std::string> known_names;  ///< offered for a bone
  std::uint16_t chosen = 0;
  std::array<SlicePane, 3> panes;
  struct SplitLine {
    std::size_t pane = 0;
    PanePoint from, to;
  };
  std::optional<SplitLine> split;
  std::string under_pointer;  ///< "412 HU, lunate"
  bool has_solid = false;     ///< the 3D view shows something
  bool solid_busy = false;    ///< and is being drawn anew

  std::size_t undo_steps = 0, redo_steps = 0;
  std::string undo_what, redo_what;
  bool changed = false;
  std::string out;                  ///< the case's folder
  bool saved = false;               ///< it holds a case, as it stands here
  std::optional<LoadingModel> job;  ///< suggesting or saving
  bool asks_to_close = false;       ///< with changes that are not saved
  bool help_open = false;
  bool panels_open = true;
  std::span<const Toast> toasts;
};

}  // namespace osteon
