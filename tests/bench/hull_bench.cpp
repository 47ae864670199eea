// Convex hulls beside qhull, CGAL and Bullet, on the wrist's fifteen bones (distinct vertices, as
// meshes hold them, and the triangle soup, as STL does), on random points in a ball and on a
// sphere, and on random points of a bone's surface. `ns_point` shows how the time grows: over n, or
// over n log n, the random sets are ten times larger each.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <LinearMath/btConvexHullComputer.h>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "osteon/base/random.h"
#include "osteon/hull/hull.h"
#include "osteon/mesh/mesh_io.h"
#include "ratios.h"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace {

using osteon::Vec3;
using Points = std::vector<Vec3>;
using Sets = std::vector<Points>;

const char* const kBones[] = {"1mc",      "2mc",       "3mc",       "4mc",        "5mc",
                              "capitate", "hamate",    "lunate",    "pisiform",   "radius",
                              "scaphoid", "trapezium", "trapezoid", "triquetrum", "ulna"};

std::filesystem::path wrist_folder() {
  const char* shared = std::getenv("OSTEON_SHARED");
  return std::filesystem::path(shared ? shared : OSTEON_SOURCE_DIR "/../shared") / "anatomy/wrist";
}

Points distinct(const Points& soup) {
  std::set<std::array<double, 3>> seen;
  Points points;
  for (const Vec3& p : soup) {
    if (seen.insert({p.x(), p.y(), p.z()}).second) points.push_back(p);
  }
  return points;
}

/// One set of points a bone; empty when the meshes are not there.
Sets wrist(bool soup) {
  Sets sets;
  for (const char* bone : kBones) {
    const auto mesh = osteon::load_mesh(wrist_folder() / (std::string(bone) + ".stl"), 1.0);
    if (!mesh) return {};
    const Points vertices = distinct(mesh->vertices);
    if (!soup) {
      sets.push_back(vertices);
      continue;
    }
    Points corners;
    for (const osteon::Triangle& t : mesh->triangles) {
      for (const std::uint32_t v : t) corners.push_back(mesh->vertices[v]);
    }
    sets.push_back(corners);
  }
  return sets;
}

Points on_sphere(std::size_t n) {
  osteon::Random random(1);
  Points points;
  for (std::size_t i = 0; i < n; ++i) points.push_back(random.direction());
  return points;
}

Points in_ball(std::size_t n) {
  osteon::Random random(2);
  Points points;
  for (std::size_t i = 0; i < n; ++i) {
    const double radius = std::cbrt(random.uniform());
    points.push_back(radius * random.direction());
  }
  return points;
}

/// Evenly over the triangles of the capitate; empty when the mesh is not there.
Sets on_bone(std::size_t n) {
  const auto mesh = osteon::load_mesh(wrist_folder() / "capitate.stl", 1.0);
  if (!mesh) return {};
  std::vector<double> areas;
  double area = 0;
  for (const osteon::Triangle& t : mesh->triangles) {
    const Vec3& a = mesh->vertices[t[0]];
    area += (mesh->vertices[t[1]] - a).cross(mesh->vertices[t[2]] - a).norm();
    areas.push_back(area);
  }
  osteon::Random random(3);
  Points points;
  for (std::size_t i = 0; i < n; ++i) {
    const double place = random.uniform() * area;
    const double u = std::sqrt(random.uniform()), v = random.uniform();
    const auto found = std::upper_bound(areas.begin(), areas.end() - 1, place) - areas.begin();
    const osteon::Triangle& t = mesh->triangles[static_cast<std::size_t>(found)];
    points.push_back((1 - u) * mesh->vertices[t[0]] + u * (1 - v) * mesh->vertices[t[1]] +
                     u * v * mesh->vertices[t[2]]);
  }
  return {points};
}

// Each hull returns how many vertices it found.

std::size_t osteon_hull(const Points& points) {
  return osteon::build_hull(points).hull->vertices.size();
}

std::size_t qhull_hull(const Points& points) {
  qhT context;
  qhT* qh = &context;
  qh_zero(qh, stderr);
  char options[] = "qhull";
  auto* coordinates = const_cast<double*>(points.data()->data());
  qh_new_qhull(qh, 3, static_cast<int>(points.size()), coordinates, False, options, nullptr,
               stderr);
  const auto count = static_cast<std::size_t>(qh->num_vertices);
  qh_freeqhull(qh, !qh_ALL);
  int kept = 0, total = 0;
  qh_memfreeshort(qh, &kept, &total);
  return count;
}

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalPoints = std::vector<Kernel::Point_3>;

std::size_t cgal_hull(const CgalPoints& points) {
  CGAL::Surface_mesh<Kernel::Point_3> mesh;
  CGAL::convex_hull_3(points.begin(), points.end(), mesh);
  return mesh.number_of_vertices();
}

std::size_t bullet_hull(const Points& points) {
  btConvexHullComputer computer;
  computer.compute(points.data()->data(), sizeof(Vec3), static_cast<int>(points.size()), 0, 0);
  return static_cast<std::size_t>(computer.vertices.size());
}

template <class Set, class Hull>
void measure(benchmark::State& state, const std::vector<Set>& sets, const Hull& hull) {
  if (sets.empty()) {
    state.SkipWithError("the wrist's meshes are not there (set OSTEON_SHARED)");
    return;
  }
  std::size_t vertices = 0;
  for (auto _ : state) {
    vertices = 0;
    for (const Set& points : sets) vertices += hull(points);
  }
  std::size_t points = 0;
  for (const Set& set : sets) points += set.size();
  state.counters["vertices"] = static_cast<double>(vertices);
  state.counters["per_point"] = benchmark::Counter(
      static_cast<double>(points),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

std::vector<CgalPoints> for_cgal(const Sets& sets) {
  std::vector<CgalPoints> result;
  for (const Points& points : sets) {
    result.emplace_back();
    for (const Vec3& p : points) result.back().emplace_back(p.x(), p.y(), p.z());
  }
  return result;
}

/// More than once where that takes no time: then the median is told, and how far the runs differ.
void add(const std::string& name, const Sets& sets) {
  std::size_t points = 0;
  for (const Points& set : sets) points += set.size();
  const int runs = points < 1'000'000 ? 5 : 1;
  const auto settle = [runs](benchmark::internal::Benchmark* b) {
    b->Unit(benchmark::kMillisecond)->Repetitions(runs)->ReportAggregatesOnly(runs > 1);
  };
  settle(benchmark::RegisterBenchmark(
      (name + "/osteon").c_str(), [sets](benchmark::State& s) { measure(s, sets, osteon_hull); }));
  settle(benchmark::RegisterBenchmark(
      (name + "/qhull").c_str(), [sets](benchmark::State& s) { measure(s, sets, qhull_hull); }));
  settle(benchmark::RegisterBenchmark(
      (name + "/cgal").c_str(), [sets = for_cgal(sets)](auto& s) { measure(s, sets, cgal_hull); }));
  settle(benchmark::RegisterBenchmark(
      (name + "/bullet").c_str(), [sets](benchmark::State& s) { measure(s, sets, bullet_hull); }));
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<osteon::bench::Comparison> comparisons;
  const auto compare = [&](const std::string& name, const Sets& sets) {
    add(name, sets);
    comparisons.push_back({name + "/osteon", {name + "/qhull", name + "/cgal", name + "/bullet"}});
  };
  compare("wrist", wrist(false));
  compare("wrist_soup", wrist(true));
  for (const int decade : {4, 5, 6}) {
    const auto n = static_cast<std::size_t>(std::lround(std::pow(10, decade)));
    compare("ball_1e" + std::to_string(decade), {in_ball(n)});
    compare("sphere_1e" + std::to_string(decade), {on_sphere(n)});
    compare("bone_1e" + std::to_string(decade), on_bone(n));
  }
  return osteon::bench::run(argc, argv, comparisons);
}
