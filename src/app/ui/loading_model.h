#pragma once

#include <string>

namespace osteon {

enum class UiPhase { kLoading, kReady, kFailed };

/// Work that runs beside the picture.
struct LoadingModel {
  std::string what;          ///< "Generating the bones"
  double fraction = 0;       ///< 0..1
  double seconds_left = -1;  ///< -1: not known yet
  std::string failure;       ///< in words, with what to do; empty unless it failed
  bool can_cancel = false;
};

}  // namespace osteon
