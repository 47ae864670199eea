// The whole haptic tick over fifteen bones: in free air, pressing, sliding, and two tools that
// slide at once; the same with tips alone and with whole instruments. With OSTEON_SHARED set: the
// wrist's own bones in pieces, as a case holds them; else fifteen ellipsoids of 600 corners in the
// same places. And over the built-in knee, as the program opens it: a probe on the patella and a
// scope on the femur beside it.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "cases/open_case.h"
#include "haptic/cpu_clock.h"
#include "osteon/base/percentiles.h"
#include "osteon/haptic/haptic.h"
#include "osteon/haptic/haptic_state.h"
#include "osteon/mesh/measure.h"
#include "osteon/scene/build_case.h"
#include "osteon/scene/instrument.h"
#include "wrist_case.h"

namespace {

using namespace osteon;

// Corners of Fibonacci's lattice on an ellipsoid, joined as a hull.
TriMesh ellipsoid(const Vec3& half) {
  constexpr int kCorners = 600;
  std::vector<Vec3> points;
  for (int i = 0; i < kCorners; ++i) {
    const double z = 1 - (2 * i + 1) / static_cast<double>(kCorners);
    const double a = 2.399963229728653 * i;
    const double r = std::sqrt(1 - z * z);
    points.push_back(half.cwiseProduct(Vec3(r * std::cos(a), r * std::sin(a), z)));
  }
  return to_mesh(build_hull(points).hull.value());
}

CaseDef ellipsoid_def() {
  CaseDef def;
  def.name = "ellipsoids";
  for (int i = 0; i < 15; ++i) {
    BoneDef bone;
    bone.name = "bone_" + std::to_string(i);
    bone.X_WB.p = Vec3(0.017 * (i % 5), 0.017 * (i / 5), 0);
    bone.mesh = ellipsoid(Vec3(0.008, 0.008, 0.006));
    def.bones.push_back(std::move(bone));
  }
  return def;
}

std::shared_ptr<const Case> bench_case() {
  static const std::shared_ptr<const Case> the_case = [] {
    CaseDef def = bench::wrist_def();
    if (def.bones.empty()) def = ellipsoid_def();
    return bench::built(std::move(def));
  }();
  return the_case;
}

// Where the tools come down: in the middle of the wrist, or of the ellipsoids.
constexpr std::array<std::array<const char*, 2>, 2> kTargets{
    {{"capitate", "bone_7"}, {"scaphoid", "bone_8"}}};

// What the bones are, and over what the hands stand.
struct Place {
  std::shared_ptr<const Case> the_case;
  std::array<Vec3, 2> over_W;
  std::array<const char*, 2> instruments;
};

Vec3 middle_of(const Case& the_case, std::span<const char* const> names) {
  for (const Bone& bone : the_case.bones)
    for (const char* name : names)
      if (bone.name == name) return bone.X_WB * bounds(bone.mesh).center();
  return the_case.bounds_W().center();
}

Place wrist_place() {
  const Case& wrist = *bench_case();
  return {bench_case(),
          {middle_of(wrist, kTargets[0]), middle_of(wrist, kTargets[1])},
          {"wrist_hook_probe", "wrist_arthroscope_2_7"}};
}

Place knee_place() {
  static const std::shared_ptr<const Case> knee = [] {
    auto opened = open_case("builtin:knee");
    if (!opened) throw std::runtime_error(opened.error().message());
    return *opened;
  }();
  constexpr std::array<const char*, 1> kPatella{"patella"};
  const Vec3 patella = middle_of(*knee, kPatella);
  return {knee, {patella, patella + Vec3(0.025, 0, 0)}, {"hook_probe", "arthroscope_30"}};
}

// Straight down onto a bone.
struct Approach {
  Vec3 above;
  Vec3 surface;  // where the tip touches first
};

Approach find_approach(HapticLoop& loop, const Case& the_case, const Vec3& over_W) {
  const BoneSnapshot bones = rest_snapshot(the_case);
  const Aabb box = the_case.bounds_W();
  Approach out;
  out.above = Vec3(over_W.x(), over_W.y(), box.hi.z() + 0.005);
  for (double z = out.above.z(); z > box.lo.z(); z -= 5e-5) {
    ToolInput input;
    input.X_WD.p = Vec3(over_W.x(), over_W.y(), z);
    if (loop.tick(input, bones, 0, HapticParams{}).contact_count > 0) {
      out.surface = input.X_WD.p;
      return out;
    }
  }
  throw std::runtime_error("nothing to touch in the case");
}

enum Motion { kFree, kPress, kSlide };

// Place of the hand in tick i, about the point of contact.
Vec3 hand_at(Motion motion, const Approach& at, std::int64_t i) {
  const double t = 0.001 * static_cast<double>(i);
  if (motion == kFree) return at.above + 0.002 * Vec3(std::sin(7 * t), std::cos(5 * t), 0);
  const Vec3 pressed = at.surface - Vec3(0, 0, 0.001);
  if (motion == kPress) return pressed + Vec3(0, 0, 2e-5 * std::sin(60 * t));
  return pressed + 0.002 * Vec3(std::sin(6 * t), std::sin(8.3 * t), 0);
}

// What the hands hold: the tip that is felt alone, or a probe and a scope with all their parts.
enum Held { kTips, kWhole };

Tool held_tool(const Place& place, Held held, std::size_t hand) {
  if (held == kTips) return make_wrist_probe();
  static const std::vector<Instrument> all = load_instruments().value();
  const Instrument* found = find_instrument(all, place.instruments[hand]);
  if (found == nullptr) throw std::runtime_error("the instruments lack a probe or a scope");
  return make_tool(*found, found->usual_size);
}

// A tool above its place on the bones, or on it.
struct Hand {
  HapticLoop loop;
  Approach at;

  Hand(const Place& place, Held held, std::size_t tool)
      : loop(place.the_case, std::make_shared<const Tool>(held_tool(place, held, tool))),
        at(find_approach(loop, *place.the_case, place.over_W[tool])) {}

  void lift(const BoneSnapshot& bones) {
    ToolInput input;
    input.X_WD.p = at.above;
    for (int i = 0; i < 5; ++i) loop.tick(input, bones, 0, HapticParams{});
  }
  bool tick(Motion motion, std::int64_t i, const BoneSnapshot& bones) {
    ToolInput input;
    input.X_WD.p = hand_at(motion, at, i);
    return loop.tick(input, bones, 0, HapticParams{}).contact_count > 0;
  }
};

std::vector<Hand> hands_for(const Place& place, Motion motion, Held held, std::size_t tools,
                            const BoneSnapshot& bones) {
  std::vector<Hand> hands;
  for (std::size_t k = 0; k < tools; ++k) hands.emplace_back(place, held, k);
  if (motion == kFree)
    for (Hand& hand : hands) hand.lift(bones);
  return hands;
}

// What a tick costs of itself: the same ticks several times over, the least of each. Interrupts and
// other programs' use of the caches fall away; what a tick has to do stays.
Percentiles own_cost(Motion motion, std::vector<Hand>& hands, const BoneSnapshot& bones) {
  constexpr std::int64_t kTicks = 20000;
  constexpr int kPasses = 7;
  std::vector<std::int64_t> least(kTicks, std::numeric_limits<std::int64_t>::max());
  std::vector<std::unique_ptr<HapticState>> start;
  for (const Hand& hand : hands) start.push_back(hand.loop.save());
  for (int pass = 0; pass < kPasses; ++pass) {
    for (std::size_t k = 0; k < hands.size(); ++k) hands[k].loop.restore(*start[k]);
    for (std::int64_t i = 0; i < kTicks; ++i) {
      const std::int64_t before = test::cpu_now_ns();
      for (Hand& hand : hands) hand.tick(motion, i, bones);
      auto& known = least[static_cast<std::size_t>(i)];
      known = std::min(known, test::cpu_now_ns() - before);
    }
  }
  Percentiles out;
  for (const std::int64_t ns : least) out.add_ns(ns);
  return out;
}

void run(benchmark::State& state, const Place& place, Motion motion, std::size_t tools,
         Held held = kTips) {
  const BoneSnapshot bones = rest_snapshot(*place.the_case);
  std::vector<Hand> hands = hands_for(place, motion, held, tools, bones);
  Percentiles times;
  std::int64_t i = 0;
  std::int64_t contacts = 0;
  for (auto _ : state) {
    const std::int64_t start = test::cpu_now_ns();
    for (Hand& hand : hands) contacts += hand.tick(motion, i, bones);
    times.add_ns(test::cpu_now_ns() - start);
    ++i;
  }
  std::vector<Hand> again = hands_for(place, motion, held, tools, bones);
  const Percentiles own = own_cost(motion, again, bones);
  state.counters["p50_us"] = 1e-3 * times.quantile_ns(0.5);
  state.counters["p99_us"] = 1e-3 * times.quantile_ns(0.99);
  state.counters["p999_us"] = 1e-3 * times.quantile_ns(0.999);
  state.counters["own_p50_us"] = 1e-3 * own.quantile_ns(0.5);
  state.counters["own_p99_us"] = 1e-3 * own.quantile_ns(0.99);
  state.counters["own_p999_us"] = 1e-3 * own.quantile_ns(0.999);
  state.counters["in_contact"] =
      static_cast<double>(contacts) / (static_cast<double>(i) * static_cast<double>(tools));
  state.SetLabel(place.the_case->name);
}

// The clock's share in the figures of the others.
void tick_of_nothing(benchmark::State& state) {
  Percentiles times;
  for (auto _ : state) {
    const std::int64_t start = test::cpu_now_ns();
    times.add_ns(test::cpu_now_ns() - start);
  }
  state.counters["p50_us"] = 1e-3 * times.quantile_ns(0.5);
  state.counters["p99_us"] = 1e-3 * times.quantile_ns(0.99);
  state.counters["p999_us"] = 1e-3 * times.quantile_ns(0.999);
}

// The machine's share: about as long as two whole instruments take, and the same work each time.
// What p99.9 has beyond p50 comes of interrupts.
void tick_of_arithmetic(benchmark::State& state) {
  Percentiles times;
  for (auto _ : state) {
    const std::int64_t start = test::cpu_now_ns();
    double x = 1;
    for (int k = 0; k < 2500; ++k) {
      x = x * 0.999 + 0.001;
      benchmark::DoNotOptimize(x);
    }
    times.add_ns(test::cpu_now_ns() - start);
  }
  state.counters["p50_us"] = 1e-3 * times.quantile_ns(0.5);
  state.counters["p99_us"] = 1e-3 * times.quantile_ns(0.99);
  state.counters["p999_us"] = 1e-3 * times.quantile_ns(0.999);
}

void tick_free(benchmark::State& state) { run(state, wrist_place(), kFree, 1); }
void tick_press(benchmark::State& state) { run(state, wrist_place(), kPress, 1); }
void tick_slide(benchmark::State& state) { run(state, wrist_place(), kSlide, 1); }
void tick_two_tools(benchmark::State& state) { run(state, wrist_place(), kSlide, 2); }
void tick_whole_free(benchmark::State& state) { run(state, wrist_place(), kFree, 1, kWhole); }
void tick_whole_slide(benchmark::State& state) { run(state, wrist_place(), kSlide, 1, kWhole); }
void tick_two_whole(benchmark::State& state) { run(state, wrist_place(), kSlide, 2, kWhole); }
void tick_knee_whole_slide(benchmark::State& state) { run(state, knee_place(), kSlide, 1, kWhole); }
void tick_knee_two_whole(benchmark::State& state) { run(state, knee_place(), kSlide, 2, kWhole); }

BENCHMARK(tick_of_nothing);
BENCHMARK(tick_of_arithmetic);
BENCHMARK(tick_free);
BENCHMARK(tick_press);
BENCHMARK(tick_slide);
BENCHMARK(tick_two_tools);
BENCHMARK(tick_whole_free);
BENCHMARK(tick_whole_slide);
BENCHMARK(tick_two_whole);
BENCHMARK(tick_knee_whole_slide);
BENCHMARK(tick_knee_two_whole);

}  // namespace
