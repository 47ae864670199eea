#include "tet/lattice_cuts.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

// Of Labelle and Shewchuk, table 1: with these all dihedral angles lie between 10.78 and 164.74
// degrees.
constexpr double kWarpLong = 0.24999;
constexpr double kWarpShort = 0.41189;
constexpr double kRootShare = 1e-4;

std::uint64_t key_of(std::uint32_t inside, std::uint32_t outside) {
  return std::uint64_t{inside} << 32 | outside;
}
std::uint32_t inside_of(std::uint64_t key) { return static_cast<std::uint32_t>(key >> 32); }
std::uint32_t outside_of(std::uint64_t key) { return static_cast<std::uint32_t>(key); }

/// Share of the way from inside `a` to outside `b` where the field is zero: regula falsi with
/// halved weights (Illinois), which keeps the bracket.
double crossing_share(const ScalarField& field, const Vec3& a, const Vec3& b) {
  double lo = 0, hi = 1;
  double at_lo = field(a), at_hi = field(b);
  for (int step = 0; step < 60 && hi - lo > kRootShare; ++step) {
    double share = step % 8 == 7 ? 0.5 * (lo + hi) : lo + (hi - lo) * at_lo / (at_lo - at_hi);
    // Looks a little past the estimate, so that the bracket closes from both sides.
    const double nudge = 0.4 * kRootShare;
    share = std::clamp(share, lo + nudge, hi - nudge);
    const double value = field(a + share * (b - a));
    if (value == 0) return share;
    if (value < 0) {
      lo = share;
      at_lo = value;
      at_hi *= 0.5;
    } else {
      hi = share;
      at_hi = value;
      at_lo *= 0.5;
    }
  }
  return 0.5 * (lo + hi);
}

}  // namespace

LatticeCuts::LatticeCuts(BccLattice& lattice, const ScalarField& field) : lattice_(lattice) {
  find(field);
  warp();
}

void LatticeCuts::find(const ScalarField& field) {
  for (std::uint32_t point = 0; point < lattice_.point_count(); ++point) {
    if (lattice_.side(point) != LatticeSide::kInside) continue;
    std::array<std::uint32_t, 14> others = lattice_.neighbours(point);
    std::sort(others.begin(), others.end());
    for (const std::uint32_t other : others) {
      if (lattice_.side(other) != LatticeSide::kOutside) continue;
      const Vec3 a = lattice_.place(point), b = lattice_.place(other);
      const double share = crossing_share(field, a, b);
      cuts_.push_back({key_of(point, other), a + share * (b - a), share});
    }
  }
}

void LatticeCuts::consider(const Cut& cut, std::uint32_t point, double share, const Cut*& best,
                           double& best_length) const {
  const std::uint32_t other =
      point == inside_of(cut.key) ? outside_of(cut.key) : inside_of(cut.key);
  if (lattice_.side(other) == LatticeSide::kOn) return;
  const bool is_long = lattice_.same_kind(point, other);
  if (share >= (is_long ? kWarpLong : kWarpShort)) return;
  const double length = share * (is_long ? 1.0 : 0.5 * std::sqrt(3.0));
  if (length >= best_length) return;
  best = &cut;
  best_length = length;
}

// In the order of the points: a crossing vanishes when either of its ends goes onto the surface, so
// what was found clear stays clear.
void LatticeCuts::warp() {
  struct Use {
    std::uint32_t point, cut;
  };
  std::vector<Use> uses;
  uses.reserve(2 * cuts_.size());
  for (std::uint32_t i = 0; i < cuts_.size(); ++i) {
    uses.push_back({inside_of(cuts_[i].key), i});
    uses.push_back({outside_of(cuts_[i].key), i});
  }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return a.point != b.point ? a.point < b.point : a.cut < b.cut;
  });
  for (auto first = uses.begin(); first != uses.end();) {
    const std::uint32_t point = first->point;
    const Cut* best = nullptr;
    double best_length = 2;
    for (; first != uses.end() && first->point == point; ++first) {
      const Cut& cut = cuts_[first->cut];
      const bool from_inside = point == inside_of(cut.key);
      consider(cut, point, from_inside ? cut.share : 1 - cut.share, best, best_length);
    }
    if (best == nullptr) continue;
    warped_.emplace(point, best->place);
    lattice_.put_on_surface(point);
  }
}

Vec3 LatticeCuts::place(std::uint32_t point) const {
  const auto found = warped_.find(point);
  return found == warped_.end() ? lattice_.place(point) : found->second;
}

Vec3 LatticeCuts::place(std::uint32_t inside, std::uint32_t outside) const {
  const std::uint64_t key = key_of(inside, outside);
  const auto at = std::lower_bound(cuts_.begin(), cuts_.end(), key,
                                   [](const Cut& cut, std::uint64_t k) { return cut.key < k; });
  return at->place;
}

}  // namespace osteon
