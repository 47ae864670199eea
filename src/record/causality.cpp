#include "causality.h"

#include <algorithm>

namespace osteon {
namespace {

tl::unexpected<Error> out_of_range(const char* kind, std::uint64_t number, const char* consumed,
                                   std::uint64_t index) {
  return fail(std::string(kind) + " " + std::to_string(number) + " says that it consumed " +
                  consumed + " " + std::to_string(index) + ", which it cannot have",
              {}, "The file is damaged: use another copy of it");
}

tl::unexpected<Error> out_of_turn(const char* kind, std::uint64_t number, std::uint64_t due) {
  return fail(std::string(kind) + " " + std::to_string(number) + " stands where " +
                  std::to_string(due) + " is due",
              {}, "The file is damaged: use another copy of it");
}

Result<void> check_steps(const Recording& recording) {
  std::uint64_t before = 0;
  std::uint64_t due = 0;
  for (const StepRecord& step : recording.steps) {
    if (step.step != ++due) return out_of_turn("step", step.step, due);
    if (step.tool_tick < before || step.tool_tick > recording.ticks.size())
      return out_of_range("step", step.step, "tick", step.tool_tick);
    before = step.tool_tick;
  }
  return {};
}

}  // namespace

void trim_to_saved(Recording& recording) {
  auto& ticks = recording.ticks;
  auto& steps = recording.steps;
  const auto lost_step = [&](const TickRecord& t) { return t.bone_step > steps.size(); };
  ticks.erase(std::find_if(ticks.begin(), ticks.end(), lost_step), ticks.end());
  const auto lost_tick = [&](const StepRecord& s) { return s.tool_tick > ticks.size(); };
  steps.erase(std::find_if(steps.begin(), steps.end(), lost_tick), steps.end());
}

Result<void> check_consumption(const Recording& recording) {
  if (const auto sound = check_steps(recording); !sound) return sound;
  std::uint64_t before = 0;
  std::uint64_t due = 0;
  for (const TickRecord& tick : recording.ticks) {
    if (tick.tick != ++due) return out_of_turn("tick", tick.tick, due);
    const std::uint64_t s = tick.bone_step;
    if (s < before || s > recording.steps.size()) return out_of_range("tick", tick.tick, "step", s);
    if (s > 0 && recording.steps[s - 1].tool_tick >= tick.tick)
      return out_of_range("tick", tick.tick, "step", s);
    before = s;
  }
  return {};
}

}  // namespace osteon
