// The balance of a sheet under tension on its fat.
//
// Symbols: T tension before any cut (N/m, the same in all directions), C plane-stress stiffness of
// the membrane (N/m), u ways in the plane, N = T I + C:grad u tension now, t tether, w dent, k and
// H stiffness and thickness of the fat, p pressure.
//   in the plane:   int (C grad u):grad v + t u.v = - int T div v     (lips are free: N n = 0)
//   across it:      int grad w.N grad v + p_f(w) v = int p v,  p_f = k w / (1 - w / H), w > 0
//                                                              p_f = k w,               w <= 0
// with constant-strain triangles, the rim held. The fat's part is lumped to the vertices. N is cut
// down to what pulls, since skin folds rather than pushes; so the energy across is convex and
// Newton's method has one answer to find. Each step is shortened so that every dent stays within
// the fat (w < H), and halved while the energy rises too steeply at its end. Where the way of a
// disc is given, its force is one more unknown: the multiplier of that way. It ends after
// kMostSteps.

#include "osteon/tissue/sheet_balance.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

#include "sheet/membrane.h"

namespace osteon {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Factor = Eigen::SimplicialLDLT<Sparse, Eigen::Lower>;
using Vector = Eigen::VectorXd;
using Index = Eigen::Index;

constexpr int kMostSteps = 200;
constexpr double kEnough = 1e-10;  // m: a step so short ends it

// Numbers of the unknowns: copies inside the rim, in their order; -1: held.
std::vector<int> number(const SkinSheet& sheet, const SplitSheet& split, int& count) {
  std::vector<int> out(split.vertex.size(), -1);
  count = 0;
  for (std::size_t i = 0; i < out.size(); ++i)
    if (!sheet.is_rim(split.vertex[i])) out[i] = count++;
  return out;
}

}  // namespace

struct SheetBalance::Impl {
  std::vector<SheetElement> elements;
  std::vector<int> at;
  int count = 0;
  Sparse across;             // grad w . N grad v
  std::vector<double> area;  // of each unknown: the fat's

  void open(const SkinSheet& sheet, const SplitSheet& split, std::vector<SheetPoint>& ways) const;
  void carry(const SplitSheet& split, const std::vector<std::array<double, 3>>& tension);
  Vector weights(const SheetLoad& load) const;
  Vector rest(const SheetMaterial& m, const Vector& w) const;     // what sheet and fat bear
  Sparse tangent(const SheetMaterial& m, const Vector& w) const;  // its derivative
};

void SheetBalance::Impl::open(const SkinSheet& sheet, const SplitSheet& split,
                              std::vector<SheetPoint>& ways) const {
  const SheetMaterial& m = sheet.material();
  const MembraneStiffness stiff(m);
  std::vector<Eigen::Triplet<double>> all;
  all.reserve(split.triangles.size() * 24);
  Vector load = Vector::Zero(2 * count);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const SheetElement& k = elements[e];
    for (std::size_t a = 0; a < 3; ++a) {
      const int i = at[split.triangles[e][a]];
      if (i < 0) continue;
      const SheetPoint& p = k.slope[a];
      load.segment<2>(2 * i) -= k.area * m.tension_n_per_m * p;
      for (int d = 0; d < 2; ++d)
        all.emplace_back(2 * i + d, 2 * i + d, k.area * m.tether_n_per_m3 / 3);
      for (std::size_t b = 0; b < 3; ++b) {
        const int j = at[split.triangles[e][b]];
        if (j < 0) continue;
        const Eigen::Matrix2d block = stiff.between(p, k.slope[b]);
        for (int r = 0; r < 2; ++r)
          for (int s = 0; s < 2; ++s)
            if (2 * i + r >= 2 * j + s)
              all.emplace_back(2 * i + r, 2 * j + s, k.area * block(r, s));
      }
    }
  }
  Sparse matrix(2 * count, 2 * count);
  matrix.setFromTriplets(all.begin(), all.end());
  const Vector u = Factor(matrix).solve(load);
  ways.assign(at.size(), SheetPoint::Zero());
  for (std::size_t i = 0; i < at.size(); ++i)
    if (at[i] >= 0) ways[i] = u.segment<2>(2 * at[i]);
}

void SheetBalance::Impl::carry(const SplitSheet& split,
                               const std::vector<std::array<double, 3>>& tension) {
  std::vector<Eigen::Triplet<double>> all;
  all.reserve(split.triangles.size() * 6);
  area.assign(static_cast<std::size_t>(count), 0);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const SheetElement& k = elements[e];
    const auto& n = tension[e];
    for (std::size_t a = 0; a < 3; ++a) {
      const int i = at[split.triangles[e][a]];
      if (i < 0) continue;
      area[static_cast<std::size_t>(i)] += k.area / 3;
      const SheetPoint p(n[0] * k.slope[a].x() + n[2] * k.slope[a].y(),
                         n[2] * k.slope[a].x() + n[1] * k.slope[a].y());
      for (std::size_t b = 0; b < 3; ++b) {
        const int j = at[split.triangles[e][b]];
        if (j >= 0 && i >= j) all.emplace_back(i, j, k.area * p.dot(k.slope[b]));
      }
    }
  }
  across.resize(count, count);
  across.setFromTriplets(all.begin(), all.end());
}

Vector SheetBalance::Impl::weights(const SheetLoad& load) const {
  Vector out = Vector::Zero(count);
  for (std::size_t i = 0; i < load.copy.size(); ++i)
    if (at[load.copy[i]] >= 0) out[at[load.copy[i]]] += load.weight[i];
  return out;
}

Vector SheetBalance::Impl::rest(const SheetMaterial& m, const Vector& w) const {
  Vector out = across.selfadjointView<Eigen::Lower>() * w;
  for (Index i = 0; i < w.size(); ++i) {
    const double left = w[i] > 0 ? 1 - w[i] / m.fat_m : 1;
    out[i] += area[static_cast<std::size_t>(i)] * m.foundation_n_per_m3 * w[i] / left;
  }
  return out;
}

Sparse SheetBalance::Impl::tangent(const SheetMaterial& m, const Vector& w) const {
  Sparse out = across;
  for (Index i = 0; i < w.size(); ++i) {
    const double left = w[i] > 0 ? 1 - w[i] / m.fat_m : 1;
    out.coeffRef(i, i) += area[static_cast<std::size_t>(i)] * m.foundation_n_per_m3 / (left * left);
  }
  return out;
}

SheetBalance::SheetBalance(const SkinSheet& sheet, SplitSheet split)
    : sheet_(&sheet), split_(std::move(split)), impl_(std::make_unique<Impl>()) {
  for (const Triangle& t : split_.triangles) impl_->elements.push_back(element_of(split_, t));
  impl_->at = number(sheet, split_, impl_->count);
  const double before = sheet.material().tension_n_per_m;
  tension_.assign(split_.triangles.size(), {before, before, 0});
  ways_.assign(split_.vertex.size(), SheetPoint::Zero());
  // Without a lip there is nothing to open.
  if (!split_.walls.empty()) {
    impl_->open(sheet, split_, ways_);
    const MembraneStiffness stiff(sheet.material());
    for (std::size_t e = 0; e < tension_.size(); ++e) {
      Eigen::Matrix2d grad = Eigen::Matrix2d::Zero();
      for (std::size_t a = 0; a < 3; ++a)
        grad += ways_[split_.triangles[e][a]] * impl_->elements[e].slope[a].transpose();
      const auto more = stiff.tension(grad);
      tension_[e] = pulling_part({before + more[0], before + more[1], more[2]});
    }
  }
  impl_->carry(split_, tension_);
}

SheetBalance::~SheetBalance() = default;

SheetDent SheetBalance::solve(const SheetLoad& load, std::optional<double> force_n, double mean_m,
                              const SheetDent& from) const {
  const Impl& im = *impl_;
  const SheetMaterial& m = sheet_->material();
  const auto n = static_cast<Index>(im.count);
  const Vector b = im.weights(load);
  Vector w = Vector::Zero(n);
  if (from.down_m.size() == im.at.size())
    for (std::size_t i = 0; i < im.at.size(); ++i)
      if (im.at[i] >= 0) w[im.at[i]] = from.down_m[i];
  double force = force_n.value_or(from.force_n);
  Factor factor;
  factor.analyzePattern(im.across);
  for (int step = 0; step < kMostSteps; ++step) {
    factor.factorize(im.tangent(m, w));
    const Vector rest = im.rest(m, w) - force * b;
    Vector way = factor.solve(-rest);
    bool meets = true;
    if (!force_n) {
      const Vector by = factor.solve(b);
      const double short_of = mean_m - b.dot(w), more = (short_of - b.dot(way)) / b.dot(by);
      meets = std::abs(short_of) < 1e-9 * m.fat_m;
      way += more * by;
      force += more;
    }
    double share = 1;
    for (Index i = 0; i < n; ++i)
      if (way[i] > 0) share = std::min(share, 0.9 * (m.fat_m - w[i]) / way[i]);
    const double falls = (im.rest(m, w) - force * b).dot(way);
    const auto rises = [&] { return (im.rest(m, w + share * way) - force * b).dot(way); };
    for (int half = 0; meets && half < 40 && !(rises() <= -0.5 * falls); ++half) share *= 0.5;
    w += share * way;
    if (!(way.cwiseAbs().maxCoeff() > kEnough)) break;
  }
  SheetDent out;
  out.down_m.assign(im.at.size(), 0);
  for (std::size_t i = 0; i < im.at.size(); ++i)
    if (im.at[i] >= 0) out.down_m[i] = w[im.at[i]];
  out.force_n = force;
  out.mean_m = b.dot(w);
  return out;
}

SheetDent SheetBalance::pressed(const SheetLoad& load, double force_n,
                                const SheetDent& from) const {
  return solve(load, force_n, 0, from);
}

SheetDent SheetBalance::pressed_by(const SheetLoad& load, double mean_m,
                                   const SheetDent& from) const {
  return solve(load, {}, mean_m, from);
}

double SheetBalance::stiffness(const SheetLoad& load) const {
  const Vector b = impl_->weights(load);
  const Factor factor(impl_->tangent(sheet_->material(), Vector::Zero(b.size())));
  return 1 / b.dot(factor.solve(b));
}

}  // namespace osteon
