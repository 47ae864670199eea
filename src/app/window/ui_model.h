#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "checkup/computer_findings.h"
#include "loops/loop_exchange.h"
#include "loops/mapping_settings.h"
#include "osteon/device/haptic_device.h"
#include "osteon/render/renderer.h"
#include "osteon/scene/case.h"
#include "runs/hands/pedals.h"
#include "runs/reports/contact_timeline.h"
#include "ui/loading_model.h"
#include "ui/toasts.h"
#include "window/browser_model.h"
#include "window/edit_model.h"
#include "window/exercise_model.h"
#include "window/hands_model.h"
#include "window/notes_model.h"
#include "window/patient_model.h"
#include "window/views_model.h"

namespace osteon {

struct HandModel {
  std::vector<std::string> devices;  ///< for the menu
  int device = 0;
  DeviceInfo info;
  DeviceStatus status;
  double force_n = 0;      ///< that the simulation computes
  double torque_nm = 0;    ///< about the grip, likewise
  bool has_lever = false;  ///< the instrument has a shaft, so that there may be a torque
  double force_limit_n = 8;
  double stiffness_n_per_m = 2000;
  double stiffness_max_n_per_m = 4000;  ///< of the device's profile
  double friction_scale = 1;
  bool bones_held = true;
  LoopStats haptic, physics;
  double picture_hz = 0;
  std::string realtime_warning;
  bool probe_in_hand = false;  ///< the mouse moves the probe
  bool probe_by_mouse = true;  ///< the chosen device is the mouse
  bool has_dead_man = false;   ///< the device's own switch, or a pedal
  bool dead_man_held = true;
  struct Mapping {
    bool settable = false;  ///< a real device: an emulated one has its path
    MappingSettings settings;
    std::string dead_man = "none", clutch = "none",
                power = "none";  ///< what drives the pedals, in words
  } mapping;
  std::string learning_pedal;  ///< the pedal that waits for its input; empty: none
};

/// The check-up of computer and device.
struct CheckupModel {
  bool open = false;
  bool running = false;
  std::string doing;    ///< "Reading the device"
  double fraction = 0;  ///< 0..1
  Findings findings;    ///< of the last one
  std::string verdict;  ///< empty: none was made yet
  std::string device;   ///< that may be tried with a gentle force; empty: none
  UdevRule udev;
  std::string not_now;  ///< why none can be started now; empty: one can
};

struct ContactRow {
  BoneId bone;
  double force_n = 0;
  double depth_mm = 0;
  bool sticking = false;
};

/// A soft part that the hand presses or pulls, or that has been cut.
struct SoftRow {
  std::uint32_t soft = 0;  ///< in UiModel::soft_labels
  double force_n = 0;
  double tension_n = -1;  ///< below 0: it has none
  double left = 1;        ///< share of its strands
};

struct RecordModel {
  bool on = false;
  double seconds = 0;
  std::string file;
};

struct ReplayModel {
  bool on = false;
  bool playing = false;
  double duration_s = 0;
  double position_s = 0;
  double speed = 1;
  std::string file;
  std::string verdict;  ///< "Repeats exactly", or where it differs
  bool identical = true;
};

/// Something that happened, on the timeline.
struct TimelineMark {
  double time_s = 0;
  std::string text;
  bool harm = false;  ///< a fault, or a force over its limit
};

struct TimelineModel {
  double end_s = 0;
  std::span<const ContactSpan> spans;
  std::span<const TimelineMark> marks;
};

/// A joint of the case, which the user may bend.
struct JointModel {
  std::string label;  ///< "Flexion"
  double degrees = 0, min_deg = 0, max_deg = 0;
};

/// All that the panels show, as values: one a frame.
struct UiModel {
  float width = 1280, height = 720;  ///< framebuffer, pixels
  float scale = 1;                   ///< of the interface: 1 is 96 dots an inch
  float left_card = 0;               ///< width, units; 0: not dragged
  UiPhase phase = UiPhase::kReady;
  LoadingModel loading;

  std::string case_title;  ///< "Wrist, right"
  bool is_knee = false;    ///< the views have a knee's names
  bool is_box = false;     ///< something to practise with: the views are not those of a body
  std::string activity;    ///< "Exploring", "Replay", "Demonstration"
  double time_s = 0;       ///< simulated
  std::vector<std::string> bone_labels;
  std::vector<Felt> bone_felt;  ///< as bone_labels
  std::vector<bool> bone_open;  ///< as bone_labels: its surface is open
  std::vector<std::string> soft_labels;
  std::vector<JointModel> joints;
  bool can_bend =
      false;  ///< now: neither a replay, a recording nor an edit needs the case as it is
  ViewState view;
  double felt_measured = 1;  ///< share of what is felt whose distance from what is seen is known
  BoneId hovered;            ///< under the pointer, in the picture
  BoneId picked;
  float pointer_x = 0, pointer_y = 0;

  HandModel hand;
  std::vector<ContactRow> contacts;
  std::vector<SoftRow> soft_rows;
  std::span<const float> force_history;  ///< N, oldest first, kForceHistoryHz
  RecordModel record;
  ReplayModel replay;
  TimelineModel timeline;
  std::span<const Toast> toasts;

  CheckupModel checkup;
  ExerciseModel exercise;
  BrowserModel browser;
  HandsModel hands;
  NotesModel notes;
  ViewsModel views;
  EditModel edit;
  PatientModel patient;
  bool panels_open = true;
  bool help_open = false;
  bool first_run_hint = false;
};

}  // namespace osteon
