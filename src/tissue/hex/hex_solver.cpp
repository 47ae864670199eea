#include <cmath>

#include "solver.h"

namespace osteon {
namespace {

/// Place of a point in a grid: a cell and the coordinates in it, 0 to 1.
struct CellPoint {
  std::array<std::size_t, 3> cell{};
  Vec3 at = Vec3::Zero();
};

Result<CellPoint> find_cell(const SolveScene& scene, const HexSolid& solid, std::size_t i) {
  constexpr double kSlack = 1e-6;
  CellPoint out;
  const Vec3 p = (scene.probes_m[i] - solid.grid.origin_W) / solid.grid.cell_m;
  for (std::size_t k = 0; k < 3; ++k) {
    const double n = solid.grid.cells[k], x = p[static_cast<Eigen::Index>(k)];
    if (!(x >= -kSlack * n && x <= n + kSlack * n))
      return fail("'run.probe_mm[" + std::to_string(i) + "]' lies outside the body", scene.name,
                  "Move it into the grid, or onto its surface");
    const double cell = std::min(std::max(std::floor(x), 0.0), n - 1);
    out.cell[k] = static_cast<std::size_t>(cell);
    out.at[static_cast<Eigen::Index>(k)] = x - cell;
  }
  return out;
}

Vec3 moved_at(const HexSolid& solid, const SolidState& state, const CellPoint& p) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 8; ++k) {
    const std::size_t x = k % 2, y = k / 2 % 2, z = k / 4;
    const double weight = (x ? p.at.x() : 1 - p.at.x()) * (y ? p.at.y() : 1 - p.at.y()) *
                          (z ? p.at.z() : 1 - p.at.z());
    sum += weight * state.moved(solid.slot(p.cell[0] + x, p.cell[1] + y, p.cell[2] + z));
  }
  return sum;
}

std::vector<BodyNode> nodes_of(const HexSolid& solid) {
  std::vector<BodyNode> out;
  out.reserve(solid.nodes.size());
  for (const std::uint32_t s : solid.nodes) out.push_back({s, solid.rest_W(s), solid.mass_kg[s]});
  return out;
}

class HexSolver final : public Solver {
 public:
  HexSolver(HexSolid solid, Supports supports, std::vector<CellPoint> probes, double step_s)
      : solid_(std::move(solid)),
        supports_(std::move(supports)),
        probes_(std::move(probes)),
        step_s_(step_s),
        state_(rest_state(solid_)),
        kept_(state_) {}

  std::size_t elements() const override { return solid_.elements; }
  double step_s() const override { return step_s_; }
  void step() override { osteon::step(solid_, supports_, step_s_, state_, scratch_); }
  double kinetic_j() const override { return osteon::kinetic_j(state_, solid_.mass_kg); }
  SolidEnergy energy() override {
    return osteon::energy(solid_, supports_, step_s_, state_, scratch_);
  }
  std::vector<Vec3> reactions() override {
    return osteon::reactions(solid_, supports_, step_s_, state_, scratch_);
  }
  Vec3 probe_moved(std::size_t i) const override { return moved_at(solid_, state_, probes_[i]); }
  SolveShape shape() const override;
  std::optional<LostPart> find_lost() const override;
  void keep() override { kept_ = state_; }
  void go_back() override { state_ = kept_; }

 private:
  HexSolid solid_;
  Supports supports_;
  std::vector<CellPoint> probes_;
  double step_s_;
  SolidState state_, kept_;
  HexScratch scratch_;
};

SolveShape HexSolver::shape() const {
  SolveShape out;
  out.corners_a_cell = 8;
  std::vector<std::uint32_t> point_of(solid_.slots, 0);
  for (const std::uint32_t s : solid_.nodes) {
    point_of[s] = static_cast<std::uint32_t>(out.points_m.size());
    out.moved_m.push_back(state_.moved(s));
    out.points_m.push_back(solid_.rest_W(s) + out.moved_m.back());
  }
  constexpr std::size_t kAround[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto& n = solid_.grid.cells;
  for (std::size_t z = 0; z < n[2]; ++z)
    for (std::size_t y = 0; y < n[1]; ++y)
      for (std::size_t x = 0; x < n[0]; ++x) {
        if (!(solid_.fill[solid_.slot(x, y, z)] > 0)) continue;
        for (std::size_t up = 0; up < 2; ++up)
          for (const auto& corner : kAround)
            out.corners.push_back(point_of[solid_.slot(x + corner[0], y + corner[1], z + up)]);
      }
  return out;
}

std::optional<LostPart> HexSolver::find_lost() const {
  const auto lost = osteon::find_lost(solid_, state_);
  if (!lost) return std::nullopt;
  return LostPart{"hexahedron " + std::to_string(lost->element), lost->rest_W};
}

}  // namespace

Result<std::unique_ptr<Solver>> make_hex_solver(const SolveScene& scene) {
  HexSolidDef def;
  def.grid = *scene.body.grid;
  def.material = scene.material;
  auto solid = make_hex_solid(def);
  if (!solid) return tl::unexpected(solid.error());
  const double longest = stable_step_s(*solid);
  if (auto fine = check_work(scene, longest, solid->elements); !fine)
    return tl::unexpected(fine.error());
  auto supports = place_supports(scene, nodes_of(*solid));
  if (!supports) return tl::unexpected(supports.error());
  std::vector<CellPoint> probes;
  for (std::size_t i = 0; i < scene.probes_m.size(); ++i) {
    const auto point = find_cell(scene, *solid, i);
    if (!point) return tl::unexpected(point.error());
    probes.push_back(*point);
  }
  const double step_s = scene.time_s / static_cast<double>(steps_for(scene.time_s, longest));
  return std::make_unique<HexSolver>(std::move(*solid), std::move(*supports), std::move(probes),
                                     step_s);
}

}  // namespace osteon
