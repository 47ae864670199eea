// What a session's loops take while a burr of 4 mm and a drill of 3.2 mm remove bone: a block of
// 30 mm that is felt as a field, at cells of 0.25 mm. The burr goes to and fro over the upper face
// at 20 mm/s and is pressed deeper on the way; the drill is pressed straight down. And while a
// reamer of 11 mm goes 350 mm down into a shaft of 28 mm, at the cells of 0.5 mm of a long bone.
// One thread runs the haptic tick, every second tick a step of physics and every 17th a picture's
// surface.
//   tick_*, step_*     the haptic tick and the step of physics, us of this thread's computing
//   own_*              the same session is run several times over, the least of each counts:
//                      interrupts and other programs' use of the caches fall away
//   picture_*_ms       what a picture needs anew of the carved bone's surface
//   longest_*_ms       the longest of all: a stall would show here
//   removed_mm3        in all; equal in each run
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "carve/carve_fixtures.h"
#include "haptic/cpu_clock.h"
#include "osteon/base/percentiles.h"
#include "osteon/carve/removed.h"
#include "osteon/physics/carving.h"
#include "osteon/scene/build_case.h"
#include "osteon/scene/instrument.h"
#include "osteon/scene/tool_set.h"
#include "osteon/session/session.h"
#include "runs/pictures/carved_picture.h"

namespace {

using namespace osteon;
using test::value;

constexpr double kHalf_m = 0.015, kHalfShaft_m = 0.18;
constexpr std::uint64_t kTicksOfPicture = 17;

/// A block, a tray of one instrument, and what it may remove.
struct Work {
  std::shared_ptr<const Case> the_case;
  SessionSettings settings;
  Tray tray;
  std::shared_ptr<const CarvingSetup> setup;
};

using HandAt = Vec3 (*)(std::uint64_t tick);

/// How the instrument is moved, and for how long.
struct Course {
  HandAt at;
  std::uint64_t ticks;
  int passes = 5;  ///< of which the least cost counts
};

std::shared_ptr<const Case> felt_block(const Vec3& half) {
  CaseDef def;
  def.name = "block";
  BoneDef bone;
  bone.name = "block";
  bone.mesh = test::box_mesh(half);
  bone.felt = Felt::kField;
  def.bones.push_back(std::move(bone));
  return std::make_shared<const Case>(value(build_case(std::move(def))));
}

Work work_of(const std::string& instrument, const Vec3& half, double cell_m) {
  Work work;
  work.the_case = felt_block(half);
  work.settings.carve.cell_m = cell_m;
  if (instrument.starts_with("reamer")) work.settings.carve.thrust_scale = 80;  // a whole arm's
  work.settings.carve.on = true;
  work.settings.haptic.max_force_n = 8;
  work.settings.tray.push_back(instrument);
  const auto all = value(load_instruments());
  const auto name = value(parse_tool_name(instrument));
  const Instrument* found = find_instrument(all, name.name);
  if (found == nullptr) throw std::runtime_error("there is no " + instrument);
  const auto size = find_size(*found, name.size_mm.value());
  work.tray.push_back(std::make_shared<const Tool>(make_tool(*found, size.value())));
  work.setup = value(make_carving(*work.the_case, work.settings.tray, work.settings.carve));
  return work;
}

// The ball's middle: down onto the face within half a second, then 0.4 mm/s deeper. A hand that
// begins in bone would feel nothing there.
Vec3 burring(std::uint64_t tick) {
  const double t = 0.001 * static_cast<double>(tick);
  const double way = std::fmod(0.020 * t, 0.040);
  const double x = -0.010 + (way < 0.020 ? way : 0.040 - way);
  const double above = t < 0.5 ? 0.003 - 0.003 * t : 0.0015 - 0.0004 * (t - 0.5);
  return {x, 0.002 * std::sin(t), kHalf_m + above};
}

Vec3 drilling(std::uint64_t tick) {
  const double t = 0.001 * static_cast<double>(tick);
  return {0.0003, 0.0002, std::max(kHalf_m + 0.001 - 0.002 * t, -kHalf_m)};
}

// 8 mm/s, faster than the reamer goes: it is pressed all the way.
Vec3 reaming(std::uint64_t tick) {
  const double t = 0.001 * static_cast<double>(tick);
  return {0.0003, 0.0002, std::max(kHalfShaft_m + 0.002 - 0.008 * t, 0.010 - kHalfShaft_m)};
}

/// Of each tick, step and picture of one run.
struct Costs {
  std::vector<std::int64_t> ticks, steps, pictures;
  double removed_mm3 = 0;
};

template <class Job>
void cost_of(std::vector<std::int64_t>& into, const Job& job) {
  const std::int64_t before = test::cpu_now_ns();
  job();
  into.push_back(test::cpu_now_ns() - before);
}

Costs run_once(const Work& work, const Course& course) {
  Session session(work.the_case, work.settings, work.tray, work.setup);
  CarvedPicture picture(work.setup);
  const auto ticks_per_step = static_cast<std::uint64_t>(
      std::lround(work.settings.physics.step_s / work.settings.haptic.tick_s));
  Costs costs;
  BoneSnapshot bones = session.bones();
  ToolInput input;
  for (std::uint64_t n = 0; n < course.ticks; ++n) {
    input.X_WD.p = course.at(n);
    const Command power = n == 2 ? Command{CommandKind::kPower, 1} : Command{};
    cost_of(costs.ticks, [&] { session.haptic_tick(input, bones, power); });
    if ((n + 1) % ticks_per_step == 0) {
      cost_of(costs.steps, [&] {
        bones = session.physics_step(session.tool_state());
        session.catch_up();
      });
    }
    if ((n + 1) % kTicksOfPicture != 0) continue;
    cost_of(costs.pictures, [&] {
      CutsPatch patch;
      while (session.cuts_feed()->take(patch)) picture.take(patch);
      benchmark::DoNotOptimize(picture.changes());
    });
  }
  costs.removed_mm3 = 1e9 * total(removed_volume(*session.carving()->field(0)));
  return costs;
}

void keep_least(std::vector<std::int64_t>& least, const std::vector<std::int64_t>& other) {
  for (std::size_t n = 0; n < least.size(); ++n) least[n] = std::min(least[n], other[n]);
}

Percentiles percentiles(const std::vector<std::int64_t>& all_ns) {
  Percentiles out;
  for (const std::int64_t ns : all_ns) out.add_ns(ns);
  return out;
}

void tell_us(benchmark::State& state, const std::string& what,
             const std::vector<std::int64_t>& all) {
  const Percentiles of = percentiles(all);
  state.counters[what + "_p50_us"] = 1e-3 * of.quantile_ns(0.5);
  state.counters[what + "_p99_us"] = 1e-3 * of.quantile_ns(0.99);
  state.counters[what + "_p999_us"] = 1e-3 * of.quantile_ns(0.999);
}

void tell_longest(benchmark::State& state, const std::string& what,
                  const std::vector<std::int64_t>& all) {
  state.counters["longest_" + what + "_ms"] = 1e-6 * percentiles(all).max_ns();
}

void run(benchmark::State& state, const Work& work, const Course& course, double least_mm3) {
  Costs first, least;
  for (auto _ : state) {
    first = least = run_once(work, course);
    for (int pass = 1; pass < course.passes; ++pass) {
      const Costs again = run_once(work, course);
      if (again.removed_mm3 != first.removed_mm3) state.SkipWithError("two runs differ");
      keep_least(least.ticks, again.ticks);
      keep_least(least.steps, again.steps);
      keep_least(least.pictures, again.pictures);
    }
  }
  if (!(first.removed_mm3 > least_mm3)) {
    const std::string so_little = std::to_string(first.removed_mm3) + " mm3 were removed";
    state.SkipWithError(so_little.c_str());
  }
  tell_us(state, "tick", first.ticks);
  tell_us(state, "own_tick", least.ticks);
  tell_us(state, "step", first.steps);
  tell_us(state, "own_step", least.steps);
  tell_longest(state, "tick", first.ticks);
  tell_longest(state, "step", first.steps);
  tell_longest(state, "picture", first.pictures);
  const Percentiles pictures = percentiles(least.pictures);
  state.counters["picture_p50_ms"] = 1e-6 * pictures.quantile_ns(0.5);
  state.counters["picture_max_ms"] = 1e-6 * pictures.max_ns();
  state.counters["removed_mm3"] = first.removed_mm3;
}

void carve_tick_burr(benchmark::State& state) {
  run(state, work_of("microdrill:4", Vec3::Constant(kHalf_m), 0.00025), {burring, 12000}, 500);
}
void carve_tick_drill(benchmark::State& state) {
  run(state, work_of("drill:3.2", Vec3::Constant(kHalf_m), 0.00025), {drilling, 12000}, 100);
}
void carve_tick_reamer(benchmark::State& state) {
  run(state, work_of("reamer:11", Vec3(0.014, 0.014, kHalfShaft_m), 0.0005), {reaming, 230000, 2},
      30000);
}

BENCHMARK(carve_tick_burr)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(carve_tick_drill)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(carve_tick_reamer)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
