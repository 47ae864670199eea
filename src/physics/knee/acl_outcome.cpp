#include <algorithm>
#include <cmath>

#include "knee/acl_frame.h"
#include "osteon/physics/acl_tunnels.h"

namespace osteon {
namespace {

const LaxityTestRow* find_test(const LigamentTable& table, const char* name) {
  for (const LaxityTestRow& row : table.tests)
    if (row.name == name) return &row;
  return nullptr;
}

struct BothTests {
  KneeLaxity lachman, pivot;
};

Result<BothTests> both_tests(const CaseDef& def, const LigamentTable& table,
                             const KneeChanges& changes) {
  const LaxityTestRow* lachman = find_test(table, "lachman");
  const LaxityTestRow* pivot = find_test(table, "pivot");
  if (!lachman || !pivot) return fail("has no tests lachman and pivot", "table of ligaments");
  const auto knee = make_knee(def, table, changes);
  if (!knee) return tl::unexpected(knee.error());
  const auto drawn = test_laxity(*knee, *lachman);
  if (!drawn) return tl::unexpected(drawn.error());
  const auto shifted = test_laxity(*knee, *pivot);
  if (!shifted) return tl::unexpected(shifted.error());
  return BothTests{*drawn, *shifted};
}

// A straight graft seen from the side is a line under that of the roof: its least distance to it is
// at one end of the part that lies under the roof.
Result<double> roof_gap(const CaseDef& def, const LigamentTable& table, const Vec3& femur_W,
                        const Vec3& tibia_W, double radius) {
  constexpr double kMouth_m = 0.008;
  const auto parts = find_knee_parts(def, table.width_m);
  if (!parts) return tl::unexpected(parts.error());
  const auto grid = quadrant_grid(def, *parts);
  if (!grid) return tl::unexpected(grid.error());
  const Vec3 from = parts->place(parts->femur, femur_W), to = parts->place(parts->tibia, tibia_W);
  const double length = (to - from).norm();
  const double first = std::min(1.0, kMouth_m / std::max(length, kMouth_m));
  const double run = grid->axes.u(to) - grid->axes.u(from);
  const double end = (grid->roof_m - grid->axes.u(from)) / (std::abs(run) > 1e-9 ? run : 1e-9);
  const double last = end > first ? std::min(end, 1.0) : 1.0;
  const auto under = [&](double share) { return grid->axes.v(from + share * (to - from)); };
  return std::min(under(first), under(last)) - radius;
}

}  // namespace

Result<GraftOutcome> graft_outcome(const CaseDef& def, const LigamentTable& table,
                                   const AclTunnels& tunnels) {
  if (!tunnels.femur || !tunnels.tibia)
    return fail("a graft needs a tunnel in femur and tibia", "case '" + def.name + "'",
                "Drill both");
  const Vec3 from_W = tunnels.femur->aperture_W, to_W = tunnels.tibia->aperture_W;
  auto lengths = line_over_flexion(def, from_W, to_W);
  if (!lengths) return tl::unexpected(lengths.error());
  GraftOutcome out;
  out.lengths = std::move(*lengths);
  const auto [low, high] =
      std::minmax_element(out.lengths.begin(), out.lengths.end(),
                          [](const auto& a, const auto& b) { return a.length_m < b.length_m; });
  out.excursion_m = high->length_m - low->length_m;
  const double diameter = std::min(tunnels.femur->diameter_m, tunnels.tibia->diameter_m);
  const auto gap = roof_gap(def, table, from_W, to_W, 0.5 * diameter);
  if (!gap) return tl::unexpected(gap.error());
  out.roof_gap_m = *gap;
  KneeGraft graft;
  graft.from_W = from_W;
  graft.to_W = to_W;
  graft.diameter_m = diameter;
  KneeChanges healed, repaired;
  healed.heal = true;
  repaired.graft = graft;
  const auto with = both_tests(def, table, repaired);
  if (!with) return tl::unexpected(with.error());
  const auto whole = both_tests(def, table, healed);
  if (!whole) return tl::unexpected(whole.error());
  out.lachman = with->lachman;
  out.pivot = with->pivot;
  out.lachman_whole_m = whole->lachman.anterior_m;
  out.pivot_whole_m = whole->pivot.anterior_m;
  return out;
}

}  // namespace osteon
