#pragma once

#include <cstdint>
#include <vector>

#include "osteon/scene/case.h"
#include "osteon/scene/event.h"
#include "osteon/scene/state.h"

namespace osteon {

/// Bone has been removed: {share of the part that shall go, 0 to 1; share of the rest; how far
/// beyond that part, mm}, of the bone. The session makes none of them.
inline constexpr EventKind kCutSeen{408};

/// The part of a bone that shall be removed: what lies near a line over it.
struct CutPart {
  std::uint32_t bone = 0;
  std::vector<Vec3> line_W;
  double within_m = 0.003;
};

/// What a ball that removes bone has taken away, in points a fixed distance apart. A proxy is kept
/// out of the bone that is left, so where its ball has been nothing is left: the ball's places
/// tell, 100 a second, as felt. A function of the tool's states: a replay finds the same. The bone
/// must rest.
class CutWatch {
 public:
  /// Volumes are reckoned from points so far apart.
  static constexpr double kApart_m = 0.0004;
  /// A ball that rests on the bone may come so much nearer without having cut.
  static constexpr double kTouch_m = 0.00005;

  CutWatch(const Case& the_case, const CutPart& part, double ball_radius_m, std::uint8_t hand,
           double tick_s);
  /// Adds an event when more is gone than before.
  void add(const ToolState& tool, std::vector<Event>& out);
  std::size_t points() const { return points_.size(); }

 private:
  struct Point {
    Vec3 p_W;
    double off_m = 0;  // beyond the part; 0 and less: within it
  };
  Event event(const ToolState& tool) const;

  std::vector<Point> points_;  // that are left
  std::size_t within_ = 0, beyond_ = 0, gone_within_ = 0, gone_beyond_ = 0;
  double farthest_m_ = 0, radius_m_;
  std::uint32_t bone_;
  std::uint8_t hand_;
  std::uint64_t stride_;
};

}  // namespace osteon
