#pragma once

#include <memory>
#include <string>

#include "window/controllers/cases/case_control.h"
#include "window/ui_model.h"

namespace osteon {

/// The check-up of computer and device.
class CheckupControl {
 public:
  CheckupControl(WindowHost& host, LiveControl& live, const CaseControl& cases)
      : host_(host), live_(live), cases_(cases) {}

  bool running() const { return job_ != nullptr; }
  void open();
  void close() { open_ = false; }
  void apply(const UiRequests& requests);
  void poll();
  /// Cancels one that runs. A lent device goes back to its run.
  void end();
  /// The same when the window ends: the device is closed.
  void drop() { job_.reset(); }
  CheckupModel model() const;

 private:
  void begin(bool push);
  void install_udev();
  std::string not_now_because() const;

  WindowHost& host_;
  LiveControl& live_;
  const CaseControl& cases_;
  bool open_ = false;
  std::unique_ptr<SideJob<CheckupOutcome>> job_;  ///< while one runs
  CheckupReport report_;                          ///< of the last one
};

}  // namespace osteon
