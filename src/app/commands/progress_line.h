#pragma once

#include <string>

#include "osteon/image/progress.h"

namespace osteon {

/// Shows progress on one line of standard error, where that is a terminal, and answers false once
/// Ctrl-C was pressed. One at a time; the usual meaning of Ctrl-C comes back at its end.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  Progress callback();

 private:
  bool show(const char* what, double share);
  bool terminal_ = false;
  std::string shown_;
};

}  // namespace osteon
