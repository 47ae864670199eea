#include "causality.h"

#include <algorithm>

namespace osteon {
namespace {

constexpr const char* kDamaged = "The file is damaged: use another copy of it";

tl::unexpected<Error> out_of_range(const std::string& kind, std::uint64_t number,
                                   const char* consumed, std::uint64_t index) {
  return fail(kind + " " + std::to_string(number) + " claims to have used " + consumed + " " +
                  std::to_string(index) + ", which is not possible",
              {}, kDamaged);
}

tl::unexpected<Error> out_of_turn(const std::string& kind, std::uint64_t number,
                                  std::uint64_t due) {
  return fail(
      kind + " " + std::to_string(number) + " stands where " + std::to_string(due) + " is due", {},
      kDamaged);
}

std::uint64_t ticks_of(const Recording& recording, std::size_t hand) {
  return hand < recording.hands() ? recording.ticks_of(hand).size() : 0;
}

std::string tick_of(const Recording& recording, std::size_t hand) {
  return recording.hands() == 1 ? "tick" : "hand " + std::to_string(hand + 1) + ", tick";
}

Result<void> check_steps(const Recording& recording) {
  std::array<std::uint64_t, kMaxHands> before{};
  std::uint64_t due = 0;
  for (const StepRecord& step : recording.steps) {
    if (step.step != ++due) return out_of_turn("step", step.step, due);
    for (std::size_t h = 0; h < kMaxHands; ++h) {
      const std::uint64_t tick = step.tool_ticks[h];
      if (tick < before[h] || tick > ticks_of(recording, h))
        return out_of_range("step", step.step, "tick", tick);
      before[h] = tick;
    }
  }
  return {};
}

Result<void> check_ticks(const Recording& recording, std::size_t hand) {
  std::uint64_t before = 0;
  std::array<std::uint64_t, kMaxHands> others_before{};
  std::uint64_t due = 0;
  for (const TickRecord& tick : recording.ticks_of(hand)) {
    const std::string name = tick_of(recording, hand);
    if (tick.tick != ++due) return out_of_turn(name, tick.tick, due);
    const std::uint64_t s = tick.bone_step;
    if (s < before || s > recording.steps.size()) return out_of_range(name, tick.tick, "step", s);
    if (s > 0 && recording.steps[s - 1].tool_ticks[hand] >= tick.tick)
      return out_of_range(name, tick.tick, "step", s);
    before = s;
    for (std::size_t h = 0; h < kMaxHands; ++h) {
      const std::uint64_t other = tick.other_ticks[h];
      if (other < others_before[h] || other > ticks_of(recording, h) || (h == hand && other != 0))
        return out_of_range(name, tick.tick, "another hand's tick", other);
      others_before[h] = other;
    }
  }
  return {};
}

// Cuts a list where `lost` is first true. Whether it cut anything.
template <class List, class Lost>
bool cut(List& list, const Lost& lost) {
  const auto first = std::find_if(list.begin(), list.end(), lost);
  if (first == list.end()) return false;
  list.erase(first, list.end());
  return true;
}

}  // namespace

// What one loses may be what another consumed; each round makes some list shorter, so it ends.
void trim_to_saved(Recording& recording) {
  const auto no_tick = [&](const auto& ticks) {
    for (std::size_t h = 0; h < kMaxHands; ++h)
      if (ticks[h] > ticks_of(recording, h)) return true;
    return false;
  };
  const auto lost_tick = [&](const TickRecord& t) {
    return t.bone_step > recording.steps.size() || no_tick(t.other_ticks);
  };
  const auto lost_step = [&](const StepRecord& s) { return no_tick(s.tool_ticks); };
  for (bool changed = true; changed;) {
    changed = cut(recording.steps, lost_step);
    for (std::size_t h = 0; h < recording.hands(); ++h)
      changed = cut(recording.ticks_of(h), lost_tick) || changed;
  }
  std::erase_if(recording.states, [&](const StoredState& s) {
    return s.step > recording.steps.size() || no_tick(s.ticks);
  });
}

Result<void> check_consumption(const Recording& recording) {
  if (const auto sound = check_steps(recording); !sound) return sound;
  for (std::size_t h = 0; h < recording.hands(); ++h)
    if (const auto sound = check_ticks(recording, h); !sound) return sound;
  return {};
}

}  // namespace osteon
