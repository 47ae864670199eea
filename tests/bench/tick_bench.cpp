// The whole haptic tick over fifteen bones: in free air, pressing, and sliding. With OSTEON_SHARED
// set: the wrist's own bones (convex hulls, as a case holds them); else fifteen ellipsoids of 600
// corners in the same places.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "osteon/base/clock.h"
#include "osteon/base/percentiles.h"
#include "osteon/haptic/haptic.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/mesh_io.h"
#include "osteon/mesh/repair.h"
#include "osteon/scene/build_case.h"

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

// Empty when the shared folder is not there.
CaseDef wrist_def() {
  CaseDef def;
  def.name = "wrist";
  const char* shared = std::getenv("OSTEON_SHARED");
  if (!shared) return def;
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(shared) / "anatomy" / "wrist"))
    if (entry.path().extension() == ".stl") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  constexpr double kMetresPerUnit = 1;
  for (const auto& file : files) {
    auto mesh = load_mesh(file, kMetresPerUnit);
    if (!mesh) throw std::runtime_error(mesh.error().message());
    repair(*mesh);
    BoneDef bone;
    bone.name = canonical_bone_name(file.stem().string());
    bone.mesh = std::move(*mesh);
    def.bones.push_back(std::move(bone));
  }
  return def;
}

std::shared_ptr<const Case> bench_case() {
  static const std::shared_ptr<const Case> the_case = [] {
    CaseDef def = wrist_def();
    if (def.bones.empty()) def = ellipsoid_def();
    auto built = build_case(std::move(def));
    if (!built) throw std::runtime_error(built.error().message());
    return std::make_shared<const Case>(std::move(*built));
  }();
  return the_case;
}

// Straight down onto the bone in the middle of the case.
struct Approach {
  Vec3 above;
  Vec3 surface;  // where the tip touches first
};

Approach find_approach(HapticLoop& loop, const BoneSnapshot& bones, const HapticParams& params) {
  const Aabb box = bench_case()->bounds_W();
  Vec3 best = box.center();
  double nearest = 1e300;
  for (const Bone& bone : bench_case()->bones) {
    const Vec3 center = bone.X_WB * bounds(bone.mesh).center();
    if ((center - box.center()).norm() < nearest) {
      nearest = (center - box.center()).norm();
      best = center;
    }
  }
  Approach out;
  out.above = Vec3(best.x(), best.y(), box.hi.z() + 0.005);
  for (double z = out.above.z(); z > box.lo.z(); z -= 5e-5) {
    ToolInput input;
    input.X_WD.p = Vec3(best.x(), best.y(), z);
    if (loop.tick(input, bones, 0, params).contact_count > 0) {
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

void run(benchmark::State& state, Motion motion) {
  HapticLoop loop(bench_case(), std::make_shared<const Tool>(make_wrist_probe()));
  const BoneSnapshot bones = rest_snapshot(*bench_case());
  HapticParams params;
  const Approach at = find_approach(loop, bones, params);
  if (motion == kFree) {
    ToolInput input;
    for (int i = 0; i < 5; ++i) {
      input.X_WD.p = at.above;
      loop.tick(input, bones, 0, params);
    }
  }
  Percentiles times;
  std::int64_t i = 0;
  std::int64_t contacts = 0;
  for (auto _ : state) {
    ToolInput input;
    input.X_WD.p = hand_at(motion, at, i++);
    const std::int64_t start = steady_now_ns();
    const ToolState& s = loop.tick(input, bones, 0, params);
    times.add_ns(steady_now_ns() - start);
    contacts += s.contact_count > 0;
  }
  state.counters["p50_us"] = 1e-3 * times.quantile_ns(0.5);
  state.counters["p99_us"] = 1e-3 * times.quantile_ns(0.99);
  state.counters["p999_us"] = 1e-3 * times.quantile_ns(0.999);
  state.counters["in_contact"] = static_cast<double>(contacts) / static_cast<double>(i);
  state.SetLabel(bench_case()->name);
}

void tick_free(benchmark::State& state) { run(state, kFree); }
void tick_press(benchmark::State& state) { run(state, kPress); }
void tick_slide(benchmark::State& state) { run(state, kSlide); }

BENCHMARK(tick_free);
BENCHMARK(tick_press);
BENCHMARK(tick_slide);

}  // namespace
