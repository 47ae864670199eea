#include "osteon/tissue/solve.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "solver.h"

namespace osteon {
namespace {

constexpr std::uint64_t kSoundEvery = 32;  // steps between looks for lost parts

Result<std::unique_ptr<Solver>> make_solver(const SolveScene& scene) {
  if (scene.body.rod.has_value() != (scene.model == TissueModel::kRod))
    return fail("'material.model' does not fit the mesh", scene.name,
                "Use mesh.rod with model 'rod', a grid or vtk with the others");
  if (scene.body.rod) return make_rod_solver(scene);
  const bool cubes = scene.model == TissueModel::kNeoHookean && scene.body.grid;
  return cubes ? make_hex_solver(scene) : make_tet_solver(scene);
}

/// Watches the kinetic energy: at rest when during the last tenth it stayed far below the strain
/// energy and its own peak.
class RestWatch {
 public:
  explicit RestWatch(std::uint64_t steps)
      : last_tenth_(steps - steps / 10), every_(std::max<std::uint64_t>(steps / 400, 1)) {}
  void see(std::uint64_t step, const Solver& solver) {
    if (step % every_ != 0) return;
    const double kinetic = solver.kinetic_j();
    peak_ = std::max(peak_, kinetic);
    if (step >= last_tenth_) late_peak_ = std::max(late_peak_, kinetic);
  }
  bool at_rest(const SolidEnergy& energy) const {
    const double held = energy.strain_j + energy.hourglass_j;
    return late_peak_ <= 1e-5 * std::max(held, peak_);
  }

 private:
  std::uint64_t last_tenth_, every_;
  double peak_ = 0, late_peak_ = 0;
};

// Steps to the end, or until a part is lost: then the last sound state stands.
void run(Solver& solver, std::uint64_t steps, RestWatch& watch, SolveResult& result) {
  for (std::uint64_t n = 1; n <= steps; ++n) {
    solver.step();
    result.steps = n;
    watch.see(n, solver);
    if (n % kSoundEvery != 0 && n != steps) continue;
    if (const auto lost = solver.find_lost()) {
      solver.go_back();
      result.lost = SolveLost{lost->part, lost->at_m, static_cast<double>(n) * solver.step_s()};
      return;
    }
    solver.keep();
  }
}

void report(const SolveScene& scene, Solver& solver, SolveResult& result) {
  result.energy = solver.energy();
  const std::vector<Vec3> forces = solver.reactions(), moments = solver.moments();
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const bool moved = i >= scene.fixed.size();
    result.reactions.push_back({moved, moved ? i - scene.fixed.size() : i, forces[i]});
    if (!moments.empty()) result.reactions.back().moment_n_m = moments[i];
  }
  for (std::size_t i = 0; i < scene.probes_m.size(); ++i)
    result.probes.push_back({scene.probes_m[i], solver.probe_moved(i)});
  result.shape = solver.shape();
}

void add_number(std::string& out, double value) {
  char text[32];
  out.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}

void add_points_mm(std::string& out, const std::vector<Vec3>& points_m) {
  for (const Vec3& p : points_m)
    for (Eigen::Index k = 0; k < 3; ++k) {
      add_number(out, 1000 * p[k]);
      out += k < 2 ? ' ' : '\n';
    }
}

const char* vtk_cell_type(std::size_t corners) {
  return corners == 8 ? "12\n" : corners == 4 ? "10\n" : corners == 3 ? "5\n" : "3\n";
}

}  // namespace

Result<SolveResult> solve(const SolveScene& scene) {
  auto made = make_solver(scene);
  if (!made) return tl::unexpected(made.error());
  Solver& solver = **made;
  SolveResult result;
  result.elements = solver.elements();
  result.step_s = solver.step_s();
  const std::uint64_t steps = steps_for(scene.time_s, solver.step_s());
  RestWatch watch(steps);
  run(solver, steps, watch, result);
  report(scene, solver, result);
  result.settled = !result.lost && watch.at_rest(result.energy);
  return result;
}

std::string solve_vtk(const SolveShape& shape) {
  const std::size_t per = shape.corners_a_cell, cells = per ? shape.corners.size() / per : 0;
  std::string out = "# vtk DataFile Version 3.0\ntissue by Osteon\nASCII\n";
  out += "DATASET UNSTRUCTURED_GRID\nPOINTS " + std::to_string(shape.points_m.size()) + " double\n";
  add_points_mm(out, shape.points_m);
  out += "CELLS " + std::to_string(cells) + " " + std::to_string(cells * (per + 1)) + "\n";
  for (std::size_t i = 0; i < cells; ++i) {
    out += std::to_string(per);
    for (std::size_t k = 0; k < per; ++k) out += " " + std::to_string(shape.corners[i * per + k]);
    out += "\n";
  }
  out += "CELL_TYPES " + std::to_string(cells) + "\n";
  for (std::size_t i = 0; i < cells; ++i) out += vtk_cell_type(per);
  out += "POINT_DATA " + std::to_string(shape.points_m.size()) + "\nVECTORS moved_mm double\n";
  add_points_mm(out, shape.moved_m);
  return out;
}

}  // namespace osteon
