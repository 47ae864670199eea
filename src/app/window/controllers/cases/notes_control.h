#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "osteon/scene/case_notes.h"
#include "window/controllers/cases/case_control.h"
#include "window/notes_model.h"

namespace osteon {

/// Notes on the case on show: placed by the mouse, kept in the case's folder. Of a built-in case
/// they are kept once it is saved as a new one.
class NotesControl {
 public:
  NotesControl(WindowHost& host, ShownCase& scene, SceneSight& sight, LiveControl& live,
               CaseControl& cases)
      : host_(host), scene_(scene), sight_(sight), live_(live), cases_(cases) {}

  /// Another case is on show.
  void begin_case();
  /// True: a click in the picture is a note's place, not the camera's.
  bool poll_pointer(const SceneInput& input);
  void stop_placing() { placing_ = false; }
  void apply(const NotesRequests& requests, bool may_edit);
  void poll_save();
  NotesModel model(bool may_edit) const;

 private:
  void place(const SurfacePoint& at);
  void take_text(const std::string& text);
  void keep();
  void save_as_case();
  bool saves_itself() const;
  std::optional<Vec3> place_W(const CaseNote& note) const;

  WindowHost& host_;
  ShownCase& scene_;
  SceneSight& sight_;
  LiveControl& live_;
  CaseControl& cases_;
  std::string source_;  ///< of the case that they are on
  CaseNotes notes_;
  bool shown_ = true;
  bool changed_ = false;  ///< and not saved
  bool placing_ = false;
  std::optional<std::size_t> moved_;    ///< that is being placed; none: a new one
  std::optional<std::size_t> editing_;  ///< whose text is being typed
  bool left_was_down_ = false;
  bool swallows_ = false;  ///< the button that placed a note is still down
  std::unique_ptr<SideJob<std::filesystem::path>> save_;  ///< while one runs
};

}  // namespace osteon
