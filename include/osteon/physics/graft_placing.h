#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/physics/acl_tunnels.h"
#include "osteon/physics/graft_passing.h"
#include "osteon/scene/state.h"

namespace osteon {

/// What an instrument of a tray can do while a graft is placed.
struct PlacingTool {
  enum class Kind : std::uint8_t { kOther, kPassingPin, kClamp };
  Kind kind = Kind::kOther;
};

/// A tunnel of a bone: from its mouth in the joint to its outer mouth, in Bone.
struct PlacingTunnel {
  std::uint32_t bone = 0;
  Vec3 mouth_B = Vec3::Zero(), outer_B = Vec3::UnitX();
  double radius_m = 0.004;
};

/// Where a graft is placed, and what graft.
struct PlacingPlan {
  PlacingTunnel femur, tibia;  ///< the femur's: with its channel, to the far cortex
  PassingWay way;
  DrawnGraft graft;
};

/// A bone of the knee, and where it was when its tunnel was measured.
struct PlacingBone {
  std::uint32_t bone = 0;
  Pose X_WB;
};
/// The plan for two measured tunnels; `bend`: of graft_bend_at, while the graft is drawn in. A
/// diameter of 0 is that of the thinner tunnel, a loop of 0 the shortest with which the button
/// turns. Fails without both tunnels, and where no loop is long enough.
Result<PlacingPlan> plan_placing(const AclTunnels& tunnels, const GraftBend& bend,
                                 const PlacingBone& femur, const PlacingBone& tibia,
                                 const DrawnGraft& graft);

enum class PlacingPhase : std::uint8_t {
  kEmpty,         ///< no thread lies in the knee
  kThreadInside,  ///< it goes through the femur; its end lies in the joint
  kThreadHeld,    ///< a clamp has its end
  kThreadOut,     ///< its end is out through the tibia: the graft hangs on it
  kTurned         ///< the button was let go beyond the cortex and lies across its hole
};

/// What a hand is doing.
struct PlacingHand {
  std::uint32_t instrument = 0xffffffffu;  ///< that it held at the last step
  std::uint32_t line = 0;                  ///< that leads it: 1 + GraftPlacing::Line; 0: none
  double grip = 0;                         ///< how much of the hold there is yet
  bool shut = true;                        ///< its jaws were
};

/// All that a step leaves to the next: of fixed size.
struct GraftPlacingState {
  bool on = false;
  PlacingPhase phase = PlacingPhase::kEmpty;
  std::array<PlacingHand, kMaxHands> hands{};
  Vec3 end_W = Vec3::Zero();  ///< of the thread, while it lies in the joint
  std::uint32_t holder = 0;   ///< of kThreadHeld: 1 + hand
  std::uint32_t lost = 0;     ///< how often the thread's end was lost
  double pin_m = 0;           ///< how far the pin has come, from the femur's mouth
  double drawn_m = 0;         ///< of the button's leading end, from the tibia's outer mouth
  double pull_n = 0, most_pull_n = 0;  ///< of the hand at the thread, as in the operation
  std::uint32_t let_go_early = 0;      ///< how often in the channel, the button not out
  double gap_m = 0;                    ///< tissue between the turned button and the cortex
};

/// Placing a graft by hand: a passing pin takes a thread through the femur, a clamp takes its end
/// out through the tibia, a clamp at the thread beyond the femur draws the graft in, and the button
/// turns when it is let go beyond the cortex. A function of its state and the tools' states; a step
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
  enum Line : std::uint32_t { kPinLine, kDrawLine };
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

  const PlacingPlan& plan() const { return plan_; }
  /// How the graft goes if nothing is done wrong.
  const PassedGraft& passed() const { return passed_; }
  /// What the hand must overcome at a front, N.
  double resistance_n(std::uint32_t line, double front_m) const;
  /// How far a front can go.
  double end_m(std::uint32_t line) const;

 private:
  GraftPlacing(PlacingPlan plan, std::vector<PlacingTool> tray, double step_s, PassedGraft passed);
  PlacingTool::Kind held(const ToolState& tool) const;
  void work(std::uint32_t hand, const ToolState& tool, const BoneSnapshot& bones,
            GraftPlacingState& state) const;
  void lead_pin(std::uint32_t hand, const ToolState& tool, const BoneSnapshot& bones,
                GraftPlacingState& state) const;
  void use_clamp(std::uint32_t hand, const ToolState& tool, const BoneSnapshot& bones,
                 GraftPlacingState& state) const;
  void shut_on(std::uint32_t hand, const ToolState& tool, const BoneSnapshot& bones,
               GraftPlacingState& state) const;
  void open(std::uint32_t hand, const ToolState& tool, const BoneSnapshot& bones,
            GraftPlacingState& state) const;
  double go_on(std::uint32_t line, double front_m, double force_n) const;

  PlacingPlan plan_;
  std::vector<PlacingTool> tray_;
  double step_s_;
  PassedGraft passed_;
};

}  // namespace osteon
