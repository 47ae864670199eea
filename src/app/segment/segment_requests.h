#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "osteon/image/label_tools.h"
#include "segment/slice_picture.h"
#include "ui/scene_input.h"

namespace osteon {

enum class SegmentTool { kCross, kPaint, kErase, kGrow, kSplit, kMerge };

struct ToolSettings {
  SegmentTool tool = SegmentTool::kCross;
  HuRange range;
  bool preview = true;       ///< the threshold is shown in the slices
  double radius_m = 0.002;   ///< of the brush
  bool ball = true;          ///< the brush reaches into neighbouring slices
  bool within = false;       ///< the brush touches values within the threshold alone
  bool over_others = false;  ///< the brush takes from other bones
  bool fill = true;          ///< growing takes the marrow with it
  bool fresh = true;         ///< each click of growing makes a bone of its own
  double reach_m = 0;        ///< of growing; 0: all that is connected
  bool operator==(const ToolSettings&) const = default;
};

/// The pointer over a slice in one frame; pixels from the pane's top left.
struct PaneInput {
  std::size_t pane = 0;
  double x = 0, y = 0, dx = 0, dy = 0;
  double wheel = 0;                                      ///< notches, positive away from the user
  bool pressed = false, held = false, released = false;  ///< the left button
  bool right_held = false, middle_held = false;
  bool ctrl = false, shift = false;
};

struct NewName {
  std::uint16_t label = 0;
  std::string name;
};

/// What the user asked of a segmentation in one frame.
struct SegmentRequests {
  std::optional<PaneInput> pointer;
  SceneInput solid;  ///< over the 3D view; pixels from its top left
  std::optional<ToolSettings> tools;
  std::optional<GreyWindow> grey;
  std::optional<std::uint16_t> choose;
  std::optional<NewName> rename;
  std::optional<std::uint16_t> toggle_shown, remove;
  std::optional<std::uint16_t> merge;  ///< this one into the chosen one
  bool show_all = false, hide_others = false;
  bool add = false;
  bool find_bodies = false;  ///< a bone for each part of the threshold
  bool split_chosen = false;
  bool fit_panes = false;
  bool undo = false, redo = false;
  bool suggest = false;  ///< what the import finds
  bool save = false;
  bool cancel_job = false;
  bool toggle_help = false, toggle_panels = false, toggle_fullscreen = false;
  bool quit = false;
  bool quit_without_saving = false, quit_after_saving = false, stay = false;
  std::optional<std::uint64_t> dismiss_toast;
  std::optional<double> zoom_interface;
  std::optional<std::string> save_as;                 ///< the case's folder
  std::optional<std::string> browse, open_scan;       ///< a folder to look into, a scan to open
  bool desktop_file = false, desktop_folder = false;  ///< to be asked for by the desktop's chooser
  std::optional<std::string> series;
  std::optional<Vec3> spacing_mm;
  bool choose_scan = false;  ///< another one, after one could not be opened
  bool open_case = false;    ///< the saved one, in the simulator's window
};

}  // namespace osteon
