#pragma once

// Skin that one hand cuts and holds open with a retractor, and another hand works in.
#include <algorithm>
#include <array>
#include <vector>

#include "osteon/scene/instrument.h"
#include "skin_fixtures.h"

namespace osteon::testing {

inline constexpr std::uint32_t kRetractor = 5;
inline constexpr double kRetractorHalf_m = 0.005, kSlitHalf_m = 0.010, kDeep_m = 0.012;

struct WoundRun : SkinRun {
  WoundRun() {
    const auto instruments = load_instruments();
    EXPECT_TRUE(instruments);
    const Instrument* found = find_instrument(*instruments, "malleable_retractor");
    settings.tray.emplace_back("malleable_retractor:10");
    tray.push_back(std::make_shared<const Tool>(make_tool(*found, 0)));
    settings.hands = {{"right", kSkinBlade}, {"left", kSkinBall}};
    SoftSetup setup(*softs);
    setup.skin_tools.push_back(skin_tool(*tray.back(), false));
    setup.skin_tools.back().retracts = true;
    let_wounds_be_held_open(setup);
    settings.soft_hash = setup.hash;
    softs = std::make_shared<const SoftSetup>(std::move(setup));
  }
};

// One for all tests.
inline const WoundRun& wound_run() {
  static const WoundRun run;
  return run;
}

/// Two hands, both tools upright: the right one cuts along x and takes the retractor.
struct TwoInSkin {
  explicit TwoInSkin(Session& s) : session(s) {
    at[0] = {-kSlitHalf_m, 0, 0.010};
    at[1] = {0.012, -0.012, 0.030};
  }
  Session& session;
  std::array<Vec3, 2> at;
  std::vector<Event> events;
  Recording* into = nullptr;
  double steepest_n = 0, most_n = 0;  ///< of the right hand, in a tick
  Vec3 before = Vec3::Zero();

  void tick(const std::array<Command, 2>& commands = {}) {
    std::array<HandInput, 2> in;
    for (std::size_t h = 0; h < 2; ++h) {
      in[h].input.X_WD = {at[h], Quat::Identity()};
      in[h].command = commands[h];
    }
    (void)session.tick(in);
    for (std::size_t h = 0; h < 2; ++h)
      for (const Event& event : session.last_events(h)) events.push_back(event);
    steepest_n = std::max(steepest_n, (force(0) - before).norm());
    before = force(0);
    most_n = std::max(most_n, force(0).norm());
    if (into) keep();
  }
  void keep() {
    for (std::size_t h = 0; h < 2; ++h) {
      into->ticks_of(h).push_back(session.last_tick_record(h));
      for (const Event& event : session.last_events(h)) into->events.push_back(event);
    }
    if (session.last_steps() > 0) into->steps.push_back(session.last_step_record());
    const std::uint64_t n = session.tool_state(0).tick;
    if (n % 250 == 0)
      into->states.push_back({{n, n, 0, 0}, session.bones().step, to_bytes(session.save())});
  }
  Vec3 force(std::size_t hand) const { return session.tool_state(hand).force_W; }
  SkinReadout readout() const { return session.softs()->skin_readout(0); }
  void move(std::size_t hand, const Vec3& to, int ticks) {
    const Vec3 from = at[hand];
    for (int n = 1; n <= ticks; ++n) {
      at[hand] = from + n / static_cast<double>(ticks) * (to - from);
      tick();
    }
  }
  void rest(int ticks) {
    for (int n = 0; n < ticks; ++n) tick();
  }
  void take(std::size_t hand, std::uint32_t instrument) {
    std::array<Command, 2> commands{};
    commands[hand] = {CommandKind::kTake, static_cast<double>(instrument)};
    tick(commands);
    rest(40);
  }
  void cut() {
    move(0, {-kSlitHalf_m, 0, -0.008}, 300);
    move(0, {kSlitHalf_m, 0, -0.008}, 500);
    move(0, {kSlitHalf_m, 0, 0.030}, 200);
    rest(600);  // the lips' stiffness is worked out
    take(0, kRetractor);
    move(0, {0, 0, 0.010}, 100);
  }
  void set_in() { move(0, {0, 0, -kDeep_m}, 400); }
  std::size_t count(EventKind kind, std::size_t hand) const {
    return static_cast<std::size_t>(std::count_if(
        events.begin(), events.end(),
        [&](const Event& event) { return event.kind == kind && event.hand == hand; }));
  }
};

}  // namespace osteon::testing
