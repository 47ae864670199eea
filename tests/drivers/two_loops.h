#pragma once

#include <array>
#include <memory>

#include "drivers/run_loop.h"

namespace osteon::testing {

/// Two devices in one world, each with its own loop, mapping and gate, in one thread and without a
/// clock.
struct TwoLoops {
  /// `tray`: what the left and the right hand hold; empty: two probes.
  TwoLoops(std::shared_ptr<const Case> the_case, SessionSettings settings, HapticDevice& left,
           HapticDevice& right, Tray tray = {})
      : session(std::move(the_case), of_two(std::move(settings), tray.size()), tray),
        left_exchange(session.bones()),
        right_exchange(session.bones()),
        left_hand(session, left, options(0, right_exchange), left_exchange, nullptr),
        right_hand(session, right, options(1, left_exchange), right_exchange, nullptr),
        physics(session, std::array<LoopExchange* const, 2>{&left_exchange, &right_exchange},
                nullptr) {
    for (std::size_t hand = 0; hand < 2; ++hand) enable(hand);
  }
  void enable(std::size_t hand) { exchange(hand).to_gate.push(GateWish::kEnable); }
  LoopExchange& exchange(std::size_t hand) { return hand == 0 ? left_exchange : right_exchange; }
  void tick() {
    left_hand.step();
    right_hand.step();
    if (++ticks_ % RunLoop::ticks_a_step() == 0) physics.step();
  }
  ForceOff cause(std::size_t hand) { return exchange(hand).device_status.read().cause; }

  Session session;
  LoopExchange left_exchange, right_exchange;
  HapticStage left_hand, right_hand;
  PhysicsStage physics;

 private:
  static SessionSettings of_two(SessionSettings settings, std::size_t tools) {
    settings.hands = {{"left", 0}, {"right", tools > 1 ? 1u : 0u}};
    if (tools > 1) settings.tray = {"left's", "right's"};
    return settings;
  }
  static HapticStageOptions options(std::size_t hand, LoopExchange& other) {
    HapticStageOptions o = RunLoop::options(turned_mapping(), true);
    o.hand = hand;
    o.others[1 - hand] = &other;
    return o;
  }
  std::uint64_t ticks_ = 0;
};

}  // namespace osteon::testing
