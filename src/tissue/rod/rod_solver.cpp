#include <algorithm>

#include "osteon/tissue/rod.h"
#include "solver.h"

namespace osteon {
namespace {

/// A probe: a place in the section of one segment.
struct RodProbe {
  std::size_t segment = 0;
  double share = 0;
  Vec3 aside_S = Vec3::Zero();  ///< from the middle line, in the segment's frame
};

std::vector<BodyNode> nodes_of(const Rod& rod) {
  std::vector<BodyNode> out;
  for (std::size_t i = 0; i < rod.start_W.size(); ++i)
    out.push_back({static_cast<std::uint32_t>(i), rod.start_W[i], rod.mass_kg[i]});
  return out;
}

Result<RodProbe> find_rod_probe(const SolveScene& scene, const Rod& rod, std::size_t index) {
  const Vec3& p = scene.probes_m[index];
  RodProbe best;
  double nearest = 1e300;
  for (std::size_t i = 0; i < rod.segments(); ++i) {
    const Vec3 a = rod.start_W[i], ab = rod.start_W[i + 1] - a;
    const double share = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
    const Vec3 aside = p - (a + share * ab);
    if (!(aside.norm() < nearest)) continue;
    nearest = aside.norm();
    best = {i, share, rod.start_R_WS[i].conjugate() * aside};
  }
  if (nearest <= rod.radius_m * (1 + 1e-6)) return best;
  return fail("'run.probe_mm[" + std::to_string(index) + "]' lies outside the body", scene.name,
              "Move it into the rod, within its radius of the middle line");
}

/// What grips the nodes of one entry, and which segments it holds by both ends.
struct GripNodes {
  std::vector<bool> has;
  Vec3 middle_W = Vec3::Zero();
};

GripNodes nodes_in(const Rod& rod, const Aabb& box) {
  Aabb whole;
  for (const Vec3& p : rod.start_W) whole.include(p);
  const Aabb grown = box.grown(1e-6 * whole.extent().norm());
  GripNodes out;
  std::size_t count = 0;
  for (const Vec3& p : rod.start_W) {
    const bool in = (p.array() >= grown.lo.array()).all() && (p.array() <= grown.hi.array()).all();
    out.has.push_back(in);
    if (!in) continue;
    out.middle_W += p;
    ++count;
  }
  if (count > 0) out.middle_W /= static_cast<double>(count);
  return out;
}

// Later entries take a frame from earlier ones, as they take axes of nodes.
void hold_frames(const GripNodes& nodes, std::optional<bool> clamp, std::uint32_t grip,
                 std::vector<std::optional<std::uint32_t>>& grip_of) {
  if (!clamp.value_or(true)) return;
  for (std::size_t i = 0; i < grip_of.size(); ++i) {
    const bool both = nodes.has[i] && nodes.has[i + 1], any = nodes.has[i] || nodes.has[i + 1];
    if (clamp ? any : both) grip_of[i] = grip;
  }
}

Result<RodSupports> place_rod_supports(const SolveScene& scene, const Rod& rod) {
  const std::vector<BodyNode> nodes = nodes_of(rod);
  auto placed = place_supports(scene, nodes);
  if (!placed) return tl::unexpected(placed.error());
  RodSupports out;
  out.gravity_m_per_s2 = placed->gravity_m_per_s2;
  out.loads = std::move(placed->loads);
  for (const HeldAxis& h : placed->held) out.axes.push_back({h.slot, h.axis, h.entry});
  std::vector<std::optional<std::uint32_t>> grip_of(rod.segments());
  for (const FixedBox& box : scene.fixed) {
    const GripNodes in = nodes_in(rod, box.box_m);
    hold_frames(in, box.clamp, static_cast<std::uint32_t>(out.grips.size()), grip_of);
    out.grips.push_back({Vec3::Zero(), Vec3::Zero(), in.middle_W, 0});
  }
  for (const MovedBox& box : scene.moved) {
    const GripNodes in = nodes_in(rod, box.box_m);
    hold_frames(in, box.clamp, static_cast<std::uint32_t>(out.grips.size()), grip_of);
    out.grips.push_back({box.by_m, box.turn_rad, in.middle_W, box.over_s});
  }
  for (std::uint32_t i = 0; i < grip_of.size(); ++i)
    if (grip_of[i]) out.frames.push_back({i, *grip_of[i]});
  out.obstacles = scene.obstacles;
  return out;
}

class RodSolver final : public Solver {
 public:
  RodSolver(RodStepper stepper, std::vector<RodProbe> probes)
      : stepper_(std::move(stepper)),
        probes_(std::move(probes)),
        state_(stepper_.start_state()),
        kept_(state_) {}

  std::size_t elements() const override { return stepper_.rod().segments(); }
  double step_s() const override { return stepper_.step_s(); }
  void step() override { stepper_.step(state_); }
  double kinetic_j() const override { return stepper_.energy(state_).kinetic_j; }
  SolidEnergy energy() override { return stepper_.energy(state_); }
  std::vector<Vec3> reactions() override { return state_.grip_n; }
  std::vector<Vec3> moments() override { return state_.grip_n_m; }
  Vec3 probe_moved(std::size_t i) const override;
  SolveShape shape() const override;
  std::optional<LostPart> find_lost() const override;
  void keep() override { kept_ = state_; }
  void go_back() override { state_ = kept_; }

 private:
  RodStepper stepper_;
  std::vector<RodProbe> probes_;
  RodState state_, kept_;
};

Vec3 RodSolver::probe_moved(std::size_t i) const {
  const Rod& rod = stepper_.rod();
  const RodProbe& p = probes_[i];
  const auto at = [&](const std::vector<Vec3>& x, const std::vector<Quat>& q) {
    return Vec3((1 - p.share) * x[p.segment] + p.share * x[p.segment + 1] +
                q[p.segment] * p.aside_S);
  };
  return at(state_.at_W, state_.R_WS) - at(rod.start_W, rod.start_R_WS);
}

SolveShape RodSolver::shape() const {
  const Rod& rod = stepper_.rod();
  const RodSurface before = rod_surface(rod, rod.start_W, rod.start_R_WS);
  RodSurface now = rod_surface(rod, state_.at_W, state_.R_WS);
  SolveShape out;
  out.corners_a_cell = 3;
  for (std::size_t i = 0; i < now.points_W.size(); ++i)
    out.moved_m.push_back(now.points_W[i] - before.points_W[i]);
  out.points_m = std::move(now.points_W);
  out.corners = std::move(now.triangles);
  return out;
}

std::optional<LostPart> RodSolver::find_lost() const {
  const auto lost = osteon::find_lost(stepper_.rod(), state_);
  if (!lost) return std::nullopt;
  return LostPart{"segment " + std::to_string(*lost), stepper_.rod().start_W[*lost]};
}

}  // namespace

Result<std::unique_ptr<Solver>> make_rod_solver(const SolveScene& scene) {
  const RodShape& shape = *scene.body.rod;
  auto rod = make_rod({shape.points_m, shape.radius_m, shape.segments, shape.straight_at_rest,
                       scene.material, scene.friction});
  if (!rod) {
    rod.error().where = scene.name;
    return tl::unexpected(rod.error());
  }
  auto supports = place_rod_supports(scene, *rod);
  if (!supports) return tl::unexpected(supports.error());
  std::vector<RodProbe> probes;
  for (std::size_t i = 0; i < scene.probes_m.size(); ++i) {
    const auto probe = find_rod_probe(scene, *rod, i);
    if (!probe) return tl::unexpected(probe.error());
    probes.push_back(*probe);
  }
  const double longest = fitting_step_s(*rod, *supports, scene.time_s);
  const double step_s = scene.time_s / static_cast<double>(steps_for(scene.time_s, longest));
  return std::make_unique<RodSolver>(RodStepper(std::move(*rod), std::move(*supports), step_s),
                                     std::move(probes));
}

}  // namespace osteon
