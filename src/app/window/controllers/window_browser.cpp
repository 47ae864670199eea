#include "window/window_app.h"

namespace osteon {

void WindowApp::apply_browser(const BrowserRequests& requests) {
  if (requests.toggle) browser_.toggle(settings_.recent);
  if (requests.look_into) browser_.look_into(*requests.look_into);
  if (requests.in_millimetres) browser_.set_in_millimetres(*requests.in_millimetres);
  if (requests.stop_import) browser_.stop_import();
  if (requests.open) open_any(requests.open->path);
  const Result<std::string> imported = browser_.take_imported();
  if (!imported) return note(ToastKind::kError, imported.error().message());
  if (imported->empty()) return;
  note(ToastKind::kInfo, "Saved as " + *imported);
  open_any(*imported);
}

// Also what was dropped on the window, and what was typed.
void WindowApp::open_any(const std::string& path) {
  switch (kind_of(path)) {
    case OpenKind::kFolder:
      return browser_.look_into(path);
    case OpenKind::kCase: {
      browser_.close();
      const std::filesystem::path file = path;
      return open(
          {file.filename() == "case.toml" ? file.parent_path().string() : path, {}, nullptr});
    }
    case OpenKind::kMeshes:
      note(ToastKind::kInfo, "Importing the meshes as a case.");
      return browser_.import(path);
    case OpenKind::kScan:
      scan_to_segment_ = path;
      return go_to_segmentation();
    case OpenKind::kRecording:
      browser_.close();
      return open({case_source_, path, case_});
    case OpenKind::kNothing:
      break;
  }
  note(ToastKind::kError, "This is nothing that Osteon can open: " + path +
                              ". It opens case folders, recordings (.osr), meshes and scans.");
}

}  // namespace osteon
