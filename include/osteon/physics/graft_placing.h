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
  enum class Kind : std::uint8_t { kOther, kPassingPin, kClamp, kScrew };
  Kind kind = Kind::kOther;
  double width_m = 0;  ///< of a screw
};

/// Placing a graft by hand: a passing pin takes a thread through the femur, a clamp takes its end
/// out through the tibia, a clamp at the thread beyond the femur draws the graft in, and the button
/// turns when it is let go beyond the cortex. Then a screw is turned in beside it in the tibia: its
/// line is where it stood and looked as it began to turn. In a tunnel an instrument stays on its
/// line; a clamp that draws hangs on the thread. A function of its state and the tools' states; a
/// step allocates nothing.
///
/// Guided one-dimensional model. Symbols: s, how far a line's front is; F, what the hand does along
/// the line; R(s), the resistance there: over R the front goes on with (F - R) / kSlow, at most
/// kFastest. R of the pin is constant. R of the graft is passing_pull_n / kLever, and grows by
/// kSill_n over the last kSill_m before the button is out, then falls: the flip is felt so. A graft
/// that stands at the socket's end goes no further whatever F is. A screw that is turned goes on by
/// its pitch while F is over kScrew_n, and stays once the hand takes something else. Invariant:
/// fronts never go back but by losing the thread, and 0 <= drawn <= the line's end. A step ends
/// after one look at each hand. Forces, ways and times of a hand: own defaults (D).
class GraftPlacing {
 public:
  static constexpr double kPin_n = 0.8;
  static constexpr double kThrough_m = 0.010;  ///< beyond the cortex the thread lies in the femur
  static constexpr double kThread_m = 0.040;   ///< drawn on so far its end leaves the joint
  static constexpr double kLever = 20;         ///< the hand feels so much less than the thread
  static constexpr double kSill_n = 0.8, kSill_m = 0.0015;
  static constexpr double kOverdraw_m = 0.025;  ///< the way that is left beyond the cortex
  static constexpr double kFree_m = 0.006;      ///< of it, without tissue under the button
  static constexpr double kScrew_n = 0.5, kScrewLength_m = 0.025, kScrewBeyond_m = 0.010;
  static constexpr double kScrewTurn_m_per_s = 0.0025;  ///< one turn of its pitch
  static constexpr double kScrewHolds_m = 0.005;        ///< less deep it comes out again
  static constexpr double kMostTension_n = 200;
  static constexpr double kWorks_n = 20;  ///< under less tension bending works no creep out
  static constexpr double kSlow_n_s_per_m = 15, kFastest_m_per_s = 0.10;
  /// More than a hand's force that a device shows is not reckoned.
  static constexpr double kMostHand_n = 10;

  /// `tray`: by index of the session's tray. Fails on a way or graft that pass_graft refuses, on
  /// places that are not finite, and on a tunnel without length.
  static Result<GraftPlacing> make(PlacingPlan plan, std::vector<PlacingTool> tray, double step_s);
  /// Steps `state`; a tool of another epoch than the world's does nothing.
  void step(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
            GraftPlacingState& state) const;

  GraftPlacingState begin() const;
  /// Pulls on the tail; nothing before the button has turned or after the screw is in.
  static void pull(double tension_n, GraftPlacingState& state);
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
  void turn_screw(std::uint32_t hand, const ToolState& tool, const BoneSnapshot& bones,
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
