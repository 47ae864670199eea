#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "osteon/physics/bone_loss.h"
#include "osteon/scene/case.h"
#include "osteon/scene/state.h"

namespace osteon {

struct PhysicsParams {
  double step_s = 0.002;         ///< 500 Hz
  bool hold_bones = true;        ///< true: bones do not move; false: springs hold them
  double spring_n_per_m = 3000;  ///< of the soft parts that hold a bone
  double spring_nm_per_rad = 0.5;
  double damping_ratio = 1.0;  ///< 1: critical
  /// Stiffness of the contact through which the tool pushes. The tool answers a bone's step only
  /// one or two steps later; a light bone under a stiff contact would chatter if it did not yield
  /// slowly.
  double contact_n_per_m = 2000;
};

/// Over all that a snapshot holds.
std::uint64_t hash_of(const BoneSnapshot& snapshot);

/// Bones as rigid bodies (Bullet, double precision), each held in its place by a spring and a
/// damper, pushed by the tool. No gravity, no contact between bones. Fixed step; a function of its
/// state and the tool states given to it.
///
/// Springs and dampers are integrated by backward Euler: stable for any mass and step. While the
/// tool pushes a bone, a damper of contact_n_per_m times four steps stands for the late answer. A
/// bone moves at most 20 mm and turns at most about 0.5 rad from its rest pose. A contact whose
/// force is not finite or above 1 kN, or that lies more than 1 m off the bone, is a fault and is
/// not applied.
class BoneWorld {
 public:
  explicit BoneWorld(std::shared_ptr<const Case> the_case, const PhysicsParams& params = {});
  ~BoneWorld();
  BoneWorld(BoneWorld&&) noexcept;

  /// One step under the contact forces of `tool`. The reference stays valid until the next call.
  const BoneSnapshot& step(const ToolState& tool);
  /// The same under several tools, one a hand: their forces add up in their order. A tool of
  /// another epoch than the world's pushes nothing: it has felt bones that are elsewhere now.
  const BoneSnapshot& step(std::span<const ToolState* const> tools);
  const BoneSnapshot& snapshot() const;
  /// Held bones are exactly at rest: holding puts them back there.
  void set_hold(bool hold);
  /// Over the snapshot and whether the bones are held: all that a later step depends on.
  std::uint64_t state_hash() const;
  /// Puts every bone back to a snapshot of this world; continuing gives the same bits.
  void restore(const BoneSnapshot& snapshot, bool hold);
  /// The bones as they were in `kept`, in the next epoch: steps go on counting.
  void go_back(const BoneSnapshot& kept, bool hold);
  bool held() const;
  /// Puts a bone elsewhere that something else moves, after a step.
  void place(std::size_t bone, const BoneMotion& motion);
  /// What leads the hands' instruments, for the next step's snapshot.
  void set_guides(const std::array<ToolGuide, kMaxHands>& guides, const GuideRods& rods);
  /// What lies on the bench, for the next step's snapshot.
  void set_bench(const GraftBenchState& bench);
  /// How far a graft is placed, for the next step's snapshot.
  void set_placing(const GraftPlacingState& placing);
  /// How far the joint is bent, for the next step's snapshot.
  void set_bend(const BendState& bend);
  /// How the knee is examined, for the next step's snapshot.
  void set_exam(const KneeExamState& exam);
  /// How the joint's water is after a step.
  void set_water(const WaterState& water);
  /// Pieces that lie loose, for the next step's snapshot.
  void set_loose(const LooseBones& loose);
  /// What is to be told of soft parts after a step.
  void set_softs(const SoftTold& told);
  /// What the tip of a hand's instrument is in after a step.
  void set_inside(std::size_t hand, const InsideList& list);
  /// Mass, centre and inertia of a bone from now on: those of the whole one less what it has lost,
  /// but no less than a twentieth. The pose stays; a function of `loss` alone.
  void set_loss(std::size_t bone, const BoneLoss& loss);
  double mass_kg(std::size_t bone) const;
  /// Marks the snapshot as one whose state is to be kept.
  void ask_to_keep();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace osteon
