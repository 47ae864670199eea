#pragma once

#include <vector>

#include "rod/rod_contact.h"
#include "rod/rod_system.h"

namespace osteon::rods {

/// One implicit step of a rod, and the memory that it works in (it carries nothing from step to
/// step that could change a result). See RodStepper.
struct RodNewton {
  Rod rod;
  RodSupports supports;
  double dt;
  std::vector<bool> held_frame;
  std::vector<double> span;
  std::vector<double> inertia;  // of segments across, kg m^2; half of that along
  ContactFinder finder;
  RodSystem system;
  std::vector<long> held_parts;  // first places of registers that hold something

  // Of the step under way.
  double h = 0, now_s = 0;       // its length, the time at its end
  std::vector<Vec3> start_x, x;  // x: only where something may touch
  std::vector<RodTouch> touches;
  std::vector<RodContact> contacts;
  bool settling = false;  // the last way was so short that the factors are still good
  double last_size = 0;

  RodNewton(Rod r, RodSupports s, double step_s);

  void begin(const RodState& state);
  void place_grips();
  RodNumbers numbers() const;
  double potential(const RodPose& at) const;
  double turning_j(const Quat& from, const Quat& to, std::size_t i) const;
  void assemble(bool with_stiffness);
  void add_contacts(bool with_stiffness);
  void release(RodSystem::Values& values) const;
  void find_way();
  void conjugate();
  void add_couplings(const RodSystem::Values& at, RodSystem::Values& out) const;
  void try_way(double share);
  bool go();
  void finish(RodState& state);
  void advance(RodState& state, double from_s, double length_s);
};

}  // namespace osteon::rods
