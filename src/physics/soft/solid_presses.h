#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "osteon/collide/field_view.h"
#include "osteon/physics/soft_setup.h"
#include "osteon/physics/soft_state.h"
#include "osteon/scene/soft_pushes.h"
#include "osteon/scene/state.h"

namespace osteon {

/// A hand's tool in a step, for solids.
struct SolidHand {
  const ToolState* tool = nullptr;  ///< null: it touches nothing
  std::span<const RoundBox> parts;  ///< of the tool
  std::uint64_t lifted = 0;         ///< which of them are out of the way
  std::uint32_t held = kMaxSolids;  ///< which solid its jaws hold: no part presses that one
  std::array<double, kMaxSolids> force_n{}, deep_m{};
  std::array<Vec3, kMaxSolids> p_W{};  ///< where it is pressed, of the last part
};

/// The soft solids of a session at the physics' rate. Of each part of a tool near one it keeps the
/// place that the part would have, were the solid rigid; the way from there to where the part is
/// is what the solid has to give way by. A solid that no tool is near is asleep: nothing is done
/// for it, and the state says the same as if something were.
///
/// A step allocates, locks and logs nothing.
class SolidPresses {
 public:
  SolidPresses(const SoftSetup& setup, double coupling_n_per_m)
      : solids_(setup.solids),
        coupling_n_per_m_(coupling_n_per_m),
        bounded_(setup.presses_are_bounded),
        covered_wait_(setup.covered_parts_wait) {}

  /// What cuts have left of a solid: its holes, and what it is like now. Nulls: it is whole.
  void set_cut(std::size_t solid, const CutField* holes, std::shared_ptr<const PressedSolid> body) {
    holes_[solid] = holes;
    bodies_[solid] = std::move(body);
  }
  Pose X_WB(std::size_t solid) const { return X_WB_[solid]; }
  /// Its surface as cuts have left it, in its bone.
  FieldView view(std::size_t solid) const { return {*solids_[solid].field, holes_[solid]}; }
  /// Middle of the axis of the part that is near, where it is.
  Vec3 middle(const SolidNear& near, const SolidHand& hand) const;
  const PressedSolid& body(std::size_t solid) const {
    return bodies_[solid] ? *bodies_[solid] : *solids_[solid].body;
  }

  /// Follows one hand's parts. False of a solid whose bone has no pose that is a number.
  bool place(std::size_t solid, const BoneSnapshot& bones);
  void follow(SolidHandState& state, const SolidHand& hand, const SoftState& all) const;
  /// How hard each part presses, with all hands in their places.
  void press(SolidHandState& state, SolidHand& hand, const SoftState& all) const;
  bool is_asleep(std::size_t solid, const SoftState& all) const;
  void tell(const SolidHandState& state, BandContacts& contacts) const;
  SoftPushes pushes(const SoftState& all) const;

 private:
  RoundBox in_bone(std::size_t solid, const SolidHand& hand, std::size_t part) const;
  bool is_covered(const SolidHandState& state, const SolidNear& near, const SolidHand& hand,
                  const Vec3& place_B, const Vec3& nhat_B) const;
  bool keep(SolidNear& near, const SolidHand& hand, const SolidHandState& state) const;
  void seek(SolidHandState& state, const SolidHand& hand, std::size_t solid) const;
  std::optional<SoftPushes::One> pull_on(std::size_t solid, const SoftGrip& grip) const;
  double others(const SolidNear& near, const SolidPush& push, const SoftState& all) const;
  double with_pulls(double sum, const SolidNear& near, const SolidPush& push,
                    const SoftState& all) const;

  const std::vector<SoftSolid>& solids_;
  double coupling_n_per_m_;
  bool bounded_, covered_wait_;
  std::array<Pose, kMaxSolids> X_WB_{};
  std::array<const CutField*, kMaxSolids> holes_{};
  std::array<std::shared_ptr<const PressedSolid>, kMaxSolids> bodies_{};
};

}  // namespace osteon
