#pragma once

#include <functional>
#include <string>

#include "osteon/image/progress.h"

namespace osteon {

/// Shows progress on one line of standard error, where that is a terminal, and answers false once
/// Ctrl-C was pressed. Show it for all that may take two seconds. One at a time; the usual meaning
/// of Ctrl-C comes back at its end.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  Progress callback();
  /// The same for work that is stopped by an exception: throws std::runtime_error after Ctrl-C.
  std::function<void(const char* what, double share)> stopping();

  /// No line is shown from now on, by any of them: --quiet.
  static void keep_silent();

 private:
  bool show(const char* what, double share);
  void (*before_)(int) = nullptr;  ///< what Ctrl-C meant
  bool terminal_ = false;
  std::string shown_;
};

}  // namespace osteon
