#pragma once

#include <array>
#include <optional>
#include <vector>

#include "rod/rod_elastic.h"

namespace osteon::rods {

/// A ball of the rod's radius at a fixed place of a segment: contact is felt there.
struct RodSample {
  std::uint32_t segment = 0;
  double share = 0;      ///< of the way along the segment
  double stiffness = 0;  ///< N/m: Young's modulus times the length that it stands for
  double arc_m = 0;      ///< from the rod's start
  std::uint32_t before = 0, after = 0;  ///< it may touch segments below the one, from the other on
};

/// Samples no further apart than three quarters of the radius.
std::vector<RodSample> samples_of(const Rod& rod);

/// A sample and what it may touch: a segment, or the number of segments plus that of an obstacle.
struct RodPair {
  std::uint32_t sample = 0, other = 0;
};

/// What touches during one step: pairs within reach at its start, and their friction.
struct RodTouch {
  RodPair pair;
  std::array<double, 4> weight{};  ///< of the four nodes at the start: 1 - s, s, t - 1, -t
  double stiffness = 0, reach_m = 0;
  Vec3 normal = Vec3::Zero();   ///< at the start, from the other to the sample
  Vec3 stick_m = Vec3::Zero();  ///< where friction stood at the start
  double hold_n = 0;            ///< friction's bound: coefficient times the force at the start
};

/// Two segments of a rod, not neighbours, that overlap by more than half the thickness at the
/// start; ends that meet may.
std::optional<RodPair> passes_through_itself(const Rod& rod);

/// Finds what touches. What is near is listed by segment and kept until something has moved far: it
/// only saves looking, and does not change what is found.
class ContactFinder {
 public:
  ContactFinder(const Rod& rod, const std::vector<bool>& held_frame);
  const std::vector<RodSample>& samples() const { return samples_; }
  /// Touches within reach: up to 0.6 of the radius from contact; by sample, then other.
  std::vector<RodTouch> find(const Rod& rod, const RodSupports& supports, const RodState& state);

 private:
  void list_near(const Rod& rod, const RodSupports& supports, const std::vector<Vec3>& x);
  void mark_apart(const Rod& rod);
  bool could_touch(const Rod& rod, std::uint32_t segment, std::uint32_t other) const;
  bool may_touch(const Rod& rod, const RodSample& sample, std::uint32_t other) const;
  void look(const Rod& rod, const RodSupports& supports, const RodState& state,
            std::uint32_t sample, std::vector<RodTouch>& out) const;

  std::vector<RodSample> samples_;
  std::vector<bool> held_;
  std::vector<double> arc_m_;                     ///< of each node
  std::vector<std::vector<std::uint32_t>> near_;  ///< of each segment
  std::vector<Vec3> listed_at_;
  double margin_m_ = 0;
};

/// Contact and friction of one touch at a pose: energies, forces on the sample, what they are
/// stiffened by.
struct RodContact {
  std::array<std::size_t, 4> node{};
  std::array<double, 4> weight{};
  std::size_t count = 4;  ///< nodes: two against an obstacle
  double energy_j = 0;
  Vec3 slope = Vec3::Zero();  ///< of the energy, by the sample's place
  Mat3 stiffness = Mat3::Zero();
  double force_n = 0;  ///< along the normal
  Vec3 stick_m = Vec3::Zero();
};
/// `x0`: nodes at the start of the step.
RodContact contact_at(const Rod& rod, const RodSupports& supports, const RodTouch& touch,
                      const std::vector<RodSample>& samples, const std::vector<Vec3>& x0,
                      const std::vector<Vec3>& x);

}  // namespace osteon::rods
