#include <algorithm>
#include <cmath>

#include "knee/acl_frame.h"
#include "knee/graft_bends.h"
#include "osteon/physics/acl_tunnels.h"
#include "osteon/scene/graft.h"

namespace osteon {
namespace {

const LaxityTestRow* find_test(const LigamentTable& table, const char* name) {
  for (const LaxityTestRow& row : table.tests)
    if (row.name == name) return &row;
  return nullptr;
}

struct BothTests {
  KneeLaxity lachman, pivot;
  Vec3 lachman_F = Vec3::Zero(), pivot_F = Vec3::Zero();  // where the tibia's middle is under load
};

double ahead_m(const KneeLaxity& test, const Vec3& with_F, const Vec3& whole_F) {
  return front_F(test.loaded.flexion_rad).dot(with_F - whole_F);
}

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
  const auto middle = [&](const KneeLaxity& test) {
    return Vec3(pose_of(knee->joint, test.loaded) * knee->joint.middle_T);
  };
  return BothTests{*drawn, *shifted, middle(*drawn), middle(*shifted)};
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

double length_at(const std::vector<LineLength>& lengths, double flexion_deg) {
  for (std::size_t i = 1; i < lengths.size(); ++i) {
    const LineLength &a = lengths[i - 1], &b = lengths[i];
    if (flexion_deg > b.flexion_deg) continue;
    const double share = (flexion_deg - a.flexion_deg) / (b.flexion_deg - a.flexion_deg);
    return a.length_m + std::clamp(share, 0.0, 1.0) * (b.length_m - a.length_m);
  }
  return lengths.back().length_m;
}

// What is not chosen is as an expert would: a graft that is long enough, the loop with which the
// button just turns, a screw a millimetre wider than the tunnel.
GraftFixing fixing_as(const GraftChoices& chosen, const AclTunnels& tunnels, double diameter_m,
                      double between_m) {
  constexpr double kWider_m = 0.001, kScrewLong_m = 0.028, kLongestLoop_m = 0.050;
  GraftFixing done;
  done.diameter_m = diameter_m;
  done.channel_m = tunnels.femur->channel_m;
  done.socket_m = tunnels.femur->drilled_m;
  const double loop = loop_for(done.channel_m, done.socket_m);
  done.loop_m = chosen.loop_m.value_or(loop > 0 ? loop : kLongestLoop_m);
  done.tibia_m = tunnels.tibia->length_m;
  done.tibia_diameter_m = tunnels.tibia->diameter_m;
  done.between_m = between_m;
  done.length_m = chosen.length_m.value_or(std::max(0.0, done.channel_m - done.loop_m) + between_m +
                                           done.tibia_m);
  done.button_gap_m = chosen.button_gap_m;
  done.pretension_s = chosen.pretension_s;
  done.cycles = chosen.cycles;
  done.screw_m = chosen.screw_m.value_or(done.tibia_diameter_m + kWider_m);
  done.screw_length_m = chosen.screw_length_m.value_or(kScrewLong_m);
  done.divergence_rad = chosen.divergence_rad;
  return done;
}

// Drawn in by its thread before it is fixed.
Result<PassedGraft> passed_as(const CaseDef& def, const GraftChoices& chosen,
                              const AclTunnels& tunnels, const GraftFixing& done) {
  const auto bend = graft_bend_at(def, tunnels, chosen.passing_flexion_deg);
  if (!bend) return tl::unexpected(bend.error());
  PassingWay way;
  way.tibia_m = done.tibia_m;
  way.between_m = bend->length_m;
  way.channel_m = done.channel_m;
  way.socket_m = done.socket_m;
  way.tibia_diameter_m = done.tibia_diameter_m;
  way.socket_diameter_m = tunnels.femur->diameter_m;
  way.tibia_bend_rad = bend->tibia_rad;
  way.femur_bend_rad = bend->femur_rad;
  return pass_graft(way, {done.diameter_m, done.length_m, done.loop_m, chosen.tail_n});
}

Result<void> check_fits(double diameter_m, const AclTunnels& tunnels) {
  constexpr double kSqueeze_m = 0.0005;
  const double room = std::min(tunnels.femur->diameter_m, tunnels.tibia->diameter_m);
  if (diameter_m <= room + kSqueeze_m) return {};
  return fail("a graft of " + std::to_string(1e3 * diameter_m) + " mm does not pass a tunnel of " +
                  std::to_string(1e3 * room) + " mm",
              "graft", "Drill wider tunnels, or make a thinner graft");
}

bool bears(const FixedGraft& fixed, const KneeLaxity& test) {
  return fixed.held && !test.ligaments.empty() &&
         test.ligaments.back().tension_n < fixed.strength_n;
}

}  // namespace

Result<GraftOutcome> graft_outcome(const CaseDef& def, const LigamentTable& table,
                                   const AclTunnels& tunnels,
                                   const std::optional<GraftChoices>& choices) {
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
  const auto bones = find_knee_bones(def);
  if (!bones) return tl::unexpected(bones.error());
  for (const LineLength& at : out.lengths)
    out.bends.push_back(bend_of_graft(*bones, tunnels, at.flexion_deg));
  double diameter = std::min(tunnels.femur->diameter_m, tunnels.tibia->diameter_m);
  if (choices) diameter = choices->diameter_m.value_or(diameter);
  if (auto ok = check_fits(diameter, tunnels); !ok) return tl::unexpected(ok.error());
  out.diameter_m = diameter;
  const auto gap = roof_gap(def, table, from_W, to_W, 0.5 * diameter);
  if (!gap) return tl::unexpected(gap.error());
  out.roof_gap_m = *gap;
  KneeGraft graft;
  graft.from_W = from_W;
  graft.to_W = to_W;
  graft.diameter_m = diameter;
  if (choices) {
    const double bend_deg = choices->flexion_deg.value_or(table.graft.flexion_deg);
    const GraftFixing done =
        fixing_as(*choices, tunnels, diameter, length_at(out.lengths, bend_deg));
    auto fixed = fix_graft(done);
    if (!fixed) return tl::unexpected(fixed.error());
    auto passed = passed_as(def, *choices, tunnels, done);
    if (!passed) return tl::unexpected(passed.error());
    out.passed = std::move(*passed);
    graft.tension_n = choices->tension_n;
    graft.flexion_deg = choices->flexion_deg;
    graft.fixation_n_per_m = fixed->stiffness_n_per_m;
    graft.slack_m = fixed->slack_m;
    graft.held = fixed->held;
    out.fixed = std::move(*fixed);
  }
  out.graft = graft;
  KneeChanges healed, repaired;
  healed.heal = true;
  repaired.graft = graft;
  const auto with = both_tests(def, table, repaired);
  if (!with) return tl::unexpected(with.error());
  const auto whole = both_tests(def, table, healed);
  if (!whole) return tl::unexpected(whole.error());
  out.lachman = with->lachman;
  out.pivot = with->pivot;
  if (out.fixed) out.holds = bears(*out.fixed, out.lachman) && bears(*out.fixed, out.pivot);
  out.lachman_ahead_m = ahead_m(with->lachman, with->lachman_F, whole->lachman_F);
  out.pivot_ahead_m = ahead_m(with->pivot, with->pivot_F, whole->pivot_F);
  out.lachman_whole_m = whole->lachman.anterior_m;
  out.pivot_whole_m = whole->pivot.anterior_m;
  return out;
}

}  // namespace osteon
