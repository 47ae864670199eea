#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "contact_field.h"
#include "field_walls.h"
#include "nearest_point.h"
#include "osteon/base/types.h"
#include "portal_pivot.h"
#include "tool_walls.h"

namespace osteon {

/// What the proxy is asked to do in one tick.
struct ProxyTask {
  Pose X_WP;                   ///< where it was, free of the bones in their poses before
  Vec3 base_W = Vec3::Zero();  ///< where it starts: X_WP.p, carried along by the bone it rests on
  Vec3 hand_W = Vec3::Zero();  ///< where it is drawn to
  Quat q_WP;                   ///< how it should be turned
  double reach_m = 0;          ///< it stays within this distance of its start
  bool held = false;           ///< bone held it in the last tick
  std::span<const Pose> before_WB;
  std::span<const Pose> now_WB;
  const OtherTools* others_before = nullptr;  ///< of other hands; null: there are none
  const OtherTools* others_now = nullptr;
  const PortalRing* ring = nullptr;  ///< of the portal that the shaft is in; null: none
};

/// A plane of bone, or of another hand's tool, that holds the proxy back.
struct HoldingPlane {
  std::uint32_t pair = 0;           ///< of bone and tool
  std::uint32_t other = kMaxHands;  ///< the other hand; kMaxHands: it is bone
  Vec3 nhat_BT_W = Vec3::UnitZ();
  double weight = 0;        ///< m: the planes' weights times normals add up to proxy - hand
  double depth = 0;         ///< of the hand behind this plane, m
  Vec3 p_W = Vec3::Zero();  ///< contact point, when the tool's origin is at the move's `query_W`
};

/// The proxy without friction. The path from its start to its end, straight between its points,
/// is free of bone as they are.
struct ProxyMove {
  static constexpr std::size_t kMaxRounds = 8;
  Quat q_WP;
  std::array<Vec3, kMaxRounds + 1> path{};
  std::uint32_t path_count = 0;
  std::array<HoldingPlane, 3> holding{};
  std::uint32_t holding_count = 0;  ///< without touch: none, unless the task says `held`
  Vec3 query_W = Vec3::Zero();
  std::uint32_t status = 0;  ///< TickStatus bits
  std::uint32_t rounds = 0;
  bool free = false;  ///< nothing lies between the proxy and the hand

  const Vec3& end() const { return path[path_count - 1]; }
};

/// Moves the proxy to the point nearest to the hand that it can reach without entering bone.
///
/// Each candidate pair is parted by a plane (the depth programme's normal, with the exact supports
/// of both pieces in its direction). Any place beyond all planes is free, and so is the straight
/// way to it, since half-spaces are convex: the proxy cannot tunnel, however far the hand jumps.
/// The planes of the last free pose are valid in the new one with the new supports, so neither a
/// turn of the tool nor a moving bone lets it slip to a bone's other side. Then the planes
/// that hold it are found again at the new place until it stands still (Zilles and Salisbury's
/// god-object, IROS 1995, with one convex local region a round). Bones felt as distance fields have
/// planes that hold close by only; there the way is looked at too (FieldWalls).
class ProxySolver {
 public:
  ProxySolver(const ContactField& field, const Tool& tool,
              std::span<const std::shared_ptr<const Tool>> tray)
      : field_(field), around_(field.vicinity()), walls_(field), tools_(tool, tray) {}
  /// `memory`: of kMaxCandidates pairs, those that were near, in their order. Nothing else that a
  /// move leaves changes the next.
  ProxyMove move(const ProxyTask& wanted, std::span<PairMemory> memory);

 private:
  /// What one move has from its caller and works with; gone when it ends.
  struct Context {
    ProxyTask task;  ///< its turn cut short where too much is near
    std::span<PairMemory> memory;
    double reach_m = 0;
    /// Poses of the bones and of the tool at the start of the move.
    std::span<const Pose> start_WB = {};
    Pose start_WT = {};
    /// Poses of the bones and turn of the tool for which `planes_` are right.
    std::span<const Pose> raised_WB = {};
    Quat raised_q_WT = Quat::Identity();
    bool stopped = false;  ///< a field stopped the last step on its way
    bool stuck = false;    ///< and that step led nowhere: no plane names the bone in the way
  };

  bool gather(Context& c);
  void recall(Context& c);
  void raise(const Context& c, std::uint32_t i);
  void settle(const Context& c, std::uint32_t i);
  bool beyond(const Context& c, std::uint32_t i, const Vec3& x);
  bool inside_all(const Context& c, const Vec3& x);
  NearestPoint nearest(const Context& c, const Vec3& wanted);
  bool part(Context& c, std::uint32_t i, const Vec3& p_W);
  bool part_all(Context& c);
  void raise_planes(Context& c, const Quat& q_WT);
  bool part_better(Context& c);
  bool enter_free_space(Context& c, const Quat& q_WP, ProxyMove& move);
  void leave_overlap(Context& c, ProxyMove& move);
  void approach(Context& c, ProxyMove& move);
  bool step_towards(Context& c, ProxyMove& move, NearestPoint& target);
  bool look_again(Context& c, const NearestPoint& target, ProxyMove& move);
  bool touching(const NearestPoint& target) const;
  bool looked(const NearestPoint& target) const;
  void note_block(const Context& c, const NearestPoint& target, ProxyMove& move);
  /// Of the planes that hold it, those whose gap is not more.
  void note_holding(const ProxyTask& task, const NearestPoint& target, ProxyMove& move,
                    double most_gap_m) const;
  void meet_tools(const ProxyTask& task);
  bool find_start(Context& c, const Quat& q_WP, Vec3& start);
  /// Planes: those of the pieces, then those of the fields, then those of other hands' tools, then
  /// those of the portal.
  std::uint32_t bone_planes() const { return near_.count + walls_.count(); }
  std::uint32_t felt_planes() const { return bone_planes() + tools_.count(); }
  std::uint32_t plane_count(const Context& c) const {
    return felt_planes() + (c.task.ring ? PortalRing::kPlanes : 0);
  }
  std::span<const FreeHalfSpace> planes(const Context& c) const {
    return {planes_.data(), plane_count(c)};
  }
  std::uint32_t pair_of(std::uint32_t i) const {
    return i < near_.count ? near_.pair[i] : walls_.pair(i - near_.count);
  }
  const PartingPlane& plane_of(std::uint32_t i) const {
    return i < near_.count ? parting_[i] : walls_.plane(i - near_.count);
  }
  /// Of a plane, at the start of the move. A tool's plane holds only where hands push together.
  double gap_of(std::uint32_t i) const { return i < bone_planes() ? plane_of(i).gap : 0; }

  const ContactField& field_;
  ToolVicinity around_;
  std::array<PairMemory, kMaxCandidates> last_{};  ///< for recall
  CandidateList near_;
  std::array<PartingPlane, kMaxCandidates> parting_{};
  std::array<bool, kMaxCandidates> looked_{};  ///< found in this move
  FieldWalls walls_;
  ToolWalls tools_;
  std::array<FreeHalfSpace, kMaxCandidates + FieldWalls::kMostPlanes + ToolWalls::kMostPlanes +
                                PortalRing::kPlanes>
      planes_{};
  /// Of the pieces' planes: false while c may be too large, as outer_half_space has it.
  std::array<bool, kMaxCandidates> settled_{};
  std::array<bool, kMaxCandidates> gap_known_{};  ///< `parting_` has the gap at the start
};

}  // namespace osteon
