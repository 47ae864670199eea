#pragma once

#include <vector>

#include "rod/rod_contact.h"

namespace osteon::rods {

/// One implicit step of a rod, and the memory that it works in (it carries nothing from step to
/// step that could change a result). See RodStepper.
struct RodNewton {
  Rod rod;
  RodSupports supports;
  double dt;
  std::vector<bool> held_frame;
  std::vector<double> span;
  std::vector<std::size_t> held;  // unknowns
  std::vector<Vec3> inertia;      // of segments, kg m^2
  ContactFinder finder;

  // Of the step under way.
  double h = 0, now_s = 0;  // its length, the time at its end
  RodPose start, aim, pose, tried;
  std::vector<Vec3> force;
  std::vector<RodTouch> touches;
  std::vector<RodContact> contacts;
  RodBand band;
  std::vector<double> slope, way;

  RodNewton(Rod r, RodSupports s, double step_s);

  void begin(const RodState& state);
  void place_grips(RodPose& at) const;
  double potential(const RodPose& at) const;
  double turning_j(const Quat& from, const Quat& to, std::size_t i) const;
  void assemble(bool with_stiffness);
  void add_turning(const Quat& from, std::size_t i, double weight);
  void add_contacts();
  void find_way();
  void conjugate(const std::vector<double>& r0);
  void add_couplings(const std::vector<double>& x, std::vector<double>& out) const;
  void try_way(double share);
  double largest() const;
  bool go();
  void finish(RodState& state);
  void advance(RodState& state, double from_s, double length_s);
};

}  // namespace osteon::rods
