#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "osteon/tissue/solve.h"
#include "osteon/tissue/supports.h"

namespace osteon {

/// A part that is turned inside out or not finite.
struct LostPart {
  std::string part;
  Vec3 at_m = Vec3::Zero();
};

/// One way of solving a scene, made with all that it needs; `solve` steps it. A table in solve.cpp
/// chooses by body and model.
class Solver {
 public:
  virtual ~Solver() = default;
  virtual std::size_t elements() const = 0;
  virtual double step_s() const = 0;
  virtual void step() = 0;
  /// Quick; may be half a step old.
  virtual double kinetic_j() const = 0;
  virtual SolidEnergy energy() = 0;
  /// By entry: those of scene.fixed, then those of scene.moved.
  virtual std::vector<Vec3> reactions() = 0;
  /// Moments of the same about the middle of what they hold; none for solids.
  virtual std::vector<Vec3> moments() { return {}; }
  /// Way of scene.probes_m[i] from its rest place.
  virtual Vec3 probe_moved(std::size_t i) const = 0;
  virtual SolveShape shape() const = 0;
  virtual std::optional<LostPart> find_lost() const = 0;
  /// Keeps the state as it is now; goes back to the one kept.
  virtual void keep() = 0;
  virtual void go_back() = 0;
};

Result<std::unique_ptr<Solver>> make_hex_solver(const SolveScene& scene);
Result<std::unique_ptr<Solver>> make_tet_solver(const SolveScene& scene);
Result<std::unique_ptr<Solver>> make_rod_solver(const SolveScene& scene);

/// A node of a body at rest.
struct BodyNode {
  std::uint32_t slot = 0;
  Vec3 rest_W = Vec3::Zero();
  double mass_kg = 0;
};

/// What the boxes of a scene mean for a body's nodes. A box takes the nodes on its sides too
/// (within a millionth of the body's size). Of several supports that hold the same axis of a node
/// the last counts, those of `moved` after those of `fixed`. Fails, naming the key, on a box
/// without nodes.
Result<Supports> place_supports(const SolveScene& scene, std::span<const BodyNode> nodes);

/// The number of equal steps, none longer than `longest_s`, that fill `time_s`; 1 at least.
std::uint64_t steps_for(double time_s, double longest_s);

/// More than a day of computing is refused before it begins.
Result<void> check_work(const SolveScene& scene, double step_s, std::size_t elements);

}  // namespace osteon
