#pragma once

#include <array>

#include "osteon/base/random.h"
#include "session_fixtures.h"

namespace osteon::testing {

inline SessionSettings two_hands() {
  SessionSettings settings = moving_bones();
  settings.hands = {{"left", 0}, {"right", 0}};
  return settings;
}

/// Probes of three thicknesses.
inline Tray three_probes() {
  Tray tray;
  for (const double radius_m : {0.00075, 0.001, 0.0015})
    tray.push_back(std::make_shared<const Tool>(make_wrist_probe(radius_m)));
  return tray;
}

inline SessionSettings with_three_probes() {
  SessionSettings settings = two_hands();
  settings.tray = {"thin", "middle", "thick"};
  return settings;
}

/// Two hands that wander over the boxes and press on them, with marks, restores, exchanges and
/// changes of power at random. A function of the seed.
class HandsAtRandom {
 public:
  explicit HandsAtRandom(std::uint64_t seed) : random_(seed) {
    for (Vec3& phase : phases_)
      for (int i = 0; i < 3; ++i) phase[i] = random_.uniform(0, 6);
  }
  /// Ticks come in order.
  std::array<HandInput, 2> at(std::uint64_t n) {
    const double t = static_cast<double>(n) * 0.001;
    std::array<HandInput, 2> hands;
    for (std::size_t h = 0; h < 2; ++h) {
      const Vec3& phase = phases_[h];
      hands[h].input.X_WD.p = {0.012 + 0.016 * std::sin(1.3 * t + phase.x()),
                               0.004 * std::sin(2.1 * t + phase.y()),
                               0.0065 + 0.0035 * std::sin(3.7 * t + phase.z())};
      hands[h].input.X_WD.q = Quat(1, 0.1 * std::sin(t + phase.x()), 0.05, 0).normalized();
      hands[h].input.v_W = {0.02 * std::cos(1.3 * t + phase.x()), 0, 0};
    }
    add_command(hands);
    return hands;
  }

 private:
  void add_command(std::array<HandInput, 2>& hands) {
    const double draw = random_.uniform();
    const double which = random_.uniform();
    if (draw < 0.004) {
      const Command mark{CommandKind::kMark, std::floor(4 * which)};
      hands[0].command = hands[1].command = mark;
    } else if (draw < 0.008) {
      const Command back{CommandKind::kRestore, std::floor(4 * which)};
      hands[0].command = hands[1].command = back;
    } else if (draw < 0.012) {
      hands[which < 0.5 ? 0 : 1].command = {CommandKind::kTake, std::floor(6 * which) / 2};
    } else if (draw < 0.016) {
      hands[which < 0.5 ? 0 : 1].command = {CommandKind::kPower, which};
    }
  }

  Random random_;
  std::array<Vec3, 2> phases_;
};

inline Recording record_hands(const std::shared_ptr<const Case>& the_case, std::uint64_t seed,
                              std::uint64_t ticks, std::uint64_t* final_hash = nullptr,
                              std::uint64_t state_every = 0) {
  Session session(the_case, two_hands());
  HandsAtRandom hands(seed);
  Recording recording;
  recording.header = recording_header(*the_case, two_hands(), "test", "0");
  recording.more_hands.resize(1);
  for (std::uint64_t n = 1; n <= ticks; ++n) {
    (void)session.tick(hands.at(n));
    for (std::size_t h = 0; h < 2; ++h) {
      recording.ticks_of(h).push_back(session.last_tick_record(h));
      for (const Event& event : session.last_events(h)) recording.events.push_back(event);
    }
    if (session.last_steps() > 0) recording.steps.push_back(session.last_step_record());
    if (state_every > 0 && n % state_every == 0)
      recording.states.push_back({{n, n, 0, 0}, session.bones().step, to_bytes(session.save())});
  }
  recording.complete = true;
  if (final_hash) *final_hash = session.state_hash();
  return recording;
}

}  // namespace osteon::testing
