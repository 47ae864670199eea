#pragma once

#include <memory>
#include <span>

#include "osteon/physics/ring_state.h"
#include "osteon/scene/case.h"
#include "osteon/scene/rings.h"
#include "osteon/scene/state.h"

namespace osteon {

/// Rigid rings that jaws carry. A ring is held once jaws shut about it, and moves with them; it
/// gives way where it meets a peg or the ground, and slips out of the jaws when it would have to
/// give way too far. Jaws of a second hand may shut about it as well: it stays with them when the
/// first ones open. Let go it turns flat, falls straight down, slides off the top of a peg, and
/// comes to rest on what is under it: about a peg, or beside it. A function of its state and the
/// tools' states given to it; a step allocates nothing.
///
/// Neither does a hand feel a ring, nor do rings push each other aside. Pegs and ground are taken
/// where they are at rest.
class LooseRings {
 public:
  static constexpr double kShut = 0.15;       ///< of the jaws' way: below it a ring is held
  static constexpr double kGrip_m = 0.0015;   ///< behind the tip: where jaws hold
  static constexpr double kReach_m = 0.0022;  ///< so far from the grip a ring is still taken
  static constexpr double kSlip_m = 0.002;

  LooseRings(std::shared_ptr<const Case> the_case, double step_s);
  /// A tool of another epoch than the world's holds nothing: it is elsewhere now.
  void step(std::span<const ToolState* const> tools, std::uint32_t epoch);
  std::size_t count() const { return set_.rings.size(); }
  std::uint32_t bone(std::size_t ring) const { return set_.rings[ring].bone; }
  /// As a snapshot has it: a ring that rests does not move at all.
  BoneMotion motion(std::size_t ring) const;

  const RingsState& state() const { return state_; }
  std::uint64_t hash() const;
  /// Whether it can be a state of these rings.
  bool fits(const RingsState& state) const;
  void restore(const RingsState& state);
  /// The rings as they were then; what jaws held falls, for the hands stay where they are now.
  void go_back(const RingsState& state);

 private:
  bool is_in_jaws(std::size_t ring, const ToolState& tool, double reach_m) const;
  void take(std::uint8_t hand, const ToolState& tool);
  void let_go(std::uint8_t hand, std::span<const ToolState* const> tools);
  void carry(std::size_t ring, const ToolState& tool);
  void begin_to_fall(std::size_t ring);
  void fall(std::size_t ring);
  void heed(std::uint8_t hand, std::span<const ToolState* const> tools);
  Vec3 center_W(std::size_t ring) const;
  void put_center(std::size_t ring, const Vec3& center_W);
  Vec3 out_of_pegs(std::size_t ring, bool sideways) const;
  double height_of_rest(std::size_t ring) const;

  std::shared_ptr<const Case> case_;
  RingSet set_;
  double step_s_;
  RingsState state_;
  std::array<Vec3, kMaxRings> before_W_{};  // middles at the step before: for the speeds
};

}  // namespace osteon
