#include "window/controllers/cases/browser_control.h"

#include <algorithm>

namespace osteon {

void BrowserControl::apply(const BrowserRequests& requests) {
  if (requests.toggle) browser_.toggle(host_.settings.recent);
  if (requests.look_into) browser_.look_into(*requests.look_into);
  if (requests.in_millimetres) browser_.set_in_millimetres(*requests.in_millimetres);
  if (requests.stop_import) browser_.stop_import();
  if (requests.open) open_any(requests.open->path);
  apply_desktop(requests);
  ask_for_pictures();
  const Result<std::string> imported = browser_.take_imported();
  if (!imported) return host_.note(ToastKind::kError, imported.error().message());
  if (imported->empty()) return;
  host_.note(ToastKind::kInfo, "Saved as " + *imported);
  open_any(*imported);
}

// Looked for when the browser opens: where a portal starts first, that takes seconds.
void BrowserControl::apply_desktop(const BrowserRequests& requests) {
  if (browser_.is_open()) desktop_.look_for();
  if (requests.desktop_file || requests.desktop_folder)
    desktop_.ask({requests.desktop_folder ? "Open a folder with Osteon" : "Open with Osteon",
                  requests.desktop_folder, host_.window->name_for_desktop()});
  const Result<std::vector<std::string>> chosen = desktop_.take();
  if (!chosen) return host_.note(ToastKind::kError, chosen.error().message());
  open_together(*chosen);
}

// Once when the browser opens: a picture that cannot be drawn is not tried at each frame. Of what
// comes later the next opening shows the picture.
void BrowserControl::ask_for_pictures() {
  pictures_.poll();
  if (browser_.is_open() == pictures_wanted_) return;
  pictures_wanted_ = browser_.is_open();
  std::vector<std::string> cases;
  if (pictures_wanted_)
    for (const OpenEntry& entry : browser_.model().known)
      if (entry.kind == OpenKind::kCase) cases.push_back(entry.path);
  pictures_.want(cases);
}

void BrowserControl::open_any(const std::string& path) {
  switch (kind_of(path)) {
    case OpenKind::kFolder:
      browser_.look_into(path);
      if (!browser_.is_open()) browser_.toggle(host_.settings.recent);
      return;
    case OpenKind::kCase: {
      browser_.close();
      const std::filesystem::path file = path;
      return cases_.open(
          {file.filename() == "case.toml" ? file.parent_path().string() : path, {}, nullptr});
    }
    case OpenKind::kMeshes:
      return import({path});
    case OpenKind::kScan:
      scan_ = path;
      return go_to_segmentation();
    case OpenKind::kRecording:
      browser_.close();
      return cases_.open({scene_.source, path, scene_.the_case});
    case OpenKind::kNothing:
      break;
  }
  host_.note(ToastKind::kError, "Osteon cannot open this: " + path +
                                    ". It opens case folders, recordings (.osr), meshes and "
                                    "scans.");
}

void BrowserControl::import(const std::vector<std::filesystem::path>& meshes) {
  host_.note(ToastKind::kInfo, "Importing the meshes as a case.");
  browser_.import(meshes);
}

void BrowserControl::open_together(const std::vector<std::string>& paths) {
  if (paths.empty()) return;
  const bool meshes = std::all_of(paths.begin(), paths.end(), [](const std::string& path) {
    std::error_code unreadable;  // a folder on the way may not be looked into
    return std::filesystem::is_regular_file(path, unreadable) && kind_of(path) == OpenKind::kMeshes;
  });
  if (meshes) return import({paths.begin(), paths.end()});
  if (paths.size() > 1 && kind_of(paths.front()) != OpenKind::kScan)
    host_.note(ToastKind::kInfo, "Only the first of several is opened.");
  open_any(paths.front());
}

void BrowserControl::go_to_segmentation() {
  if (live_.recording())
    return host_.note(ToastKind::kWarning, "Stop the recording before segmenting a scan.");
  wants_segmentation_ = true;
  host_.window->close();
}

BrowserModel BrowserControl::model() {
  if (!browser_.is_open()) return {};
  BrowserModel model = browser_.model();
  model.desktop_files = desktop_.offers_files();
  model.desktop_folders = desktop_.offers_folders();
  model.desktop_asks = desktop_.asks();
  for (OpenEntry& entry : model.known) entry.picture = pictures_.texture(entry.path);
  return model;
}

}  // namespace osteon
