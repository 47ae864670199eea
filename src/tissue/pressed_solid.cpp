#include "osteon/tissue/pressed_solid.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <map>

#include "hex/hex_stiffness.h"
#include "osteon/base/hash.h"
#include "pressed_solid_impl.h"

namespace osteon {

namespace {

using CellMatrix = Eigen::SparseMatrix<double>;

constexpr double kFinest_m = 0.0005, kFiner = 1.1;
constexpr double kLeastFill = 0.05;
constexpr double kPatchReach = 1.75;           // of a patch, cells
constexpr double kLifted = -0.2, kDown = 0.3;  // n . up between which a push is neither
constexpr double kMostLifted = 2;              // times as much as when pressed
constexpr std::size_t kLeastCells = 4;

// How much of a cell is solid: of 4 x 4 x 4 samples.
double fill_of(const DistanceField& field, const Vec3& lo, double cell_m) {
  int inside = 0;
  for (int i = 0; i < 64; ++i) {
    const Vec3 at(i % 4 + 0.5, i / 4 % 4 + 0.5, i / 16 + 0.5);
    if (field.at(lo + 0.25 * cell_m * at).distance < 0) ++inside;
  }
  return inside / 64.0;
}

FilledCells fill_cells(const PressedSolidDef& def, double cell_m) {
  FilledCells out;
  out.cell_m = cell_m;
  const Vec3 size = def.box.hi - def.box.lo;
  std::array<int, 3> n{};
  for (int k = 0; k < 3; ++k)
    n[static_cast<std::size_t>(k)] = std::max(1, static_cast<int>(std::ceil(size[k] / cell_m)));
  const Vec3 lo = 0.5 * (def.box.lo + def.box.hi) - 0.5 * cell_m * Vec3(n[0], n[1], n[2]);
  std::map<std::array<int, 3>, std::uint32_t> places;
  const auto node = [&](int x, int y, int z) {
    const auto [it, is_new] =
        places.emplace(std::array<int, 3>{x, y, z}, static_cast<std::uint32_t>(places.size()));
    if (is_new) out.nodes.push_back(lo + cell_m * Vec3(x, y, z));
    return it->second;
  };
  for (int z = 0; z < n[2]; ++z)
    for (int y = 0; y < n[1]; ++y)
      for (int x = 0; x < n[0]; ++x) {
        const double fill = fill_of(*def.field, lo + cell_m * Vec3(x, y, z), cell_m);
        if (fill < kLeastFill) continue;
        std::array<std::uint32_t, 8> corners{};
        for (int c = 0; c < 8; ++c)
          corners[static_cast<std::size_t>(c)] = node(x + c % 2, y + c / 2 % 2, z + c / 4);
        out.corners.push_back(corners);
        out.fill.push_back(fill);
      }
  return out;
}

// The finest cells that have no more nodes than wanted, from coarse ones on.
FilledCells choose_cells(const PressedSolidDef& def) {
  const Vec3 size = def.box.hi - def.box.lo;
  double cell_m = std::max(kFinest_m, size.maxCoeff() / 8);
  FilledCells best = fill_cells(def, cell_m);
  while (cell_m / kFiner >= kFinest_m) {
    FilledCells finer = fill_cells(def, cell_m /= kFiner);
    if (finer.nodes.size() > def.most_nodes) break;
    best = std::move(finer);
  }
  return best;
}

// With Young's modulus 1 Pa.
CellMatrix stiffness_of(const FilledCells& cells, const PressedSolidDef& def, bool lies) {
  const Eigen::Matrix<double, 24, 24> cube = cells.cell_m * unit_cube_stiffness(def.poisson);
  std::vector<Eigen::Triplet<double>> all;
  for (std::size_t e = 0; e < cells.corners.size(); ++e)
    for (int a = 0; a < 24; ++a)
      for (int b = 0; b < 24; ++b)
        all.emplace_back(
            static_cast<int>(3 * cells.corners[e][static_cast<std::size_t>(a / 3)]) + a % 3,
            static_cast<int>(3 * cells.corners[e][static_cast<std::size_t>(b / 3)]) + b % 3,
            cells.fill[e] * cube(a, b) +
                (a % 3 == b % 3 ? pulled_stiffness(cells, e, static_cast<std::size_t>(a / 3),
                                                   static_cast<std::size_t>(b / 3))
                                : 0));
  const double hold = kSupportHolds * cells.cell_m;
  for (std::size_t i = 0; i < cells.nodes.size(); ++i)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        double k = 0;
        if (def.held(cells.nodes[i]))
          k = r == c ? hold : 0;
        else if (lies && def.rests(cells.nodes[i]))
          k = hold * def.up[r] * def.up[c];
        all.emplace_back(static_cast<int>(3 * i) + r, static_cast<int>(3 * i) + c, k);
      }
  const auto size = static_cast<Eigen::Index>(3 * cells.nodes.size());
  CellMatrix out(size, size);
  out.setFromTriplets(all.begin(), all.end());
  return out;
}

tl::unexpected<Error> nothing_holds() {
  return fail("nothing holds the soft part, so it has no equilibrium", {},
              "It must lie on a bone and be held there");
}

Result<Eigen::MatrixXd> ways_of(const CellMatrix& stiffness) {
  const Eigen::SimplicialLLT<CellMatrix> factor(stiffness);
  Eigen::MatrixXd out;
  if (factor.info() == Eigen::Success)
    out = factor.solve(Eigen::MatrixXd::Identity(stiffness.rows(), stiffness.cols()));
  // One that nothing holds has ways without bound.
  if (out.size() > 0 && out.allFinite() && out.cwiseAbs().maxCoeff() < 1e12) return out;
  return nothing_holds();
}

// Fibres that were stretched by the same everywhere, let go: where nothing holds them they shorten
// until they pull no more. Symbols: u, ways then; s, stress along the fibres = what they were
// stretched to + lambda div u + 2 mu du/dt of a modulus of 1 Pa; none pushes.
Result<std::vector<double>> pull_of(const FilledCells& cells, const PressedSolidDef& def) {
  const double start = def.tension_pa / def.young_pa, h = cells.cell_m;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * cells.nodes.size()));
  for (std::size_t e = 0; e < cells.corners.size(); ++e)
    for (std::size_t c = 0; c < 8; ++c)
      force.segment<3>(3 * static_cast<Eigen::Index>(cells.corners[e][c])) -=
          0.25 * cells.fill[e] * h * h * start * along_fibres(cells, c) * cells.fibres;
  const CellMatrix stiffness = stiffness_of(cells, def, false);
  const Eigen::SimplicialLLT<CellMatrix> factor(stiffness);
  Eigen::VectorXd u;
  if (factor.info() == Eigen::Success) u = factor.solve(force);
  if (u.size() == 0 || !u.allFinite() || !(u.cwiseAbs().maxCoeff() < 1e3)) return nothing_holds();
  const double nu = def.poisson, mu = 0.5 / (1 + nu), lambda = nu / ((1 + nu) * (1 - 2 * nu));
  std::vector<double> out;
  for (const auto& corners : cells.corners) {
    double widens = 0, along = 0;
    for (std::size_t c = 0; c < 8; ++c) {
      const Vec3 way = u.segment<3>(3 * static_cast<Eigen::Index>(corners[c]));
      const Vec3 sign((c & 1) ? 1 : -1, (c & 2) ? 1 : -1, (c & 4) ? 1 : -1);
      widens += sign.dot(way) / (4 * h);
      along += along_fibres(cells, c) * cells.fibres.dot(way) / (4 * h);
    }
    out.push_back(std::max(0.0, start + lambda * widens + 2 * mu * along));
  }
  return out;
}

double lying_share(const Vec3& nhat, const Vec3& up) {
  const double t = std::clamp((nhat.dot(up) - kLifted) / (kDown - kLifted), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

bool PressedSolid::Impl::can_lie() const {
  for (std::size_t n = 0; n < rests.size(); ++n)
    if (rests[n] && !held[n]) return true;
  return false;
}

double PressedSolid::Impl::share(const SolidPush& push) const { return lying_share(push.nhat, up); }

// Of a node, for each newton of the push.
Vec3 PressedSolid::Impl::way(const Eigen::MatrixXd& ways, std::uint32_t node,
                             const SolidPush& push) const {
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t i = 0; i < push.patch.count; ++i) {
    const Eigen::Index column = 3 * static_cast<Eigen::Index>(push.patch.node[i]);
    for (int c = 0; c < 3; ++c) {
      const double f = -push.patch.weight[i] * push.nhat[c];
      const double* w = ways.data() + (column + c) * ways.rows() + 3 * Eigen::Index{node};
      for (int r = 0; r < 3; ++r) sum[r] += w[r] * f;
    }
  }
  return sum;
}

// Of a place along its normal, for each newton of the push.
double PressedSolid::Impl::yields(const SolidPush& at, const SolidPush& push, double share) const {
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t i = 0; i < at.patch.count; ++i) {
    const double weight = at.patch.weight[i];
    if (share > 0) sum += weight * share * way(lying, at.patch.node[i], push);
    if (share < 1) sum += weight * (1 - share) * way(lifted, at.patch.node[i], push);
  }
  return -at.nhat.dot(sum);
}

PressedSolid::PressedSolid(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
PressedSolid::~PressedSolid() = default;
PressedSolid::PressedSolid(PressedSolid&&) noexcept = default;
PressedSolid& PressedSolid::operator=(PressedSolid&&) noexcept = default;

Result<PressedSolid> PressedSolid::make(const PressedSolidDef& def) {
  auto impl = std::make_unique<Impl>();
  impl->cells = choose_cells(def);
  impl->up = def.up;
  if (impl->cells.corners.size() < kLeastCells)
    return fail("the soft part is too small to be felt as a solid", {}, "Leave it out");
  impl->cells.fibres = def.fibres;
  if (def.young_pa > 0 && def.tension_pa > 0) {
    auto pull = pull_of(impl->cells, def);
    if (!pull) return tl::unexpected(pull.error());
    impl->cells.pull = std::move(*pull);
  }
  for (const Vec3& p : impl->cells.nodes) {
    impl->held.push_back(def.held(p) ? 1 : 0);
    impl->rests.push_back(def.rests(p) ? 1 : 0);
  }
  auto lifted = ways_of(stiffness_of(impl->cells, def, false));
  if (!lifted) return tl::unexpected(lifted.error());
  impl->lifted = std::move(*lifted);
  impl->lying = impl->lifted;
  if (impl->can_lie()) {
    auto lying = ways_of(stiffness_of(impl->cells, def, true));
    if (!lying) return tl::unexpected(lying.error());
    impl->lying = std::move(*lying);
  }
  impl->stiffness_n_per_m = def.stiffness_n_per_m;
  impl->poisson = def.poisson;
  impl->young_pa = def.young_pa;
  return PressedSolid(std::move(impl));
}

// The parts of cells that are connected with the one whose middle is nearest, two parts far: a push
// on one side of a slit does nothing to the other side. Weights as below; where all nodes are too
// far off, the nearest one alone.
SolidPatch PressedSolid::Impl::patch_of_cut(const Vec3& p) const {
  SolidPatch out;
  std::uint32_t nearest = 0;
  for (std::uint32_t e = 1; e < middles.size(); ++e)
    if ((middles[e] - p).squaredNorm() < (middles[nearest] - p).squaredNorm()) nearest = e;
  constexpr std::size_t kMostNear = 96;
  std::array<std::uint32_t, kMostNear> near{nearest};
  std::size_t count = 1, first = 0;
  for (int ring = 0; ring < 2; ++ring) {
    const std::size_t last = count;
    for (; first < last; ++first)
      for (const std::uint32_t to : links[near[first]])
        if (count < kMostNear && std::find(near.begin(), near.begin() + count, to) ==
                                     near.begin() + static_cast<std::ptrdiff_t>(count))
          near[count++] = to;
  }
  const double reach = kPatchReach * cells.cell_m;
  double sum = 0, closest = 1e9;
  std::uint32_t closest_node = cells.corners[nearest][0];
  for (std::size_t i = 0; i < count; ++i)
    for (const std::uint32_t n : cells.corners[near[i]]) {
      const double d2 = (cells.nodes[n] - p).squaredNorm(), left = 1 - d2 / (reach * reach);
      if (i == 0 && d2 < closest) {
        closest = d2;
        closest_node = n;
      }
      const auto end = out.node.begin() + out.count;
      if (!(left > 0) || out.count == SolidPatch::kMost ||
          std::find(out.node.begin(), end, n) != end)
        continue;
      out.node[out.count] = n;
      out.weight[out.count++] = left * left;
      sum += left * left;
    }
  if (out.count == 0) {
    out.count = 1;
    out.node[0] = closest_node;
    out.weight[0] = sum = 1;
  }
  for (std::uint32_t i = 0; i < out.count; ++i) out.weight[i] /= sum;
  return out;
}

// w = (1 - d^2 / reach^2)^2: smooth where a node comes in.
SolidPatch PressedSolid::patch_at(const Vec3& p) const {
  if (impl_->whole) return impl_->patch_of_cut(p);
  SolidPatch out;
  const double reach = kPatchReach * impl_->cells.cell_m;
  const auto& nodes = impl_->cells.nodes;
  double sum = 0;
  for (std::size_t i = 0; i < nodes.size() && out.count < SolidPatch::kMost; ++i) {
    const double left = 1 - (nodes[i] - p).squaredNorm() / (reach * reach);
    if (!(left > 0)) continue;
    out.node[out.count] = static_cast<std::uint32_t>(i);
    out.weight[out.count++] = left * left;
    sum += left * left;
  }
  for (std::uint32_t i = 0; i < out.count; ++i) out.weight[i] /= sum;
  return out;
}

// gain = 1 / (k c) for c, what the lying solid yields there: it makes a press from above meet k. Of
// a lifted one it is less where c would be more than the most.
SolidPush PressedSolid::push_at(const Vec3& p, const Vec3& nhat, double force_n) const {
  SolidPush push{patch_at(p), nhat, force_n, 1};
  if (impl_->whole) {
    push.gain = impl_->whole->push_at(p, nhat).gain;
    return push;
  }
  if (impl_->young_pa > 0) {
    push.gain = 1 / impl_->young_pa;
    return push;
  }
  const double lying = impl_->yields(push, push, 1);
  const double now = impl_->yields(push, push, impl_->share(push));
  const double held_back = now > 0 ? std::min(1.0, kMostLifted * lying / now) : 1;
  push.gain = lying > 0 ? held_back / (impl_->stiffness_n_per_m * lying) : 0;
  return push;
}

// The gains' geometric mean keeps what two places do to one another mutual.
double PressedSolid::compliance(const SolidPush& at, const SolidPush& push) const {
  const auto between = [this](const SolidPush& a, const SolidPush& b) {
    const double share = 0.5 * (impl_->share(a) + impl_->share(b));
    return std::sqrt(a.gain * b.gain) * impl_->yields(a, b, share);
  };
  const double both = between(at, push);
  // A flap that hardly hangs on anything still is no air.
  constexpr double kSoftest = 25;
  if (&at == &push)
    return impl_->whole ? std::min(both, kSoftest / impl_->stiffness_n_per_m) : both;
  // Less than what the two do to themselves: else tools on both sides would press each other on
  // without end, since shares and gains differ from one side to the other.
  constexpr double kMutual = 0.95;
  const double most = kMutual * std::sqrt(std::max(0.0, between(at, at) * between(push, push)));
  return std::clamp(both, -most, most);
}

std::vector<Vec3> PressedSolid::moved(std::span<const SolidPush> pushes) const {
  std::vector<Vec3> out(nodes(), Vec3::Zero());
  for (const SolidPush& push : pushes) {
    const double share = impl_->share(push), per = push.force_n * push.gain;
    for (std::uint32_t n = 0; n < out.size() && per > 0; ++n)
      out[n] += per * (share * impl_->way(impl_->lying, n, push) +
                       (1 - share) * impl_->way(impl_->lifted, n, push));
  }
  return out;
}

Vec3 PressedSolid::moved_at(const SolidPatch& patch, std::span<const Vec3> moved) {
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t i = 0; i < patch.count; ++i) sum += patch.weight[i] * moved[patch.node[i]];
  return sum;
}

Vec3 PressedSolid::node_at(std::size_t node) const { return impl_->cells.nodes[node]; }
std::size_t PressedSolid::nodes() const { return impl_->cells.nodes.size(); }
std::size_t PressedSolid::cells() const { return impl_->cells.corners.size(); }
double PressedSolid::cell_m() const { return impl_->cells.cell_m; }
Vec3 PressedSolid::cell_lo(std::size_t cell) const {
  return impl_->cells.nodes[impl_->cells.corners[cell][0]];
}

std::uint64_t PressedSolid::hash() const {
  Hasher h;
  h.add(impl_->cells.cell_m);
  h.add(impl_->stiffness_n_per_m);
  h.add(impl_->up);
  if (impl_->young_pa > 0) h.add(impl_->young_pa);
  for (const Vec3& p : impl_->cells.nodes) h.add(p);
  for (const Eigen::MatrixXd* ways : {&impl_->lying, &impl_->lifted})
    h.bytes(ways->data(), static_cast<std::size_t>(ways->size()) * sizeof(double));
  return h.value();
}

}  // namespace osteon
