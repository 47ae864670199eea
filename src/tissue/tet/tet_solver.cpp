#include "osteon/tissue/tet_solid.h"
#include "solver.h"
#include "tet/tet_condensed.h"
#include "tet/tet_explicit.h"

namespace osteon {
namespace {

std::vector<BodyNode> nodes_of(const TetSolid& solid) {
  std::vector<BodyNode> out;
  for (std::size_t i = 0; i < solid.rest_W.size(); ++i)
    out.push_back({static_cast<std::uint32_t>(i), solid.rest_W[i], solid.mass_kg[i]});
  return out;
}

Result<std::vector<TetPoint>> find_probes(const SolveScene& scene, const TetSolid& solid) {
  std::vector<TetPoint> out;
  for (std::size_t i = 0; i < scene.probes_m.size(); ++i) {
    const auto point = find_point(solid, scene.probes_m[i]);
    if (!point)
      return fail("'run.probe_mm[" + std::to_string(i) + "]' lies outside the body", scene.name,
                  "Move it into the body, or onto its surface");
    out.push_back(*point);
  }
  return out;
}

SolveShape shape_of(const TetSolid& solid, const SolidState& state) {
  SolveShape out;
  out.corners_a_cell = 4;
  for (std::size_t i = 0; i < solid.corners; ++i) {
    out.moved_m.push_back(state.moved(i));
    out.points_m.push_back(solid.rest_W[i] + out.moved_m.back());
  }
  for (const TetElement& e : solid.elements)
    out.corners.insert(out.corners.end(), e.node.begin(), e.node.begin() + 4);
  return out;
}

class TetSolver final : public Solver {
 public:
  TetSolver(TetSolid solid, Supports supports, std::vector<TetPoint> probes, double step_s)
      : stepper_(std::move(solid), std::move(supports), step_s),
        probes_(std::move(probes)),
        state_(stepper_.rest_state()),
        kept_(state_) {}

  std::size_t elements() const override { return stepper_.solid().elements.size(); }
  double step_s() const override { return stepper_.step_s(); }
  void step() override { stuck_ = stuck_ || !stepper_.step(state_); }
  double kinetic_j() const override { return osteon::kinetic_j(state_, stepper_.solid().mass_kg); }
  SolidEnergy energy() override { return stepper_.energy(state_); }
  std::vector<Vec3> reactions() override { return stepper_.reactions(state_); }
  Vec3 probe_moved(std::size_t i) const override {
    return moved_at(stepper_.solid(), state_, probes_[i]);
  }
  SolveShape shape() const override { return shape_of(stepper_.solid(), state_); }
  std::optional<LostPart> find_lost() const override;
  void keep() override { kept_ = state_; }
  void go_back() override { state_ = kept_; }

 private:
  TetStepper stepper_;
  std::vector<TetPoint> probes_;
  SolidState state_, kept_;
  bool stuck_ = false;
};

std::optional<LostPart> TetSolver::find_lost() const {
  if (const auto lost = osteon::find_lost(stepper_.solid(), state_))
    return LostPart{"tetrahedron " + std::to_string(lost->element), lost->rest_W};
  if (stuck_) return LostPart{"the balance of forces", stepper_.solid().rest_W[0]};
  return std::nullopt;
}

/// Neo-Hookean, by explicit steps.
class TetExplicitSolver final : public Solver {
 public:
  TetExplicitSolver(TetSolid solid, Supports supports, std::vector<TetPoint> probes, double step_s)
      : solid_(std::move(solid)),
        supports_(std::move(supports)),
        probes_(std::move(probes)),
        step_s_(step_s),
        state_(state_at_rest(solid_.rest_W.size(), false)),
        kept_(state_) {}

  std::size_t elements() const override { return solid_.elements.size(); }
  double step_s() const override { return step_s_; }
  void step() override { explicit_step(solid_, supports_, step_s_, state_, scratch_); }
  double kinetic_j() const override { return osteon::kinetic_j(state_, solid_.mass_kg); }
  SolidEnergy energy() override { return explicit_energy(solid_, state_); }
  std::vector<Vec3> reactions() override {
    return explicit_reactions(solid_, supports_, step_s_, state_, scratch_);
  }
  Vec3 probe_moved(std::size_t i) const override { return moved_at(solid_, state_, probes_[i]); }
  SolveShape shape() const override { return shape_of(solid_, state_); }
  std::optional<LostPart> find_lost() const override {
    const auto lost = find_squeezed(solid_, state_);
    if (!lost) return std::nullopt;
    return LostPart{"tetrahedron " + std::to_string(lost->element), lost->rest_W};
  }
  void keep() override { kept_ = state_; }
  void go_back() override { state_ = kept_; }

 private:
  TetSolid solid_;
  Supports supports_;
  std::vector<TetPoint> probes_;
  double step_s_;
  SolidState state_, kept_;
  TetScratch scratch_;
};

/// The static answer at the end of the time, in one step.
class TetCondensedSolver final : public Solver {
 public:
  TetCondensedSolver(CondensedSolid body, std::vector<TetPoint> probes, double time_s)
      : body_(std::move(body)),
        probes_(std::move(probes)),
        time_s_(time_s),
        state_(state_at_rest(body_.solid().rest_W.size(), true)) {}

  std::size_t elements() const override { return body_.solid().elements.size(); }
  double step_s() const override { return time_s_; }
  void step() override { state_ = body_.solve(time_s_); }
  double kinetic_j() const override { return 0; }
  SolidEnergy energy() override { return {body_.strain_j(state_), 0, 0}; }
  std::vector<Vec3> reactions() override { return body_.reactions(state_, time_s_); }
  Vec3 probe_moved(std::size_t i) const override {
    return moved_at(body_.solid(), state_, probes_[i]);
  }
  SolveShape shape() const override { return shape_of(body_.solid(), state_); }
  std::optional<LostPart> find_lost() const override {
    const auto lost = osteon::find_lost(body_.solid(), state_);
    if (!lost) return std::nullopt;
    return LostPart{"tetrahedron " + std::to_string(lost->element), lost->rest_W};
  }
  void keep() override {}
  void go_back() override { state_ = state_at_rest(body_.solid().rest_W.size(), true); }

 private:
  CondensedSolid body_;
  std::vector<TetPoint> probes_;
  double time_s_;
  SolidState state_;
};

// Quadratic while that is affordable: then bending is right with few elements.
TetOrder order_for(const TetMesh& mesh) {
  constexpr std::size_t kMostQuadratic = 12'000;
  return mesh.tets.size() <= kMostQuadratic ? TetOrder::kQuadratic : TetOrder::kLinear;
}

}  // namespace

Result<std::unique_ptr<Solver>> make_tet_solver(const SolveScene& scene) {
  constexpr std::size_t kMostTetrahedra = 400'000;
  TetSolidDef def;
  def.mesh = scene.body.grid ? split_into_tetrahedra(*scene.body.grid) : scene.body.tets;
  if (def.mesh.tets.size() > kMostTetrahedra)
    return fail(std::to_string(def.mesh.tets.size()) + " tetrahedra are more than " +
                    std::to_string(kMostTetrahedra),
                scene.name, "Use fewer, larger cells");
  def.material = scene.material;
  def.corotated = scene.model == TissueModel::kCorotated;
  def.order = order_for(def.mesh);
  auto solid = make_tet_solid(def);
  if (!solid) {
    if (!scene.body.grid) solid.error().what = "'mesh.vtk' " + solid.error().what;
    solid.error().where = scene.name;
    return tl::unexpected(solid.error());
  }
  auto supports = place_supports(scene, nodes_of(*solid));
  if (!supports) return tl::unexpected(supports.error());
  auto probes = find_probes(scene, *solid);
  if (!probes) return tl::unexpected(probes.error());
  if (scene.condensed) {
    auto body = CondensedSolid::make(std::move(*solid), std::move(*supports));
    if (!body) {
      body.error().where = scene.name;
      return tl::unexpected(body.error());
    }
    return std::make_unique<TetCondensedSolver>(std::move(*body), std::move(*probes), scene.time_s);
  }
  const bool steps_explicitly = scene.model == TissueModel::kNeoHookean;
  const double longest = steps_explicitly ? stable_explicit_step_s(*solid)
                                          : fitting_step_s(*solid, *supports, scene.time_s);
  if (auto fine = check_work(scene, longest, solid->elements.size()); !fine)
    return tl::unexpected(fine.error());
  const double step_s = scene.time_s / static_cast<double>(steps_for(scene.time_s, longest));
  if (steps_explicitly)
    return std::make_unique<TetExplicitSolver>(std::move(*solid), std::move(*supports),
                                               std::move(*probes), step_s);
  return std::make_unique<TetSolver>(std::move(*solid), std::move(*supports), std::move(*probes),
                                     step_s);
}

}  // namespace osteon
