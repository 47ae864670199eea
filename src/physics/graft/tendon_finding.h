#pragma once

#include "osteon/scene/graft_bench.h"
#include "osteon/scene/state.h"

// Both tendons of a bench are found under their fascia. The fascia's line runs over the thigh's
// surface between them, near their insertions: a blade that is drawn along it opens it. A clamp
// that shuts over a tendon where it is open takes that tendon, and drawn up it lifts it out.
namespace osteon {

inline constexpr double kFound_m = 0.010;     ///< lifted so far out, a tendon is found
inline constexpr double kLift_n_per_m = 150;  ///< against so much, own default
inline constexpr double kTooDeep_n = 5;       ///< pressed so hard, a blade cuts the ligament
inline constexpr double kNerve_m = 0.018;     ///< the nerve lies so far from the line or more

/// A step of a blade. Presses on the fascia: opens it from where the blade was to where it is; too
/// hard: hurts the medial collateral ligament under it. Presses behind the gracilis and is drawn:
/// hurts the saphenous nerve there.
void open_fascia(const GraftBenchPlan& plan, const ToolState& tool, GraftBenchState& state,
                 BenchHand& hand);

/// Jaws that just shut.
void take_tendon(const GraftBenchPlan& plan, const ToolState& tool, const GraftBenchState& state,
                 BenchHand& hand);

/// A step of jaws that hold a tendon: it follows the hand as far as the hand's pull stretches it.
void lift_tendon(const GraftBenchPlan& plan, const ToolState& tool, double step_s,
                 GraftBenchState& state, BenchHand& hand);

/// What the hand that lifts is led by; `X_WB` of the thigh.
ToolGuide guide_of_lift(const GraftBenchPlan& plan, const BenchHand& hand, std::uint32_t thigh,
                        const Pose& X_WB);

}  // namespace osteon
