#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ui/desktop_portal.h"
#include "ui/side_job.h"

namespace osteon {

/// The desktop's own file chooser beside a window that stays alive: it is looked for, shown and
/// waited for on threads of their own. At the end an open chooser is closed.
class DesktopChooser {
 public:
  /// Looks for the desktop's chooser, the first time. Until it is found there is none.
  void look_for();
  bool offers_files();
  bool offers_folders();
  /// Does nothing while one is open.
  void ask(const DesktopQuestion& question);
  bool asks() const { return asking_ != nullptr; }
  /// What was chosen, once; empty: nothing (yet).
  Result<std::vector<std::string>> take();

 private:
  unsigned version();

  std::unique_ptr<SideJob<unsigned>> looking_;
  unsigned version_ = 0;
  bool looked_ = false;
  std::unique_ptr<SideJob<std::vector<std::string>>> asking_;
};

}  // namespace osteon
