#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "recorded_run.h"

namespace osteon::testing {

/// The only hand of a session, led tick by tick: keeps the events and, where asked, a recording.
struct DrivenHand {
  DrivenHand(Session& s, const Vec3& from, const Quat& pose = Quat::Identity())
      : session(s), at(from), q(pose) {}
  Session& session;
  Vec3 at;
  Quat q;
  std::vector<Event> events;
  Recording* into = nullptr;
  std::uint64_t store_every = 0;  ///< ticks from one stored state to the next; 0: none

  void tick(const Command& command = {}) {
    ToolInput input;
    input.X_WD = {at, q};
    (void)session.tick(input, command);
    for (const Event& event : session.last_events()) events.push_back(event);
    if (into) keep_tick(*into, session, store_every);
  }
  void take(std::uint32_t instrument) {
    tick({CommandKind::kTake, static_cast<double>(instrument)});
  }
  void move(const Vec3& to, int ticks) {
    const Vec3 from = at;
    for (int n = 1; n <= ticks; ++n) {
      at = from + n / static_cast<double>(ticks) * (to - from);
      tick();
    }
  }
  void rest(int ticks) { move(Vec3(at), ticks); }
  std::size_t count(EventKind kind) const {
    return static_cast<std::size_t>(std::count_if(
        events.begin(), events.end(), [kind](const Event& event) { return event.kind == kind; }));
  }
};

/// A tool's pose by its y and z in World.
inline Quat posed(const Vec3& y_W, const Vec3& z_W) {
  return Quat((Mat3() << y_W.cross(z_W), y_W, z_W).finished());
}

}  // namespace osteon::testing
