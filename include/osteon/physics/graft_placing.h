#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/physics/graft_passing.h"
#include "osteon/scene/placing.h"
#include "osteon/scene/state.h"

namespace osteon {

/// What an instrument of a tray can do while a graft is placed.
struct PlacingTool {
  enum class Kind : std::uint8_t { kOther, kPassingPin, kClamp };
  Kind kind = Kind::kOther;
};

/// Placing a graft by hand: a passing pin takes a thread through the femur, a clamp takes its end
/// out through the tibia, a clamp at the thread beyond the femur draws the graft in, and the button
/// turns when it is let go beyond the cortex. In a tunnel an instrument stays on its line; a clamp
/// that draws hangs on the thread. A function of its state and the tools' states; a step
/// allocates nothing.
///
/// Guided one-dimensional model. Symbols: s, how far a line's front is; F, what the hand does along
/// the line; R(s), the resistance there: over R the front goes on with (F - R) / kSlow, at most
/// kFastest. R of the pin is constant. R of the graft is passing_pull_n / kLever, and grows by
/// kSill_n over the last kSill_m before the button is out, then falls: the flip is felt so. A graft
/// that stands at the socket's end goes no further whatever F is. Invariant: fronts never go back
/// but by losing the thread, and 0 <= drawn <= the line's end. A step ends after one look at each
/// hand. Forces, ways and times of a hand: own defaults (D).
class GraftPlacing {
 public:
  static constexpr double kPin_n = 0.8;
  static constexpr double kThrough_m = 0.010;  ///< beyond the cortex the thread lies in the femur
  static constexpr double kThread_m = 0.040;   ///< drawn on so far its end leaves the joint
  static constexpr double kLever = 20;         ///< the hand feels so much less than the thread
  static constexpr double kSill_n = 0.8, kSill_m = 0.0015;
  static constexpr double kOverdraw_m = 0.025;  ///< the way that is left beyond the cortex
  static constexpr double kFree_m = 0.006;      ///< of it, without tissue under the button
  static constexpr double kSlow_n_s_per_m = 15, kFastest_m_per_s = 0.10;
  /// More than a hand's force that a device shows is not reckoned.
  static constexpr double kMostHand_n = 10;

  /// `tray`: by index of the session's tray. Fails on a way or graft that pass_graft refuses, on
  /// places that are not finite, and on a tunnel without length.
  static Result<GraftPlacing> make(PlacingPlan plan, std::vector<PlacingTool> tray, double step_s);
  /// Steps `state`; a tool of another epoch than the world's does nothing.
  void step(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
            GraftPlacingState& state) const;

  static GraftPlacingState begin();
  /// As it was then; what hands were doing is over.
  static GraftPlacingState gone_back(const GraftPlacingState& kept);

  /// Sets the lines that lead hands; a hand that none leads keeps what it has.
  void lead(const GraftPlacingState& state, std::array<ToolGuide, kMaxHands>& guides) const;

  const PlacingPlan& plan() const { return plan_; }
  /// How the graft goes if nothing is done wrong.
  const PassedGraft& passed() const { return passed_; }
  /// What the hand must overcome at a front, N.
  double resistance_n(PlacingLine line, double front_m) const;
  /// How far a front can go.
  double end_m(PlacingLine line) const;

 private:
  GraftPlacing(PlacingPlan plan, std::vector<PlacingTool> tray, double step_s);
  PlacingTool::Kind held(const ToolState& tool) const;
  void work(std::uint32_t hand, const ToolState& tool, const BoneSnapshot& bones,
            GraftPlacingState& state) const;
  void lead_pin(std::uint32_t hand, const ToolState& tool, const BoneSnapshot& bones,
                GraftPlacingState& state) const;
  void follow_tibia(std::uint32_t hand, const ToolState& tool, const BoneSnapshot& bones,
                    GraftPlacingState& state) const;
  void use_clamp(std::uint32_t hand, const ToolState& tool, const BoneSnapshot& bones,
                 GraftPlacingState& state) const;
  void shut_on(std::uint32_t hand, const ToolState& tool, const BoneSnapshot& bones,
               GraftPlacingState& state) const;
  void open(std::uint32_t hand, const ToolState& tool, const BoneSnapshot& bones,
            GraftPlacingState& state) const;
  double go_on(PlacingLine line, double front_m, double force_n) const;

  PlacingPlan plan_;
  PassingWay way_;
  DrawnGraft graft_;
  std::vector<PlacingTool> tray_;
  double step_s_;
  PassedGraft passed_;
};

}  // namespace osteon
