// The balance of a cut sheet in pieces: what SheetBalance solves at once, with matrices whose rows
// keep a profile. Unknowns are numbered along the sheet's rows, so that the profile is as wide as
// the sheet, and factoring a known number of products.
//
// Pieces: the split and its numbers; the matrix in the plane; its factor, so many products a piece;
// the ways and the tension that is left; the matrix across and its factor. Without a lip only the
// last two are needed. It ends, since each piece of a factor does at least one row.

#include "osteon/tissue/sheet_work.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sheet/membrane.h"
#include "sheet/profile_matrix.h"

namespace osteon {
namespace {

constexpr std::size_t kProducts = 200'000;  // a piece: some tenths of a millisecond

// Unknowns of the copies inside the rim, in the order of their vertices.
std::vector<int> number_by_rows(const SkinSheet& sheet, const SplitSheet& split, int& count) {
  std::vector<std::uint32_t> order(split.vertex.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return split.vertex[a] < split.vertex[b];
  });
  std::vector<int> at(split.vertex.size(), -1);
  count = 0;
  for (const std::uint32_t i : order)
    if (!sheet.is_rim(split.vertex[i])) at[i] = count++;
  return at;
}

// Of each unknown the first one that shares a triangle with it.
std::vector<std::uint32_t> profile(const SplitSheet& split, const std::vector<int>& at, int count) {
  std::vector<std::uint32_t> first(static_cast<std::size_t>(count));
  std::iota(first.begin(), first.end(), 0U);
  for (const Triangle& t : split.triangles) {
    int least = count;
    for (const std::uint32_t c : t)
      if (at[c] >= 0) least = std::min(least, at[c]);
    for (const std::uint32_t c : t)
      if (at[c] >= 0) {
        auto& mine = first[static_cast<std::size_t>(at[c])];
        mine = std::min(mine, static_cast<std::uint32_t>(least));
      }
  }
  return first;
}

}  // namespace

struct SheetWork::Impl {
  enum class Piece { kPlane, kPlaneFactor, kTension, kAcrossFactor, kDone };

  Impl(const SkinSheet& of, const SheetCuts& cuts);
  void begin_plane();
  void open();
  void begin_across();

  const SkinSheet& sheet;
  std::unique_ptr<SheetYield> out = std::make_unique<SheetYield>();
  std::vector<SheetElement> elements;
  std::vector<std::uint32_t> first;
  std::vector<std::array<double, 3>> tension;
  std::vector<double> ways;  // of each unknown, x and y
  ProfileMatrix plane, across;
  int count = 0;
  Piece next = Piece::kPlane;
};

SheetWork::Impl::Impl(const SkinSheet& of, const SheetCuts& cuts) : sheet(of) {
  SheetYield& y = *out;
  y.split_ = osteon::split(sheet, cuts);
  y.edge_m_ = sheet.edge_m();
  y.ways_.assign(y.split_.vertex.size(), SheetPoint::Zero());
  y.at_ = number_by_rows(sheet, y.split_, count);
  first = profile(y.split_, y.at_, count);
  for (const Triangle& t : y.split_.triangles) elements.push_back(element_of(y.split_, t));
  const double before = sheet.material().tension_n_per_m;
  tension.assign(elements.size(), {before, before, 0});
}

void SheetWork::Impl::begin_plane() {
  const SheetMaterial& m = sheet.material();
  const MembraneStiffness stiff(m);
  const SheetYield& y = *out;
  std::vector<std::uint32_t> both;
  for (const std::uint32_t f : first)
    for (int d = 0; d < 2; ++d) both.push_back(2 * f);
  plane = ProfileMatrix(std::move(both));
  ways.assign(2 * first.size(), 0);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const SheetElement& k = elements[e];
    for (std::size_t a = 0; a < 3; ++a) {
      const int ia = y.at_[y.split_.triangles[e][a]];
      if (ia < 0) continue;
      const auto i = 2 * static_cast<std::size_t>(ia);
      for (std::size_t d = 0; d < 2; ++d) {
        ways[i + d] -= k.area * m.tension_n_per_m * k.slope[a][static_cast<Eigen::Index>(d)];
        plane.at(i + d, i + d) += k.area * m.tether_n_per_m3 / 3;
      }
      for (std::size_t b = 0; b < 3; ++b) {
        const int jb = y.at_[y.split_.triangles[e][b]];
        if (jb < 0 || jb > ia) continue;
        const auto j = 2 * static_cast<std::size_t>(jb);
        const Eigen::Matrix2d block = k.area * stiff.between(k.slope[a], k.slope[b]);
        for (std::size_t r = 0; r < 2; ++r)
          for (std::size_t s = 0; s < 2 && j + s <= i + r; ++s)
            plane.at(i + r, j + s) +=
                block(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(s));
      }
    }
  }
}

void SheetWork::Impl::open() {
  plane.solve(ways);
  SheetYield& y = *out;
  for (std::size_t i = 0; i < y.at_.size(); ++i)
    if (y.at_[i] >= 0) {
      const auto u = 2 * static_cast<std::size_t>(y.at_[i]);
      y.ways_[i] = {ways[u], ways[u + 1]};
    }
  const MembraneStiffness stiff(sheet.material());
  for (std::size_t e = 0; e < tension.size(); ++e) {
    Eigen::Matrix2d grad = Eigen::Matrix2d::Zero();
    for (std::size_t a = 0; a < 3; ++a)
      grad += y.ways_[y.split_.triangles[e][a]] * elements[e].slope[a].transpose();
    const auto more = stiff.tension(grad);
    tension[e] =
        pulling_part({tension[e][0] + more[0], tension[e][1] + more[1], tension[e][2] + more[2]});
  }
}

void SheetWork::Impl::begin_across() {
  const SheetYield& y = *out;
  across = ProfileMatrix(first);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const SheetElement& k = elements[e];
    const auto& n = tension[e];
    for (std::size_t a = 0; a < 3; ++a) {
      const int i = y.at_[y.split_.triangles[e][a]];
      if (i < 0) continue;
      const auto row = static_cast<std::size_t>(i);
      across.at(row, row) += k.area / 3 * sheet.material().foundation_n_per_m3;
      const SheetPoint p(n[0] * k.slope[a].x() + n[2] * k.slope[a].y(),
                         n[2] * k.slope[a].x() + n[1] * k.slope[a].y());
      for (std::size_t b = 0; b < 3; ++b) {
        const int j = y.at_[y.split_.triangles[e][b]];
        if (j >= 0 && i >= j)
          across.at(row, static_cast<std::size_t>(j)) += k.area * p.dot(k.slope[b]);
      }
    }
  }
}

SheetWork::SheetWork(const SkinSheet& sheet, const SheetCuts& cuts)
    : impl_(std::make_unique<Impl>(sheet, cuts)) {}
SheetWork::~SheetWork() = default;

bool SheetWork::step() {
  Impl& in = *impl_;
  using Piece = Impl::Piece;
  switch (in.next) {
    case Piece::kPlane:
      if (in.out->split_.walls.empty()) {
        in.begin_across();
        in.next = Piece::kAcrossFactor;
      } else {
        in.begin_plane();
        in.next = Piece::kPlaneFactor;
      }
      return false;
    case Piece::kPlaneFactor:
      if (in.plane.factor(kProducts)) in.next = Piece::kTension;
      return false;
    case Piece::kTension:
      in.open();
      in.begin_across();
      in.next = Piece::kAcrossFactor;
      return false;
    case Piece::kAcrossFactor:
      if (in.across.factor(kProducts)) in.next = Piece::kDone;
      return in.next == Piece::kDone;
    case Piece::kDone:
      break;
  }
  return true;
}

std::unique_ptr<const SheetYield> SheetWork::take() {
  SheetYield& y = *impl_->out;
  y.first_ = std::move(impl_->across.first_);
  y.start_ = std::move(impl_->across.start_);
  y.rows_ = std::move(impl_->across.rows_);
  y.pivots_ = std::move(impl_->across.pivots_);
  if (!y.split_.walls.empty())
    y.plane_ = std::make_shared<const ProfileMatrix>(std::move(impl_->plane));
  return std::move(impl_->out);
}

// As load_on samples a disc, but what is not on the sheet bears nothing.
bool SheetYield::put_load(const SheetDisc& disc, SheetScratch& scratch) const {
  constexpr double kHalfSqrt3 = 0.8660254037844386;
  scratch.load.assign(pivots_.size(), 0);
  scratch.near.clear();
  for (std::uint32_t t = 0; t < split_.triangles.size(); ++t) {
    const Triangle& tri = split_.triangles[t];
    const SheetPoint &a = split_.point[tri[0]], &b = split_.point[tri[1]],
                     &c = split_.point[tri[2]];
    const SheetPoint lo = a.cwiseMin(b).cwiseMin(c), hi = a.cwiseMax(b).cwiseMax(c);
    if ((disc.p - hi).maxCoeff() <= disc.radius_m && (lo - disc.p).maxCoeff() <= disc.radius_m)
      scratch.near.push_back(t);
  }
  const int rings = static_cast<int>(std::clamp(2 * disc.radius_m / edge_m_, 5.0, 40.0));
  const auto cross = [](const SheetPoint& u, const SheetPoint& v) {
    return u.x() * v.y() - u.y() * v.x();
  };
  int points = 0;
  for (int j = -2 * rings; j <= 2 * rings; ++j)
    for (int i = -2 * rings; i <= 2 * rings; ++i) {
      if (i * i + i * j + j * j > rings * rings) continue;
      const SheetPoint q = disc.p + disc.radius_m / rings * SheetPoint(i + 0.5 * j, kHalfSqrt3 * j);
      for (const std::uint32_t t : scratch.near) {
        const Triangle& tri = split_.triangles[t];
        const SheetPoint &a = split_.point[tri[0]], &b = split_.point[tri[1]],
                         &c = split_.point[tri[2]];
        const double twice = cross(b - a, c - a);
        const std::array<double, 3> w = {cross(b - q, c - q) / twice, cross(c - q, a - q) / twice,
                                         cross(a - q, b - q) / twice};
        if (!(w[0] >= 0 && w[1] >= 0 && w[2] >= 0)) continue;
        for (std::size_t k = 0; k < 3; ++k)
          if (at_[tri[k]] >= 0) scratch.load[static_cast<std::size_t>(at_[tri[k]])] += w[k];
        ++points;
        break;
      }
    }
  for (double& x : scratch.load) x /= std::max(points, 1);
  return points > 0;
}

// With A = L D L^T the mean way of the disc under one newton is b A^-1 b = sum of (L^-1 b)^2 / D.
double SheetYield::stiffness(const SheetDisc& disc, SheetScratch& scratch) const {
  if (!put_load(disc, scratch)) return 0;
  go_forward(first_, start_, rows_, scratch.load);
  double yields = 0;
  for (std::size_t i = 0; i < pivots_.size(); ++i)
    yields += scratch.load[i] * scratch.load[i] / pivots_[i];
  return yields > 0 ? 1 / yields : 0;
}

std::vector<double> SheetYield::dent(const SheetDisc& disc) const {
  SheetScratch scratch;
  std::vector<double> out(split_.vertex.size(), 0);
  if (!put_load(disc, scratch)) return out;
  go_forward(first_, start_, rows_, scratch.load);
  for (std::size_t i = 0; i < pivots_.size(); ++i) scratch.load[i] /= pivots_[i];
  go_back(first_, start_, rows_, scratch.load);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (at_[i] >= 0) out[i] = scratch.load[static_cast<std::size_t>(at_[i])];
  return out;
}

std::vector<SheetPoint> SheetYield::pulled(std::span<const SheetPull> pulls) const {
  std::vector<SheetPoint> out(split_.vertex.size(), SheetPoint::Zero());
  if (!plane_ || pulls.empty()) return out;
  std::vector<double> load(plane_->pivots_.size(), 0);
  for (const SheetPull& pull : pulls)
    if (pull.copy < at_.size() && at_[pull.copy] >= 0)
      for (int d = 0; d < 2; ++d)
        load[static_cast<std::size_t>(2 * at_[pull.copy] + d)] += pull.force_n[d];
  plane_->solve(load);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (at_[i] >= 0) {
      const auto u = 2 * static_cast<std::size_t>(at_[i]);
      out[i] = {load[u], load[u + 1]};
    }
  return out;
}

void SheetYield::pull_one(std::uint32_t copy, int axis, std::span<const std::uint32_t> copies,
                          SheetScratch& scratch, std::span<SheetPoint> out) const {
  std::fill(out.begin(), out.end(), SheetPoint::Zero());
  if (!plane_ || at_[copy] < 0) return;
  scratch.load.assign(plane_->pivots_.size(), 0);
  scratch.load[static_cast<std::size_t>(2 * at_[copy] + axis)] = 1;
  plane_->solve(scratch.load);
  for (std::size_t i = 0; i < copies.size(); ++i)
    if (const int u = at_[copies[i]]; u >= 0)
      out[i] = {scratch.load[static_cast<std::size_t>(2 * u)],
                scratch.load[static_cast<std::size_t>(2 * u + 1)]};
}

}  // namespace osteon
