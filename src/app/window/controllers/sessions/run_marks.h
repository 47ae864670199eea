#pragma once

#include <cstdint>
#include <vector>

#include "window/controllers/sessions/live_control.h"
#include "window/controllers/sessions/replay_control.h"
#include "window/ui_model.h"

namespace osteon {

/// What happened in the run or the replay, in words, for the timeline.
class RunMarks {
 public:
  RunMarks(const ShownCase& scene, const LiveControl& live, const ReplayControl& replay)
      : scene_(scene), live_(live), replay_(replay) {}
  void clear();
  /// Once a picture: an event's words are made once, when it comes.
  void update();
  std::span<const TimelineMark> all() const { return marks_; }

 private:
  const ShownCase& scene_;
  const LiveControl& live_;
  const ReplayControl& replay_;
  std::vector<TimelineMark> marks_;
  std::size_t told_ = 0;             ///< events that `marks_` has seen
  const Case* told_case_ = nullptr;  ///< whose they are
};

}  // namespace osteon
