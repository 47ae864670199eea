#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "osteon/base/id.h"
#include "osteon/base/types.h"
#include "osteon/scene/bend_state.h"
#include "osteon/scene/case.h"
#include "osteon/scene/graft_bench.h"
#include "osteon/scene/inside.h"
#include "osteon/scene/knee_exam.h"
#include "osteon/scene/loose_bone.h"
#include "osteon/scene/placing.h"
#include "osteon/scene/soft_told.h"
#include "osteon/scene/tool_guide.h"
#include "osteon/scene/water_state.h"

namespace osteon {

/// One sample of the hand, already mapped into World.
struct ToolInput {
  Pose X_WD;                ///< pose of the device's stylus (where the hand wants the tool)
  Vec3 v_W = Vec3::Zero();  ///< velocity of its origin, m/s
  Vec3 w_W = Vec3::Zero();  ///< angular velocity, rad/s
  std::uint32_t buttons = 0;
};

/// Where a bone is and how it moves.
struct BoneMotion {
  Pose X_WB;
  Vec3 v_W = Vec3::Zero();  ///< of the bone frame's origin, m/s
  Vec3 w_W = Vec3::Zero();  ///< rad/s
};

/// The most hands of a session.
inline constexpr std::size_t kMaxHands = 4;

/// Physics -> haptic, render: all bones after physics step `step`.
struct BoneSnapshot {
  std::uint64_t step = 0;
  double time_s = 0;
  std::uint32_t epoch = 0;       ///< how often the world has gone back to a restore point
  std::uint64_t saved_step = 0;  ///< newest step whose state is to be kept with the hands' own
  std::uint32_t count = 0;
  std::array<BoneMotion, kMaxBones> bones{};
  std::array<ToolGuide, kMaxHands> guides{};  ///< of each hand
  GuideRods rods{};
  GraftBenchState bench{};      ///< off: the case has no bench
  GraftPlacingState placing{};  ///< off: there are no tunnels for a graft, or it is not there yet
  BendState bend{};             ///< off: no joint was bent
  KneeExamState exam{};         ///< off: nobody has told how the knee gives
  WaterState water{};           ///< off: the case has no joint that is filled
  LooseBones loose{};           ///< pieces of bone that were cut off
  SoftTold softs{};             ///< of what is soft and felt
  std::array<InsideList, kMaxHands> inside{};  ///< what the tip of each hand's instrument is in
};
static_assert(kBenchHands == kMaxHands && kPlacingHands == kMaxHands);
static_assert(std::tuple_size_v<decltype(SoftTold::touches)> == kMaxHands);

/// One place where the tool touches a bone.
struct Contact {
  BoneId bone;
  std::uint32_t piece = 0;
  Vec3 p_W = Vec3::Zero();
  Vec3 nhat_BT_W = Vec3::UnitZ();       ///< unit, from bone to tool
  double depth_m = 0;                   ///< how far the hand is past the surface, along the normal
  Vec3 force_on_tool_W = Vec3::Zero();  ///< N
};
inline constexpr std::size_t kMaxContacts = 8;

/// One place where the tool touches that of another hand.
struct ToolContact {
  std::uint32_t hand = 0;  ///< the other
  Vec3 p_W = Vec3::Zero();
  Vec3 nhat_W = Vec3::UnitZ();          ///< unit, towards this tool
  Vec3 force_on_tool_W = Vec3::Zero();  ///< N
};
inline constexpr std::size_t kMaxToolContacts = 3;

/// What happened in a haptic tick; bits.
enum TickStatus : std::uint32_t {
  kTickOk = 0,
  kTickInputNotFinite = 1u << 0,  ///< the sample was refused; force is zero
  kTickForceNotFinite = 1u << 1,  ///< the tick's own result was refused; force is zero
  kTickForceClamped = 1u << 2,    ///< the device's limit was reached
  kTickForceSlewed = 1u << 3,     ///< the rate limit was reached
  kTickSolverLimit = 1u << 4,     ///< a contact query stopped early; the proxy stayed where it was
  kTickProxyBlocked = 1u << 5,    ///< no free position found; the proxy stayed where it was
  kTickRotationHeld = 1u << 6,    ///< the proxy kept its old orientation to stay out of bone
  kTickSticking = 1u << 7,        ///< static friction holds
  kTickGrabbing = 1u << 8,        ///< the hand drags against a spring and touches nothing
  kTickFading = 1u << 9           ///< after a change of instrument or state the force fades to zero
};

inline constexpr std::uint32_t kNoPortal = 0xffffffffu;

/// Haptic -> physics, render, metrics: the tool after haptic tick `tick`.
struct ToolState {
  std::uint64_t tick = 0;
  double time_s = 0;
  Pose X_WD;                    ///< the hand
  Pose X_WP;                    ///< the proxy: the tool, kept out of bone
  Vec3 v_W = Vec3::Zero();      ///< of the hand, m/s
  Vec3 force_W = Vec3::Zero();  ///< on the hand, N
  std::uint32_t buttons = 0;
  std::uint32_t status = kTickOk;
  std::uint32_t portal = kNoPortal;  ///< that the shaft passes through, as the loop's list has them
  Vec3 p_portal_W = Vec3::Zero();    ///< where that is
  /// 0: the case's own; of one that was made in skin 1: by a cut, 2: pierced.
  std::uint32_t portal_way = 0;
  std::uint32_t contact_count = 0;
  std::array<Contact, kMaxContacts> contacts{};
  std::uint32_t tool_contact_count = 0;
  std::array<ToolContact, kMaxToolContacts> tool_contacts{};
  std::uint32_t epoch = 0;       ///< how often its hand has gone back to a restore point
  std::uint32_t instrument = 0;  ///< in the session's tray
  double power = 0;              ///< 0 to 1
  double jaw = 0;                ///< 0 closed to 1 open
};

/// What a hand's tick knows of another hand's tool.
struct OtherTool {
  std::uint64_t tick = 0;  ///< of the other hand; 0: nothing is known yet, and nothing felt
  std::uint32_t instrument = 0;
  Vec3 p_WD = Vec3::Zero();  ///< where that hand wants it
  Pose X_WP;                 ///< where it is
  Vec3 v_W = Vec3::Zero();
};
/// One for each hand; a hand's own is not looked at.
using OtherTools = std::array<OtherTool, kMaxHands>;
OtherTool seen_from_outside(const ToolState& tool);

/// Everything that a picture shows at one moment.
struct RenderSnapshot {
  BoneSnapshot bones;
  ToolState tool;
};

static_assert(std::is_trivially_destructible_v<RenderSnapshot>);

/// All bones at rest.
BoneSnapshot rest_snapshot(const Case& the_case);
/// All bones at rest but those of the joint, which stand as it puts them when bent to `degrees`.
BoneSnapshot bent_snapshot(const Case& the_case, const CaseJoint& joint, double degrees);

}  // namespace osteon
