#pragma once

#include "window/controllers/cases/edit_control.h"
#include "window/controllers/cases/notes_control.h"
#include "window/controllers/sessions/hands_control.h"
#include "window/controllers/views/scene_poll.h"

namespace osteon {

/// Pointer and keys over the picture: who of probe, bone and camera they move.
class ScenePointer {
 public:
  ScenePointer(WindowHost& host, SceneSight& sight, LiveControl& live, HandsControl& hands,
               EditControl& edit, NotesControl& notes)
      : host_(host), sight_(sight), live_(live), hands_(hands), edit_(edit), notes_(notes) {}

  /// Once a picture; moves what they move. `wheel`: notches.
  void poll(double dt_s, double wheel);
  /// After the scene has taken its new place: what is under the pointer.
  void pick() { sight_.pick_under_pointer(input_, free_for_picking()); }

 private:
  void hold_probe();
  void move(SceneInput& input);
  bool free_for_picking() const { return !nudged_ && !input_.over_panels && !live_.probe_held(); }

  WindowHost& host_;
  SceneSight& sight_;
  LiveControl& live_;
  HandsControl& hands_;
  EditControl& edit_;
  NotesControl& notes_;
  ScenePoll poll_;
  SceneInput input_;
  bool nudged_ = false;  ///< the resting hand had them
};

}  // namespace osteon
