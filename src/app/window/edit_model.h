#pragma once

#include <optional>
#include <string>
#include <vector>

#include "osteon/mesh/soft_selection.h"

namespace osteon {

/// A vertex that follows the grabbed one, on the screen.
struct EditDot {
  float x = 0, y = 0;
  float weight = 0;
};

/// What the editing card shows.
struct EditModel {
  bool can_begin = false;  ///< a bone is chosen in a live case
  bool on = false;
  std::string bone;
  SoftSelection selection;
  bool grabbed = false;
  double displacement_mm = 0;
  double volume_cm3 = 0;
  std::size_t undo_steps = 0, redo_steps = 0;
  std::size_t forgotten_steps = 0;  ///< too old to be undone
  bool changed = false;             ///< since it was last saved
  bool saving = false;
  bool sound = true;
  std::string findings;
  std::vector<EditDot> dots;
};

/// What the user asked of it.
struct EditRequests {
  bool begin = false;
  bool leave = false;  ///< puts back what was not saved
  bool undo = false, redo = false;
  bool save = false;  ///< as a new case
  std::optional<SoftSelection> selection;
};

}  // namespace osteon
