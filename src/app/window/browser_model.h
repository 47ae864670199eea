#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace osteon {

enum class OpenKind : std::uint8_t {
  kFolder,  ///< that is looked into
  kCase,    ///< built in, or a case folder
  kRecording,
  kMeshes,  ///< a folder of meshes, or one mesh: imported as a case
  kScan,    ///< goes on in the segmentation's window
  kNothing  ///< a file that cannot be opened
};

/// One line of what can be opened.
struct OpenEntry {
  OpenKind kind = OpenKind::kNothing;
  std::string label;           ///< "Wrist"
  std::string about;           ///< "built in", "a case, 12 March"
  std::string path;            ///< as `open` takes it: a file, a folder or "builtin:wrist"
  std::uintptr_t picture = 0;  ///< OpenGL's texture; 0: none (yet)
};

struct BrowserModel {
  bool open = false;
  std::vector<OpenEntry> known;  ///< built in, recent, saved patients, recordings
  std::string folder;            ///< that is being looked into
  std::vector<OpenEntry> files;  ///< of it, folders first
  std::string problem;           ///< why the folder cannot be read; empty: it can
  bool importing = false;
  double fraction = 0;
  bool in_millimetres = true;  ///< units of a mesh
  // The desktop's own chooser.
  bool desktop_files = false, desktop_folders = false;  ///< what it can ask for
  bool desktop_asks = false;                            ///< it is open
};

struct BrowserRequests {
  bool toggle = false;
  std::optional<OpenEntry> open;
  std::optional<std::string> look_into;  ///< a folder
  std::optional<bool> in_millimetres;
  bool stop_import = false;
  bool desktop_file = false, desktop_folder = false;  ///< show the desktop's own chooser
};

}  // namespace osteon
