#pragma once

#include <string>

#include "cases/xdg.h"
#include "ui/desktop_chooser.h"
#include "window/controllers/cases/case_browser.h"
#include "window/controllers/cases/case_control.h"
#include "window/pictures/case_pictures.h"

namespace osteon {

/// What the user opens: from the browser, dropped on the window, or typed.
class BrowserControl {
 public:
  BrowserControl(WindowHost& host, ShownCase& scene, LiveControl& live, CaseControl& cases)
      : host_(host), scene_(scene), live_(live), cases_(cases) {}

  void close() { browser_.close(); }
  void apply(const BrowserRequests& requests);
  void open_any(const std::string& path);
  /// What was dropped or chosen together: one thing, or several meshes that make one case.
  void open_together(const std::vector<std::string>& paths);
  /// A scan may need all memory, and a graphics context is current in one window: the
  /// segmentation's takes this one's place.
  void go_to_segmentation();
  bool wants_segmentation() const { return wants_segmentation_; }
  /// That the segmentation's window opens; empty: the user chooses.
  const std::string& scan_to_segment() const { return scan_; }
  BrowserModel model();

 private:
  void ask_for_pictures();
  void apply_desktop(const BrowserRequests& requests);
  void import(const std::vector<std::filesystem::path>& meshes);
  WindowHost& host_;
  ShownCase& scene_;
  LiveControl& live_;
  CaseControl& cases_;
  CaseBrowser browser_{data_home_dir()};
  DesktopChooser desktop_;
  CasePictures pictures_{cache_dir() / "pictures"};
  bool pictures_wanted_ = false;
  bool wants_segmentation_ = false;
  std::string scan_;
};

}  // namespace osteon
