#pragma once

#include <optional>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/image/progress.h"

namespace osteon {

/// What the user is asked for in the desktop's own file chooser.
struct DesktopQuestion {
  std::string title;
  bool folder = false;  ///< one folder; else one or more files
  std::string parent =
      {};  ///< the window that asks, as a portal names it ("x11:1a0003"); may be empty
};

/// Version of the file chooser of the desktop's portal (org.freedesktop.portal.FileChooser on the
/// session's D-Bus). 0: there is none, or no bus. Folders can be asked for from version 3. May take
/// seconds where the portal starts first.
unsigned desktop_chooser_version();

/// Shows the chooser and returns when the user has chosen: the paths, none if the user cancelled.
/// Asks `progress` ten times a second whether to go on; else the chooser is closed again.
Result<std::vector<std::string>> choose_on_desktop(const DesktopQuestion& question,
                                                   const Progress& progress);

/// The path of a "file://" URI, its escaped bytes decoded. None for other URIs and other hosts.
std::optional<std::string> path_of_uri(const std::string& uri);

}  // namespace osteon
