#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace osteon {

/// A note of the case.
struct NoteRow {
  std::string text;
  std::string where;   ///< "Scaphoid"; empty: at a place of its own
  bool drawn = false;  ///< its place is in the picture, there:
  float x = 0, y = 0;
};

struct NotesModel {
  std::vector<NoteRow> rows;
  bool shown = true;                   ///< in the picture
  bool can_edit = false;               ///< neither a replay nor an edit needs the case as it is
  std::optional<std::size_t> editing;  ///< whose text is being typed
  bool placing = false;                ///< the next click in the picture is a note's place
  bool saves_itself = true;            ///< false: a built-in case, which is saved as a new one
  bool changed = false;                ///< and not saved
  bool saving = false;
};

/// What the user asked of them.
struct NotesRequests {
  bool add = false;                 ///< the next click in the picture is its place
  std::optional<std::size_t> move;  ///< the same for one that is there
  bool stop_placing = false;
  std::optional<std::size_t> edit;
  std::optional<std::string> text;  ///< of the one being edited, whole
  std::optional<std::size_t> remove;
  bool toggle_shown = false;
  bool save = false;  ///< as a new case
};

}  // namespace osteon
