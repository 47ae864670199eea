#pragma once

#include <cstddef>
#include <string>

#include "runs/reports/run_events.h"
#include "window/controllers/sessions/live_control.h"

namespace osteon {

/// What a hand has done to a soft part that cannot be seen at once: in words; empty: nothing.
std::string soft_news_of(const Event& event, const Case& the_case);

/// The same of pins, aimers and drills that slide off.
std::string guide_news_of(const Event& event, const Case& the_case);

/// Tells the user of a live run, as it happens, which ligament is in two, what jaws have lost, what
/// leads drills and which of them slides off.
class RunNews {
 public:
  RunNews(WindowHost& host, const ShownCase& scene, const LiveControl& live)
      : host_(host), scene_(scene), live_(live) {}
  /// Once a picture.
  void update();

 private:
  std::string news_of(const RunEvent& happened);

  WindowHost& host_;
  const ShownCase& scene_;
  const LiveControl& live_;
  std::size_t told_ = 0;     ///< events of the run that were looked at
  double slid_at_s_ = -100;  ///< when a drill was last told to slide off
};

}  // namespace osteon
