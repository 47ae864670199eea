#pragma once

#include <optional>
#include <string>
#include <variant>

#include "segment/segment_app.h"
#include "window/window_app.h"

namespace osteon {

/// The window to run next.
using WindowTurn = std::variant<WindowOrder, SegmentOrder>;

/// The simulator's window after the segmentation's: with the case that was saved there, else with
/// the one that was open before; none where there is neither.
std::optional<WindowTurn> turn_after_segmentation(const std::filesystem::path& saved_case,
                                                  const WindowOrder& before);

/// Runs windows one after the other, as the user goes from one to the next. Returns the exit code.
int run_windows(WindowTurn turn);

}  // namespace osteon
