// What a step of carving costs, and the surface of what a picture's steps changed, beside OpenVDB's
// level sets (CSG and meshing) and plain deletion of voxels on the same cuts: a burr of 4 mm that
// goes 0.05 mm a step through a block of 30 mm at cells of 0.25 mm, in and out of a wavy line.
//   p50_us, p999_us   of the steps
//   cpu_p999_us, cpu_max_us   of the time that this thread's core worked on them: on a busy machine
//                             the rest is waiting for a core
//   blocks_*, taken_*         blocks that a step changed, and took from the pool: its work,
//   whatever
//                             the machine
//   removed_mm3       what was removed in all; of a voxel that is deleted, whole
// And a shaft of 28 mm reamed along 350 mm with 9, 11 and 13 mm, at 50 mm/s and the session's cells
// of 0.5 mm: 0.1 mm a step of physics, a picture every eighth.
//   step_ms, picture_ms   the longest step, the longest new surface for a picture; *_cpu_ms: of the
//                         time that this thread had a core
//   look_ms               the longest search for pieces that hang on nothing, every 64th step
//   bone_mb, cuts_mb      the bone's field; the pool of its cuts, of which used_mb hold some
#include <benchmark/benchmark.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "carve/carve_fixtures.h"
#include "osteon/base/clock.h"
#include "osteon/base/percentiles.h"
#include "osteon/carve/carved_surface.h"
#include "osteon/carve/loose_pieces.h"
#include "osteon/carve/removed.h"

namespace {

using namespace osteon;

constexpr double kHalf_m = 0.015, kCell_m = 0.00025, kBurr_mm = 4;
constexpr int kSteps = 2000, kStepsOfPicture = 17;

// To and fro along the upper face, some 1.5 mm deep, at 50 mm/s, without a leap.
Vec3 place(int step) {
  const int along = step % 480, row = step / 480;
  const double x = -0.012 + 0.00005 * (row % 2 == 0 ? along : 480 - along);
  const double y = -0.006 + 0.003 * step / 480;
  return {x, y, kHalf_m + 0.0005 * std::sin(600 * x)};
}

Pose pose(int step) {
  Pose X;
  X.p = place(step);
  return X;
}

const std::shared_ptr<const UncutField>& block() {
  static const auto field = test::block_field(kHalf_m, kCell_m);
  return field;
}

void report(benchmark::State& state, const Percentiles& times, double removed_mm3) {
  state.counters["p50_us"] = 1e-3 * times.quantile_ns(0.5);
  state.counters["p999_us"] = 1e-3 * times.quantile_ns(0.999);
  state.counters["removed_mm3"] = removed_mm3;
}

std::int64_t thread_cpu_ns() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return std::int64_t{1'000'000'000} * now.tv_sec + now.tv_nsec;
}

/// What passed, and what of it this thread had a core.
struct Times {
  Percentiles wall, cpu;
};

template <class Work>
void time_one(Percentiles& times, const Work& work) {
  const std::int64_t before = steady_now_ns();
  work();
  times.add_ns(steady_now_ns() - before);
}

template <class Work>
void time_one(Times& times, const Work& work) {
  const std::int64_t before = thread_cpu_ns();
  time_one(times.wall, work);
  times.cpu.add_ns(thread_cpu_ns() - before);
}

std::size_t at_share(std::vector<std::size_t>& sorted, double share) {
  std::sort(sorted.begin(), sorted.end());
  const auto n = static_cast<std::size_t>(share * static_cast<double>(sorted.size()));
  return sorted.empty() ? 0 : sorted[std::min(n, sorted.size() - 1)];
}

void carve_step(benchmark::State& state) {
  const Cutter burr = test::cutter("burr", kBurr_mm);
  Times times;
  std::vector<std::size_t> changed, taken;
  double removed = 0;
  for (auto _ : state) {
    CarvedField field = test::value(CarvedField::make(block()));
    for (int s = 0; s < kSteps; ++s) {
      const std::size_t held = field.block_count();
      CarveStep did;
      time_one(times, [&] { did = field.cut(burr, pose(s), pose(s + 1)); });
      changed.push_back(did.blocks);
      taken.push_back(field.block_count() - held);
    }
    removed = 1e9 * total(removed_volume(field));
  }
  report(state, times.wall, removed);
  state.counters["cpu_p999_us"] = 1e-3 * times.cpu.quantile_ns(0.999);
  state.counters["cpu_max_us"] = 1e-3 * times.cpu.max_ns();
  state.counters["blocks_p50"] = static_cast<double>(at_share(changed, 0.5));
  state.counters["blocks_p999"] = static_cast<double>(at_share(changed, 0.999));
  state.counters["blocks_max"] = static_cast<double>(at_share(changed, 1));
  state.counters["taken_p999"] = static_cast<double>(at_share(taken, 0.999));
  state.counters["taken_max"] = static_cast<double>(at_share(taken, 1));
}

void carve_surface_of_a_picture(benchmark::State& state) {
  const Cutter burr = test::cutter("burr", kBurr_mm);
  Percentiles times;
  double removed = 0;
  for (auto _ : state) {
    CarvedField field = test::value(CarvedField::make(block()));
    CarvedSurface surface(field);
    for (int s = 0; s < kSteps; ++s) {
      field.cut(burr, pose(s), pose(s + 1));
      if (s % kStepsOfPicture == 0) time_one(times, [&] { surface.update(field); });
    }
    removed = 1e9 * total(removed_volume(field));
  }
  report(state, times, removed);
}

TriMesh shaft_mesh(double radius_m, double length_m) {
  constexpr std::uint32_t kAround = 96;
  TriMesh mesh;
  for (std::uint32_t i = 0; i < 2 * kAround; ++i) {
    const double a = 2 * std::numbers::pi * (i / 2) / kAround;
    mesh.vertices.emplace_back(radius_m * std::cos(a), radius_m * std::sin(a), (i % 2) * length_m);
  }
  const std::uint32_t low = 2 * kAround, high = low + 1;
  mesh.vertices.emplace_back(0, 0, 0);
  mesh.vertices.emplace_back(0, 0, length_m);
  for (std::uint32_t i = 0; i < kAround; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % kAround);
    mesh.triangles.insert(mesh.triangles.end(),
                          {{a, b, b + 1}, {a, b + 1, a + 1}, {low, b, a}, {high, a + 1, b + 1}});
  }
  return mesh;
}

void carve_reaming_350_mm(benchmark::State& state) {
  constexpr double kMb = 1.0 / (1 << 20), kWay_m = 0.35, kStep_m = 1e-4;
  constexpr std::size_t kPool = 4096, kBlockBytes = 2304;  // as a session has it
  UncutFieldOptions options;
  options.cell_m = 0.0005;
  options.room_m = 0.009;
  const auto bone = test::value(UncutField::make(shaft_mesh(0.014, 0.37), options));
  Times steps, pictures, looks;
  for (auto _ : state) {
    CarvedField field = test::value(CarvedField::make(bone, {}, kPool, 0.0075));
    CarvedSurface surface(field);
    LoosePieces loose(field);
    int n = 0;
    bool all_fits = true;
    for (const double size_mm : {9.0, 11.0, 13.0}) {
      const Cutter reamer = test::cutter("reamer", size_mm);
      for (double z = 0.37; z > 0.37 - kWay_m; z -= kStep_m) {
        Pose from, to;
        from.p.z() = z;
        to.p.z() = z - kStep_m;
        time_one(steps, [&] {
          all_fits = (field.cut(reamer, from, to).status & CarveStep::kBlocksFull) == 0 && all_fits;
        });
        if (++n % 8 == 0) time_one(pictures, [&] { surface.update(field); });
        if (n % 64 == 0) time_one(looks, [&] { loose.find(field); });
      }
    }
    if (!all_fits) state.SkipWithError("the pool is too small");
    state.counters["used_mb"] = kMb * kBlockBytes * static_cast<double>(field.block_count());
    state.counters["removed_mm3"] = 1e9 * total(removed_volume(field));
  }
  state.counters["p50_us"] = 1e-3 * steps.wall.quantile_ns(0.5);
  state.counters["p999_us"] = 1e-3 * steps.wall.quantile_ns(0.999);
  const std::pair<const char*, const Times*> all[] = {
      {"step", &steps}, {"picture", &pictures}, {"look", &looks}};
  for (const auto& [name, times] : all) {
    state.counters[std::string(name) + "_ms"] = 1e-6 * times->wall.max_ns();
    state.counters[std::string(name) + "_cpu_ms"] = 1e-6 * times->cpu.max_ns();
  }
  state.counters["bone_mb"] = kMb * static_cast<double>(bone->bytes());
  state.counters["cuts_mb"] = kMb * kBlockBytes * kPool;
}

// Voxels whose middle the ball holds are taken away; no more is known of them than that.
void carve_step_voxels(benchmark::State& state) {
  constexpr int kSide = static_cast<int>(2 * kHalf_m / kCell_m);
  Percentiles times;
  double removed = 0;
  for (auto _ : state) {
    std::vector<std::uint8_t> bone(std::size_t{kSide} * kSide * kSide, 1);
    std::size_t gone = 0;
    const double r = 0.5 * kBurr_mm * 1e-3 / kCell_m;
    const auto delete_ball = [&](const Vec3& p_m) {
      const Vec3 p = (p_m + Vec3::Constant(kHalf_m)) / kCell_m - Vec3::Constant(0.5);
      const Eigen::Vector3i lo = (p - Vec3::Constant(r)).array().ceil().max(0).cast<int>();
      const Eigen::Vector3i hi = (p + Vec3::Constant(r)).array().floor().min(kSide - 1).cast<int>();
      for (int k = lo.z(); k <= hi.z(); ++k)
        for (int j = lo.y(); j <= hi.y(); ++j)
          for (int i = lo.x(); i <= hi.x(); ++i) {
            if ((Vec3(i, j, k) - p).squaredNorm() > r * r) continue;
            std::uint8_t& voxel =
                bone[(std::size_t(k) * kSide + std::size_t(j)) * kSide + std::size_t(i)];
            gone += voxel;
            voxel = 0;
          }
    };
    for (int s = 0; s < kSteps; ++s) time_one(times, [&] { delete_ball(place(s + 1)); });
    removed = static_cast<double>(gone) * std::pow(1e3 * kCell_m, 3);
  }
  report(state, times, removed);
}

openvdb::FloatGrid::Ptr vdb_block() {
  openvdb::initialize();
  const auto transform = openvdb::math::Transform::createLinearTransform(1e3 * kCell_m);
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  const TriMesh mesh = test::box_mesh(Vec3::Constant(1e3 * kHalf_m));
  for (const Vec3& v : mesh.vertices) points.emplace_back(v.x(), v.y(), v.z());
  for (const Triangle& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  return openvdb::tools::meshToLevelSet<openvdb::FloatGrid>(*transform, points, triangles, 3);
}

// A ball at each step (OpenVDB has no swept ball), taken away by csgDifference.
void carve_with_vdb(benchmark::State& state, bool meshes) {
  const auto whole = vdb_block();
  Percentiles times;
  constexpr int kFew = 200;
  for (auto _ : state) {
    const auto bone = whole->deepCopy();
    for (int s = 0; s < kFew; ++s) {
      const Vec3 p = 1e3 * place(s + 1);
      const auto cut = [&] {
        const auto ball = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
            0.5F * static_cast<float>(kBurr_mm), openvdb::Vec3f(p.x(), p.y(), p.z()),
            static_cast<float>(1e3 * kCell_m), 3.0F, false);
        openvdb::tools::csgDifference(*bone, *ball, true, false);
      };
      if (meshes) {
        cut();
        if (s % kStepsOfPicture != 0) continue;
        time_one(times, [&] {
          std::vector<openvdb::Vec3s> points;
          std::vector<openvdb::Vec4I> quads;
          openvdb::tools::volumeToMesh(*bone, points, quads);
          benchmark::DoNotOptimize(quads.data());
        });
      } else {
        time_one(times, cut);
      }
    }
  }
  report(state, times, 0);
}
void carve_step_openvdb(benchmark::State& state) { carve_with_vdb(state, false); }
void carve_surface_openvdb(benchmark::State& state) { carve_with_vdb(state, true); }

BENCHMARK(carve_step)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(carve_surface_of_a_picture)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(carve_reaming_350_mm)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(carve_step_voxels)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(carve_step_openvdb)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(carve_surface_openvdb)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
