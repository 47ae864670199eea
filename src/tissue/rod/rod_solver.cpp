#include <algorithm>
#include <cmath>

#include "osteon/tissue/rod_cut.h"
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

std::optional<RodProbe> find_rod_probe(const Rod& rod, const Vec3& p) {
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
  return std::nullopt;
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

/// A cut that is still to be made, at a node of the whole rod.
struct DueCut {
  std::uint64_t step = 0;
  std::size_t node = 0;
};

/// A part of the rod; at first there is one.
struct RodPiece {
  RodPiece(RodPart part, double step_s, std::size_t first)
      : stepper(std::move(part.rod), std::move(part.supports), step_s),
        state(std::move(part.state)),
        kept(state),
        first_segment(first) {}
  RodStepper stepper;
  RodState state, kept;
  std::size_t first_segment;  ///< of the whole rod
};

class RodSolver final : public Solver {
 public:
  RodSolver(RodPart whole, double step_s, std::vector<RodProbe> probes, std::vector<DueCut> cuts)
      : supports_(whole.supports), probes_(std::move(probes)), cuts_(std::move(cuts)) {
    segments_ = whole.rod.segments();
    pieces_.emplace_back(std::move(whole), step_s, 0);
    pieces_.back().state = pieces_.back().kept = pieces_.back().stepper.start_state();
  }

  std::size_t elements() const override { return segments_; }
  double step_s() const override { return pieces_.front().stepper.step_s(); }
  void step() override;
  double kinetic_j() const override { return sum().kinetic_j; }
  SolidEnergy energy() override { return sum(); }
  std::vector<Vec3> reactions() override { return of_grips(&RodState::grip_n); }
  std::vector<Vec3> moments() override { return of_grips(&RodState::grip_n_m); }
  Vec3 probe_moved(std::size_t i) const override;
  SolveShape shape() const override;
  std::optional<LostPart> find_lost() const override;
  void keep() override {
    for (RodPiece& piece : pieces_) piece.kept = piece.state;
  }
  void go_back() override {
    for (RodPiece& piece : pieces_) piece.state = piece.kept;
  }

 private:
  SolidEnergy sum() const;
  std::vector<Vec3> of_grips(std::vector<Vec3> RodState::*force) const;
  void cut(std::size_t node);

  RodSupports supports_;
  std::vector<RodPiece> pieces_;
  std::size_t segments_ = 0;
  std::vector<RodProbe> probes_;
  std::vector<DueCut> cuts_;
};

void RodSolver::step() {
  const std::uint64_t now = pieces_.front().state.tick;
  for (const DueCut& due : cuts_)
    if (due.step == now) cut(due.node);
  for (RodPiece& piece : pieces_) piece.stepper.step(piece.state);
}

// Pieces stay in the order of their segments.
void RodSolver::cut(std::size_t node) {
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const RodPiece& piece = pieces_[i];
    const std::size_t first = piece.first_segment;
    if (node <= first || node >= first + piece.stepper.rod().segments()) continue;
    auto parts = cut_rod(piece.stepper.rod(), piece.stepper.supports(), piece.state, node - first);
    if (!parts) return;
    RodPiece after(std::move(parts->second), step_s(), node);
    pieces_[i] = RodPiece(std::move(parts->first), step_s(), first);
    pieces_.insert(pieces_.begin() + static_cast<std::ptrdiff_t>(i) + 1, std::move(after));
    return;
  }
}

SolidEnergy RodSolver::sum() const {
  SolidEnergy out;
  for (const RodPiece& piece : pieces_) {
    const SolidEnergy of = piece.stepper.energy(piece.state);
    out.strain_j += of.strain_j;
    out.kinetic_j += of.kinetic_j;
  }
  return out;
}

std::vector<Vec3> RodSolver::of_grips(std::vector<Vec3> RodState::*force) const {
  std::vector<Vec3> out(supports_.grips.size(), Vec3::Zero());
  for (const RodPiece& piece : pieces_)
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += (piece.state.*force)[i];
  return out;
}

Vec3 RodSolver::probe_moved(std::size_t i) const {
  const RodProbe& p = probes_[i];
  const auto holder = std::find_if(pieces_.begin(), pieces_.end(), [&](const RodPiece& piece) {
    return p.segment < piece.first_segment + piece.stepper.rod().segments();
  });
  const Rod& rod = holder->stepper.rod();
  const std::size_t segment = p.segment - holder->first_segment;
  const auto at = [&](const std::vector<Vec3>& x, const std::vector<Quat>& q) {
    return Vec3((1 - p.share) * x[segment] + p.share * x[segment + 1] + q[segment] * p.aside_S);
  };
  return at(holder->state.at_W, holder->state.R_WS) - at(rod.start_W, rod.start_R_WS);
}

SolveShape RodSolver::shape() const {
  SolveShape out;
  out.corners_a_cell = 3;
  for (const RodPiece& piece : pieces_) {
    const Rod& rod = piece.stepper.rod();
    const RodSurface before = rod_surface(rod, rod.start_W, rod.start_R_WS);
    const RodSurface now = rod_surface(rod, piece.state.at_W, piece.state.R_WS);
    const auto first = static_cast<std::uint32_t>(out.points_m.size());
    for (std::size_t i = 0; i < now.points_W.size(); ++i) {
      out.moved_m.push_back(now.points_W[i] - before.points_W[i]);
      out.points_m.push_back(now.points_W[i]);
    }
    for (const std::uint32_t corner : now.triangles) out.corners.push_back(first + corner);
  }
  return out;
}

std::optional<LostPart> RodSolver::find_lost() const {
  for (const RodPiece& piece : pieces_)
    if (const auto lost = osteon::find_lost(piece.stepper.rod(), piece.state))
      return LostPart{"segment " + std::to_string(piece.first_segment + *lost),
                      piece.stepper.rod().start_W[*lost]};
  return std::nullopt;
}

// The inner node nearest to a place in the rod.
Result<DueCut> find_cut(const SolveScene& scene, const Rod& rod, std::size_t index, double step_s) {
  const RodCutPlace& cut = scene.cuts[index];
  const std::string key = "'cut[" + std::to_string(index) + "].at_mm'";
  const auto probe = find_rod_probe(rod, cut.at_m);
  if (!probe)
    return fail(key + " lies outside the rod", scene.name,
                "Move it into the rod, within its radius of the middle line");
  const std::size_t node = probe->segment + (probe->share > 0.5 ? 1 : 0);
  if (node == 0 || node == rod.segments())
    return fail(key + " is at the rod's end", scene.name,
                "A cut goes through the nearest of the rod's nodes: move it, or use more segments");
  return DueCut{static_cast<std::uint64_t>(std::llround(cut.at_s / step_s)), node};
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
    const auto probe = find_rod_probe(*rod, scene.probes_m[i]);
    if (!probe)
      return fail("'run.probe_mm[" + std::to_string(i) + "]' lies outside the body", scene.name,
                  "Move it into the rod, within its radius of the middle line");
    probes.push_back(*probe);
  }
  const double longest = fitting_step_s(*rod, *supports, scene.time_s);
  const double step_s = scene.time_s / static_cast<double>(steps_for(scene.time_s, longest));
  std::vector<DueCut> cuts;
  for (std::size_t i = 0; i < scene.cuts.size(); ++i) {
    const auto due = find_cut(scene, *rod, i, step_s);
    if (!due) return tl::unexpected(due.error());
    cuts.push_back(*due);
  }
  return std::make_unique<RodSolver>(RodPart{std::move(*rod), std::move(*supports), {}}, step_s,
                                     std::move(probes), std::move(cuts));
}

}  // namespace osteon
