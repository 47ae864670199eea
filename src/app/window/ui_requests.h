#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "loops/mapping_settings.h"
#include "osteon/render/renderer.h"
#include "osteon/scene/case.h"
#include "osteon/scene/command.h"
#include "window/browser_model.h"
#include "window/edit_model.h"
#include "window/exercise_model.h"
#include "window/hands_model.h"
#include "window/notes_model.h"
#include "window/patient_model.h"
#include "window/views_model.h"

namespace osteon {

/// A bone that shall be felt otherwise.
struct FeltWish {
  BoneId bone;
  Felt felt = Felt::kPieces;
};

/// A joint that shall be bent.
struct BendWish {
  std::size_t joint = 0;
  double degrees = 0;
  bool done = false;  ///< the slider was let go
};

/// What the user asked for in one frame. The panels change nothing by themselves.
struct UiRequests {
  std::optional<ViewState> view;
  std::optional<ViewPreset> preset;
  bool close_up = false;  ///< of the picked bone, else of the joint
  std::vector<Command> commands;
  std::optional<FeltWish> felt;  ///< opens the case again
  std::optional<BendWish> bend;  ///< shown at once; once it is done, opens the case again
  std::optional<int> device;
  std::optional<double> seek_s;
  std::optional<double> speed;
  std::optional<double> left_card;       ///< width, units
  std::optional<double> zoom_interface;  ///< factor on the interface's size
  BoneId hovered_row;
  BoneId picked_row;
  std::optional<MappingSettings> mapping;
  std::optional<std::string> learn_pedal;  ///< its name; empty: stop waiting
  std::optional<std::string> forget_pedal;
  bool calibrate = false;
  bool toggle_checkup = false;  ///< opening begins one
  bool begin_checkup = false;
  bool begin_push_test = false;  ///< a check-up with the gentle force; the press is the consent
  bool cancel_checkup = false;
  bool install_udev = false;
  std::optional<std::string> copy;  ///< to the clipboard
  EditRequests edit;
  BrowserRequests browser;
  HandsRequests hands;
  NotesRequests notes;
  PatientRequests patient;
  ExerciseRequests exercise;
  ViewsRequests views;
  bool force_off = false;
  bool force_on = false;
  bool toggle_probe = false;
  bool toggle_record = false;
  bool toggle_play = false;
  bool toggle_panels = false;
  bool toggle_help = false;
  bool toggle_fullscreen = false;
  bool close_replay = false;
  bool cancel_loading = false;
  bool retry_loading = false;
  bool screenshot_window = false;
  bool screenshot_picture = false;
  bool dismiss_hint = false;
  bool segment_scan = false;  ///< goes on in the segmentation window
  bool quit = false;
  std::optional<std::uint64_t> dismiss_toast;
};

}  // namespace osteon
