#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "osteon/record/recording.h"
#include "osteon/session/session.h"

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
    if (!into) return;
    into->ticks.push_back(session.last_tick_record());
    if (session.last_steps() > 0) into->steps.push_back(session.last_step_record());
    if (store_every > 0 && session.tool_state().tick % store_every == 0) store();
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

 private:
  void store() {
    StoredState state;
    state.ticks[0] = session.tool_state().tick;
    state.step = session.bones().step;
    state.bytes = to_bytes(session.save());
    into->states.push_back(state);
  }
};

/// A tool's pose by its y and z in World.
inline Quat posed(const Vec3& y_W, const Vec3& z_W) {
  return Quat((Mat3() << y_W.cross(z_W), y_W, z_W).finished());
}

}  // namespace osteon::testing
