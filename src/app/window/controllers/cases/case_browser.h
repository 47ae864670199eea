#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cases/import_mesh.h"
#include "ui/side_job.h"
#include "window/browser_model.h"

namespace osteon {

/// What a name stands for: a built-in case, a case folder, a recording, meshes, a scan, or a folder
/// to look into. Reads the names in a folder, and the start of a few files whose names do not tell
/// whether they are DICOM.
OpenKind kind_of(const std::string& path);

/// What the user can open, and the import of meshes. Knows neither window nor picture.
class CaseBrowser {
 public:
  /// `home`: the folder of the user's own cases and recordings.
  explicit CaseBrowser(std::filesystem::path home) : home_(std::move(home)) {}

  bool is_open() const { return model_.open; }
  /// Lists all anew when it opens. `recent`: the last one first.
  void toggle(const std::vector<std::string>& recent);
  void close() { model_.open = false; }
  /// The folder that is listed, whether or not the list is open.
  void look_into(const std::filesystem::path& folder);
  void set_in_millimetres(bool on) { model_.in_millimetres = on; }

  /// Makes one case of meshes beside the picture: a folder of them, one, or several. Does nothing
  /// while it makes one.
  void import(const std::vector<std::filesystem::path>& sources);
  void stop_import();
  /// The folder of a case that has been imported, once; empty: none. An error says why not, once.
  Result<std::string> take_imported();

  BrowserModel model() const;

 private:
  void add_folder_of(const std::filesystem::path& folder, const char* about);

  std::filesystem::path home_;
  BrowserModel model_;
  std::filesystem::path folder_;
  std::filesystem::path importing_to_;
  std::unique_ptr<SideJob<std::string>> import_;
};

/// `name` first, each once, at most twelve.
std::vector<std::string> with_recent(std::vector<std::string> recent, const std::string& name);

}  // namespace osteon
