#include "graft/tendon_finding.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace osteon {
namespace {

constexpr double kOnFascia_n = 0.15;  // a blade that is pressed with so much cuts
constexpr double kBesideLine_m = 0.004;
constexpr double kOffSurface_m = 0.006;
constexpr double kNerveEnds_m = 0.030, kOverNerve_m = 0.004;  // drawn so far it is through
constexpr double kJawsReach_m = 0.006;
constexpr double kLiftStep = 0.02;  // a lifted tendon is felt in full after 50 steps
constexpr double kLiftSlow_n_s_per_m = 15, kLiftFastest_m_per_s = 0.15;
constexpr std::uint32_t kOnLine = 1, kOnNerve = 2;

// A place in the frame of the fascia's line.
struct OnFascia {
  double along_m = 0, across_m = 0, up_m = 0;
};

OnFascia on_fascia(const GraftBenchPlan& plan, const Vec3& p_W) {
  const Vec3 off = p_W - plan.fascia_from_W;
  return {off.dot(plan.fascia_along_W()), off.dot(plan.fascia_across_W()),
          off.dot(plan.fascia_up_W())};
}

std::uint32_t zone_of(const GraftBenchPlan& plan, const OnFascia& at) {
  if (std::abs(at.up_m) > kOffSurface_m || at.along_m < 0 || at.along_m > plan.fascia_m()) return 0;
  if (std::abs(at.across_m) < kBesideLine_m) return kOnLine;
  return at.across_m > kNerve_m && at.across_m < kNerveEnds_m ? kOnNerve : 0;
}

std::uint32_t cell_of(const GraftBenchPlan& plan, double along_m) {
  const double cell = std::floor(along_m / plan.fascia_m() * kFasciaCells);
  return static_cast<std::uint32_t>(std::clamp(cell, 0.0, kFasciaCells - 1.0));
}

}  // namespace

void open_fascia(const GraftBenchPlan& plan, const ToolState& tool, GraftBenchState& state,
                 BenchHand& hand) {
  const std::uint32_t before = std::exchange(hand.slits, 0);
  const double force_n = is_finite(tool.force_W) ? tool.force_W.norm() : 0;
  if (!plan.is_covered() || tool.contact_count == 0 || force_n < kOnFascia_n) return;
  const OnFascia at = on_fascia(plan, tool.X_WP.p);
  hand.slits = zone_of(plan, at);
  if (hand.slits == 0 || hand.slits != before) hand.from_W = tool.X_WP.p;
  if (hand.slits == kOnNerve && (tool.X_WP.p - hand.from_W).norm() > kOverNerve_m)
    state.hurt |= kNerveHurt;
  if (hand.slits != kOnLine) return;
  const auto [low, high] =
      std::minmax({cell_of(plan, on_fascia(plan, hand.from_W).along_m), cell_of(plan, at.along_m)});
  for (std::uint32_t k = low; k <= high; ++k) state.slit |= std::uint64_t{1} << k;
  hand.from_W = tool.X_WP.p;
  if (force_n > kTooDeep_n) state.hurt |= kMclHurt;
}

void take_tendon(const GraftBenchPlan& plan, const ToolState& tool, const GraftBenchState& state,
                 BenchHand& hand) {
  if (!plan.is_covered()) return;
  const OnFascia at = on_fascia(plan, tool.X_WP.p);
  if (std::abs(at.up_m) > kJawsReach_m || at.along_m < 0 || at.along_m > plan.fascia_m()) return;
  if ((state.slit >> cell_of(plan, at.along_m) & 1u) == 0) return;
  for (std::uint32_t t = 0; t < kGraftTendons; ++t) {
    const double lies_m = on_fascia(plan, plan.tendons[t].insertion_W).across_m;
    if (state.tendons[t].stripped || std::abs(at.across_m - lies_m) > kJawsReach_m) continue;
    hand.lifts = 1 + t;
    hand.from_W = tool.X_WP.p;
    hand.front_m = hand.grip = 0;
  }
}

void lift_tendon(const GraftBenchPlan& plan, const ToolState& tool, double step_s,
                 GraftBenchState& state, BenchHand& hand) {
  hand.grip = std::min(1.0, hand.grip + kLiftStep);
  const double pull_n = is_finite(tool.force_W) ? -plan.fascia_up_W().dot(tool.force_W) : 0;
  const double over_n = pull_n - kLift_n_per_m * hand.front_m;
  const double most_m = step_s * kLiftFastest_m_per_s;
  hand.front_m += std::clamp(step_s * over_n / kLiftSlow_n_s_per_m, -most_m, most_m);
  hand.front_m = std::max(0.0, hand.front_m);
  if (hand.front_m > kFound_m) state.tendons[hand.lifts - 1].found = true;
}

ToolGuide guide_of_lift(const GraftBenchPlan& plan, const BenchHand& hand, std::uint32_t thigh,
                        const Pose& X_WB) {
  ToolGuide out;
  const Pose X_BW = X_WB.inverse();
  out.on = true;
  out.bone = thigh;
  out.p_B = X_BW * hand.from_W;
  out.nhat_B = X_BW.rotate(plan.fascia_up_W());
  out.grip = hand.grip;
  out.pulls = true;
  out.stop_m = hand.front_m;
  return out;
}

}  // namespace osteon
