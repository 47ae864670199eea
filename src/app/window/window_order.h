#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "window/views_model.h"

namespace osteon {

/// What the command line asks of the window.
struct WindowOrder {
  std::string case_spec = "builtin:wrist";
  std::filesystem::path replay;      ///< a recording to open; empty: the live case
  std::filesystem::path screenshot;  ///< saved after `frames` pictures; then the program ends
  int frames = 0;                    ///< pictures to draw once loaded before ending; 0: no end
  bool at_once = false;              ///< with `frames`: begins as for a user, with what is there
  double at_s = 0;                   ///< of simulated time, reached before `frames` are counted
  int width = 0, height = 0;         ///< 0: as last time
  double interface_scale = 0;        ///< 0: the display's, times the user's zoom
  PictureLayout layout = PictureLayout::kOutside;  ///< to begin with
  std::optional<PictureLayout> observer;  ///< the second window begins with it; none: no window
  bool sound = true;                      ///< through the loudspeaker
  std::filesystem::path film;             ///< of the window, from the first picture on; empty: none
  bool felt = false;                      ///< begins with bones coloured by what is felt
  bool heat = false;                      ///< begins with bones coloured by how warm they became
  bool softs = false;                     ///< begins with the soft parts shown
  std::vector<std::string> give_way;      ///< soft parts that do in live runs, as `--soft` names
                                          ///< them; begins with these shown
  double turn_deg = 0;                    ///< of the camera, each picture that is counted
  bool close_up = false;                  ///< begins close up on the joint
  std::vector<double> eye_mm, toward_mm;  ///< in World: where the view from outside begins; or none
  bool demo = false;                      ///< the virtual hand plays the case's path
  /// Hands to begin with, as parse_hand_order takes them: "phantom:left=hook_probe"; none: one
  /// hand with the device of last time.
  std::vector<std::string> devices;
  std::filesystem::path path;            ///< what an emulated hand plays; empty: the case's own
  std::filesystem::path record;          ///< recorded from the start; empty: nothing
  std::filesystem::path force_log;       ///< of the device's last seconds; empty: none
  std::string edit;                      ///< name of the bone whose editing begins; empty: none
  bool checkup = false;                  ///< opens the check-up and begins one
  bool new_patient = false;              ///< opens the panel that makes one
  std::string exercise;                  ///< whose briefing is opened; empty: none
  std::filesystem::path graft, portals;  ///< reports of what was made before; empty: none
  std::string from_stage, to_stage;      ///< the part that is played; empty: from, to the end
  std::string ghost;  ///< beside an exercise: a recording's file, "off", or empty: an expert's
  std::optional<double> ghost_strength;  ///< 0..1; none: by the learner's results
  bool guide = false;                    ///< an exercise begins with the hands led
  bool fresh = false;                    ///< neither reads nor writes the settings file
};

}  // namespace osteon
