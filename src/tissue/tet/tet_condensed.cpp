#include "tet/tet_condensed.h"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <map>

#include "tet/tet_element.h"

namespace osteon {

/// Where an unknown is: which set, and its place there.
struct CondensedPlace {
  int set = 0;  ///< 0 surface, 1 inside, 2 held
  Eigen::Index at = 0;
};

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Entries = std::vector<Eigen::Triplet<double>>;
using Column = Eigen::VectorXd;

// Gradients of an element's shape functions at a point of integration.
std::array<Vec3, 10> shape_slopes(const TetSolid& solid, const TetElement& e, std::size_t q) {
  std::array<Vec3, 10> out;
  const TetPoints& points = points_of(solid.order);
  for (std::size_t a = 0; a < solid.nodes_an_element(); ++a) {
    NodeVectors unit;
    unit.fill(Vec3::Zero());
    unit[a] = Vec3::UnitX();
    const CornerVectors w = slope_weights(solid.order, points.at[q], unit);
    out[a].setZero();
    for (std::size_t k = 0; k < 4; ++k) out[a] += w[k].x() * e.slope[k];
  }
  return out;
}

void add_element(const TetSolid& solid, const TetElement& e, Entries& all) {
  const double mu = shear_modulus_pa(solid.material);
  const double lambda = bulk_modulus_pa(solid.material) - 2.0 / 3 * mu;
  const std::size_t count = points_of(solid.order).count;
  for (std::size_t q = 0; q < count; ++q) {
    const auto g = shape_slopes(solid, e, q);
    for (std::size_t a = 0; a < solid.nodes_an_element(); ++a)
      for (std::size_t b = 0; b < solid.nodes_an_element(); ++b) {
        Mat3 k = lambda * g[a] * g[b].transpose() + mu * g[b] * g[a].transpose();
        k.diagonal().array() += mu * g[a].dot(g[b]);
        k *= e.volume_m3 / static_cast<double>(count);
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c)
            all.emplace_back(3 * static_cast<int>(e.node[a]) + r,
                             3 * static_cast<int>(e.node[b]) + c, k(r, c));
      }
  }
}

std::vector<CondensedPlace> sort_unknowns(const TetSolid& solid, const Supports& supports,
                                          std::array<Eigen::Index, 3>& sizes) {
  std::vector<CondensedPlace> out(3 * solid.rest_W.size(), CondensedPlace{1, 0});
  for (const std::uint32_t n : surface_nodes(solid))
    for (std::size_t k = 0; k < 3; ++k) out[3 * n + k].set = 0;
  for (const HeldAxis& h : supports.held) out[3 * h.slot + h.axis].set = 2;
  for (CondensedPlace& w : out) w.at = sizes[static_cast<std::size_t>(w.set)]++;
  return out;
}

/// The part of the whole matrix with rows of one set and columns of another.
Matrix part(const Entries& all, const std::vector<CondensedPlace>& where,
            const std::array<Eigen::Index, 3>& sizes, int rows, int columns) {
  Entries chosen;
  for (const auto& t : all) {
    const CondensedPlace &r = where[static_cast<std::size_t>(t.row())],
                         &c = where[static_cast<std::size_t>(t.col())];
    if (r.set == rows && c.set == columns)
      chosen.emplace_back(static_cast<int>(r.at), static_cast<int>(c.at), t.value());
  }
  Matrix out(sizes[static_cast<std::size_t>(rows)], sizes[static_cast<std::size_t>(columns)]);
  out.setFromTriplets(chosen.begin(), chosen.end());
  return out;
}

}  // namespace

std::vector<std::uint32_t> surface_nodes(const TetSolid& solid) {
  constexpr std::size_t kFaces[4][3] = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
  constexpr std::size_t kEdges[4][3] = {{4, 5, 7}, {4, 6, 8}, {5, 6, 9}, {7, 8, 9}};
  std::map<std::array<std::uint32_t, 3>, int> met;
  const auto key = [](const TetElement& e, const std::size_t(&f)[3]) {
    std::array<std::uint32_t, 3> out{e.node[f[0]], e.node[f[1]], e.node[f[2]]};
    std::sort(out.begin(), out.end());
    return out;
  };
  for (const TetElement& e : solid.elements)
    for (const auto& f : kFaces) ++met[key(e, f)];
  std::vector<std::uint32_t> out;
  for (const TetElement& e : solid.elements)
    for (std::size_t f = 0; f < 4; ++f) {
      if (met[key(e, kFaces[f])] != 1) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        out.push_back(e.node[kFaces[f][k]]);
        if (solid.order == TetOrder::kQuadratic) out.push_back(e.node[kEdges[f][k]]);
      }
    }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

struct CondensedSolid::Impl {
  TetSolid solid;
  Supports supports;
  std::array<Eigen::Index, 3> sizes{};  // surface, inside, held
  std::vector<CondensedPlace> where;
  Matrix si, sh, ih;
  Eigen::SimplicialLDLT<Matrix> inside;
  Eigen::LDLT<Eigen::MatrixXd> surface;

  Column outer(double time_s, int set) const;
  Column held_m(double time_s) const;
};

Column CondensedSolid::Impl::outer(double time_s, int set) const {
  Column out = Column::Zero(sizes[static_cast<std::size_t>(set)]);
  const auto add = [&](std::size_t node, const Vec3& f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const CondensedPlace& w = where[3 * node + k];
      if (w.set == set) out[w.at] += f[static_cast<Eigen::Index>(k)];
    }
  };
  for (std::size_t i = 0; i < solid.rest_W.size(); ++i)
    add(i, solid.mass_kg[i] * supports.gravity_m_per_s2);
  for (const NodeLoad& load : supports.loads)
    add(load.slot, smooth_ramp(time_s, load.over_s).share * load.force_n);
  return out;
}

Column CondensedSolid::Impl::held_m(double time_s) const {
  Column out = Column::Zero(sizes[2]);
  for (const HeldAxis& h : supports.held)
    out[where[3 * h.slot + h.axis].at] = h.to_m * smooth_ramp(time_s, h.over_s).share;
  return out;
}

CondensedSolid::CondensedSolid(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
CondensedSolid::~CondensedSolid() = default;
CondensedSolid::CondensedSolid(CondensedSolid&&) noexcept = default;

const TetSolid& CondensedSolid::solid() const { return impl_->solid; }
std::size_t CondensedSolid::surface_nodes() const {
  return osteon::surface_nodes(impl_->solid).size();
}

Result<CondensedSolid> CondensedSolid::make(TetSolid solid, Supports supports) {
  constexpr Eigen::Index kMostUnknowns = 6000;
  auto impl = std::make_unique<Impl>();
  impl->solid = std::move(solid);
  impl->supports = std::move(supports);
  impl->where = sort_unknowns(impl->solid, impl->supports, impl->sizes);
  if (impl->sizes[0] > kMostUnknowns)
    return fail("'material.condensed': the surface has " + std::to_string(impl->sizes[0] / 3) +
                    " free nodes, more than " + std::to_string(kMostUnknowns / 3),
                {}, "Use fewer, larger cells, or leave out condensed");
  Entries all;
  for (const TetElement& e : impl->solid.elements) add_element(impl->solid, e, all);
  const auto cut = [&](int r, int c) { return part(all, impl->where, impl->sizes, r, c); };
  impl->si = cut(0, 1);
  impl->sh = cut(0, 2);
  impl->ih = cut(1, 2);
  Eigen::MatrixXd k = cut(0, 0);
  if (impl->sizes[1] > 0) {
    impl->inside.compute(cut(1, 1));
    const Eigen::MatrixXd is = impl->si.transpose();
    k -= impl->si * impl->inside.solve(is);
  }
  impl->surface.compute(k);
  const Column pivots = impl->surface.vectorD();
  if (pivots.size() > 0 && !(pivots.minCoeff() > 1e-11 * pivots.maxCoeff()))
    return fail("'fixed': the supports leave the body free to move, so it has no equilibrium", {},
                "Hold it so that it can neither move nor turn");
  return CondensedSolid(std::move(impl));
}

SolidState CondensedSolid::solve(double time_s) const {
  const Impl& m = *impl_;
  const Column held = m.held_m(time_s);
  Column fi = m.outer(time_s, 1) - m.ih * held, fs = m.outer(time_s, 0) - m.sh * held;
  const bool has_inside = m.sizes[1] > 0;
  if (has_inside) fs -= m.si * Column(m.inside.solve(fi));
  const Column us = m.surface.solve(fs);
  Column ui = Column::Zero(m.sizes[1]);
  if (has_inside) ui = m.inside.solve(Column(fi - m.si.transpose() * us));
  SolidState state = state_at_rest(m.solid.rest_W.size(), true);
  const Column* sets[3] = {&us, &ui, &held};
  for (std::size_t i = 0; i < m.where.size(); ++i)
    state.moved_m[i % 3][i / 3] = (*sets[m.where[i].set])[m.where[i].at];
  return state;
}

double CondensedSolid::strain_j(const SolidState& state) const {
  const TetSolid& solid = impl_->solid;
  return strain_energy_j(solid, state.moved_m, rotations(solid, state.moved_m));
}

std::vector<Vec3> CondensedSolid::reactions(const SolidState& state, double time_s) const {
  const Impl& m = *impl_;
  std::vector<Vec3> sum(m.supports.entries, Vec3::Zero());
  const SolidState::Field elastic = elastic_forces(m.solid, state);
  const Column outer = m.outer(time_s, 2);
  for (const HeldAxis& h : m.supports.held)
    sum[h.entry][h.axis] -= elastic[h.axis][h.slot] + outer[m.where[3 * h.slot + h.axis].at];
  return sum;
}

}  // namespace osteon
