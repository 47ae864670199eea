#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "osteon/base/types.h"

namespace osteon {

struct Case;
struct BoneSnapshot;

/// Hands that may place a graft; as many as a session has.
inline constexpr std::size_t kPlacingHands = 4;

/// A tunnel of a bone: from its mouth in the joint to its outer mouth, in Bone.
struct PlacingTunnel {
  std::uint32_t bone = 0;
  Vec3 mouth_B = Vec3::Zero(), outer_B = Vec3::UnitX();
  double radius_m = 0.004;
  double length_m() const { return (outer_B - mouth_B).norm(); }
};

/// Where a graft is placed, and what graft.
struct PlacingPlan {
  PlacingTunnel femur, tibia;  ///< the femur's: socket and channel, to the far cortex
  double socket_m = 0.026;     ///< of the femur, from its mouth
  double between_m = 0.030;    ///< from mouth to mouth
  double tibia_bend_rad = 0, femur_bend_rad = 0;  ///< how far the way turns at each mouth
  double graft_m = 0.008, graft_length_m = 0.120, loop_m = 0.020;
  double tail_n = 10;  ///< with which a second hand holds the graft's tail
  /// Drawn so far, from the tibia's outer mouth, the button is out with its whole length.
  double button_out_m() const;
};

/// A hole that was found in a bone: the ends of its wall, in Bone.
struct PlacingHole {
  Vec3 from_B = Vec3::Zero(), to_B = Vec3::UnitX();
  double diameter_m = 0.008;
};
/// A graft that is to be placed; 0: it follows from the tunnels, as in find_placing.
struct PlacingGraft {
  double diameter_m = 0, length_m = 0.120, loop_m = 0;
};
/// The plan for two holes that were drilled in a case's bones, whose meshes are those before
/// drilling, as they lie at rest: the mouths are where a hole's axis leaves the bone. The femur's
/// is the socket; a narrower channel goes on to the far side. None: a hole is not in its bone, the
/// socket is as long as the bone is thick, or no loop is long enough.
std::optional<PlacingPlan> plan_placing(const Case& the_case, const PlacingHole& socket,
                                        const PlacingHole& tibia, const PlacingGraft& graft = {});

/// What tells a plan in commands: mouth and outer mouth and radius of the femur's tunnel, of the
/// tibia's, depth of the socket, the graft's thickness and length, the loop's length; SI units.
inline constexpr std::size_t kPlacingNumbers = 18;
using PlacingNumbers = std::array<double, kPlacingNumbers>;
PlacingNumbers placing_numbers(const PlacingPlan& plan);
/// The plan that they tell of a case at rest; none: they are no plan for that case.
std::optional<PlacingPlan> plan_of_numbers(const Case& the_case, const PlacingNumbers& numbers);

/// The plan for a case with both tunnels made, as its bones lie at rest: landmarks
/// `femoral_tunnel_from`, `_socket`, `_to` and `_side`, `tibial_tunnel_from`, `_to` and `_side`
/// (docs/acl.md). A mouth lies where the axis leaves the bone: half way between the nearest and the
/// farthest of 16 places about it, 1 mm beyond the tunnel's wall. The graft is as thick as the
/// thinner tunnel, the loop the shortest with which the button turns. None: the case has no such
/// tunnels, or no loop is long enough.
std::optional<PlacingPlan> find_placing(const Case& the_case);

enum class PlacingPhase : std::uint8_t {
  kEmpty,         ///< no thread lies in the knee
  kThreadInside,  ///< it goes through the femur; its end lies in the joint
  kThreadHeld,    ///< a clamp has its end
  kThreadOut,     ///< its end is out through the tibia: the graft hangs on it
  kTurned         ///< the button was let go beyond the cortex and lies across its hole
};

/// What leads an instrument.
enum class PlacingLine : std::uint8_t { kNone, kPin, kTibia, kDraw, kScrew };

/// What a hand is doing.
struct PlacingHand {
  std::uint32_t instrument = 0xffffffffu;  ///< that it held at the last step
  PlacingLine line = PlacingLine::kNone;
  double grip = 0;    ///< how much of the hold there is yet
  bool shut = true;   ///< its jaws were
  double from_m = 0;  ///< of kDraw: beyond the cortex, where the jaws had been with nothing drawn
};

/// A screw in the tibia beside the graft.
struct PlacingScrew {
  std::uint32_t screws = 0;  ///< how many were begun; 0: none
  Vec3 p_B = Vec3::Zero();   ///< where its axis enters, in the tibia
  Vec3 out_B = Vec3::UnitZ();
  double width_m = 0, length_m = 0;
  double in_m = 0;                        ///< how deep its tip has come
  bool done = false;                      ///< let go: it stays
  double tension_n = 0, flexion_deg = 0;  ///< as it was let go
  std::uint32_t cycles = 0;               ///< of bending under tension before
};

/// All that a step leaves to the next: of fixed size.
struct GraftPlacingState {
  bool on = false;           ///< there are both tunnels, and a graft
  bool ordered = false;      ///< it was told by commands; else the case has it
  PlacingPlan plan;          ///< of what is on
  std::uint32_t told = 0;    ///< numbers of a plan that have come; the rest is under way
  PlacingNumbers numbers{};  ///< those
  PlacingPhase phase = PlacingPhase::kEmpty;
  std::array<PlacingHand, kPlacingHands> hands{};
  Vec3 end_W = Vec3::Zero();  ///< of the thread, while it lies in the joint or is held
  std::uint32_t holder = 0;   ///< of kThreadHeld: 1 + hand
  std::uint32_t lost = 0;     ///< how often the thread's end was lost
  double pin_m = 0;           ///< how far the pin has come, from the femur's mouth
  double drawn_m = 0;         ///< of the button's leading end, from the tibia's outer mouth
  double pull_n = 0, most_pull_n = 0;  ///< of the hand at the thread, as in the operation
  std::uint32_t let_go_early = 0;      ///< how often in the channel, the button not out
  double gap_m = 0;                    ///< tissue between the turned button and the cortex
  double tension_n = 0;                ///< pull on the tail of a graft whose button has turned
  std::uint32_t cycles_before = 0;     ///< of bending, as they were seen last
  PlacingScrew screw;
};

/// What is seen of thread, graft and button: round rods in World.
struct PlacingRod {
  enum class Is : std::uint8_t { kThread, kGraft, kLoop, kButton, kScrew };
  Is is = Is::kThread;
  Vec3 a_W = Vec3::Zero(), b_W = Vec3::Zero();
  double radius_m = 0;
};
/// Straight from mouth to mouth; empty while no thread lies in the knee.
std::vector<PlacingRod> placing_rods(const BoneSnapshot& bones);
/// From mouth to mouth as the bones stand now.
double placing_between_m(const PlacingPlan& plan, const BoneSnapshot& bones);

}  // namespace osteon
