#pragma once

#include <cstdint>
#include <vector>

#include "osteon/scene/case.h"
#include "osteon/scene/event.h"
#include "osteon/scene/state.h"

namespace osteon {

/// What a tool's events are measured against.
struct ToolEventLimits {
  std::vector<double> force_n;   ///< one pair of force_over and force_under for each
  double slide_force_n = 1e300;  ///< sliding counts as a scratch above it
  double slide_mm = 0.5;         ///< shorter ones are no event
};

/// Makes events of contact, force, scratches and impacts of one hand from its tool's states, one a
/// tick. A function of the states: a replay makes the same ones. Keeps a reference to nothing.
class ToolEvents {
 public:
  ToolEvents(std::size_t bones, ToolEventLimits limits, std::uint8_t hand = 0,
             double tick_s = 0.001);
  /// Adds the tick's events to `out`.
  void add(const ToolState& tool, std::vector<Event>& out);
  /// Ends what is still going on at the last tick.
  void finish(std::vector<Event>& out);

 private:
  struct Touch {
    std::uint64_t begun = 0;  // 0: none
    double force_n = 0, peak_n = 0, deepest_m = 0;
    Vec3 p_W = Vec3::Zero();
    std::vector<std::uint64_t> over;  // since when, by limit; 0: not over
    std::vector<double> over_peak_n;
    std::uint64_t sliding = 0;
    Vec3 slide_from_W = Vec3::Zero();
    double slid_m = 0, slide_peak_n = 0;
  };
  Event event(EventKind kind, std::size_t bone, std::array<double, 3> values) const;
  double seconds_since(std::uint64_t tick) const;
  void gather(const ToolState& tool);
  void begin_touch(std::size_t bone, double speed_m_s, std::vector<Event>& out);
  void end_touch(std::size_t bone, std::vector<Event>& out);
  void watch_force(std::size_t bone, std::vector<Event>& out);
  void watch_slide(std::size_t bone, std::vector<Event>& out);
  void end_slide(std::size_t bone, std::vector<Event>& out);

  ToolEventLimits limits_;
  std::uint8_t hand_;
  double tick_s_;
  std::uint64_t tick_ = 0;
  std::vector<Touch> touches_;
  std::vector<Vec3> forces_, normals_;  // of this tick, by bone
  std::vector<double> depths_;
  std::vector<Vec3> places_;
  std::vector<char> touched_;
  bool seen_ = false;
  Vec3 last_hand_W_ = Vec3::Zero();
};

}  // namespace osteon
