#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"
#include "osteon/tissue/solid_material.h"
#include "osteon/tissue/solid_state.h"
#include "osteon/tissue/supports.h"

namespace osteon {

/// An elastic rod of round section along a polyline.
struct RodDef {
  std::vector<Vec3> points_W;  ///< two or more
  double radius_m = 0.001;
  int segments = 40;              ///< of equal length along the polyline
  bool straight_at_rest = false;  ///< else without stress in the shape of the polyline
  SolidMaterial material;
  double friction = 0.3;  ///< of the rod on itself
};

/// Resistance of the section.
struct RodSection {
  double stretch_n = 0, shear_n = 0;     ///< EA, kGA
  double bend_n_m2 = 0, twist_n_m2 = 0;  ///< EI, GJ
};

/// A Cosserat rod made once: nodes, and between two neighbours a segment with a frame, whose third
/// axis is along the rod. N segments have N + 1 nodes.
struct Rod {
  SolidMaterial material;
  RodSection section;
  double radius_m = 0, friction = 0;
  std::vector<Vec3> start_W;     ///< nodes, as the polyline places them
  std::vector<Quat> start_R_WS;  ///< frames of the segments there, without twist
  std::vector<double> length_m;  ///< of each segment at rest
  std::vector<Vec3> rest_turn;   ///< of each inner node: turn between its segments at rest
  std::vector<double> mass_kg;   ///< of each node
  std::size_t segments() const { return length_m.size(); }
};

/// Fails, naming the key, on points that are too few, the same or not finite, a radius, a number of
/// segments or a material that is not sound, and on a rod that passes through itself.
Result<Rod> make_rod(const RodDef& def);

/// A fixed cylinder with round ends that a rod lies on; with both ends the same, a ball.
struct RodObstacle {
  Vec3 from_W = Vec3::Zero(), to_W = Vec3::Zero();
  double radius_m = 0.01;
  double friction = 0;  ///< Coulomb's coefficient
};

/// A rigid grip: nodes and segments that it holds go by `by_m` and turn about its middle, as the
/// ramp says.
struct RodGrip {
  Vec3 by_m = Vec3::Zero(), turn_rad = Vec3::Zero();  ///< turn: axis times angle
  Vec3 middle_W = Vec3::Zero();
  double over_s = 0;
};
struct RodHeldAxis {
  std::uint32_t node = 0, axis = 0, grip = 0;
};
struct RodHeldFrame {
  std::uint32_t segment = 0, grip = 0;
};

/// What acts on a rod from outside. An axis of a node and a frame are held once at most.
struct RodSupports {
  std::vector<RodGrip> grips;
  std::vector<RodHeldAxis> axes;
  std::vector<RodHeldFrame> frames;
  std::vector<NodeLoad> loads;
  std::vector<RodObstacle> obstacles;
  Vec3 gravity_m_per_s2 = Vec3::Zero();
};

/// Friction that sticks: the way that a point of the rod's surface is held back from where it would
/// slide to. `other` is a segment, or the number of segments plus that of an obstacle.
struct RodStick {
  std::uint32_t sample = 0, other = 0;
  Vec3 way_m = Vec3::Zero();
};

/// All that changes: a value, saved and restored by copying.
struct RodState {
  std::vector<Vec3> at_W, velocity_m_per_s;  ///< of nodes
  std::vector<Quat> R_WS;                    ///< of segments
  std::vector<Vec3> spin_rad_per_s;          ///< of segments, in their frames
  std::vector<RodStick> sticks;              ///< by sample, then other
  std::vector<Vec3> grip_n, grip_n_m;        ///< force of each grip, moment about its middle
  std::uint64_t tick = 0;
};
std::uint64_t hash_of(const RodState& state);

/// Steps a rod: implicit Euler, so stable for any length of step and a little damping. Each step
/// lowers
///   sum m / (2 dt^2) |x - x*|^2 + elastic energy + contact + friction - work of the loads
/// by Newton's method on positions and turns; the chain's matrix has a band of nine numbers and is
/// solved directly, self-contact by conjugate gradients about it. Compliance is the material's own:
/// what comes to rest is the closed form's shape whatever the step.
/// Sources: Kugelstadt, Schoemer 2016 (positions and orientations); Deul and others 2018 (direct
/// solution of the chain); Li and others 2020 (friction as a potential).
class RodStepper {
 public:
  RodStepper(Rod rod, RodSupports supports, double step_s);
  ~RodStepper();
  RodStepper(RodStepper&&) noexcept;
  RodStepper& operator=(RodStepper&&) noexcept;

  const Rod& rod() const;
  const RodSupports& supports() const;
  double step_s() const;
  RodState start_state() const;
  /// A function of the state alone.
  void step(RodState& state);
  SolidEnergy energy(const RodState& state) const;

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

/// A step in which no grip drags the rod further than a quarter of its radius; a millisecond at
/// most.
double fitting_step_s(const Rod& rod, const RodSupports& supports, double time_s);

/// The first segment that is not finite, or squeezed below a twentieth of its length.
std::optional<std::size_t> find_lost(const Rod& rod, const RodState& state);

/// The skin of a rod: cross sections carried by the nodes, w = t + R w0 (generalized cylinder),
/// closed at both ends. Triangles face outwards.
struct RodSurface {
  std::vector<Vec3> points_W;
  std::vector<std::uint32_t> triangles;  ///< three a triangle
};
RodSurface rod_surface(const Rod& rod, std::span<const Vec3> at_W, std::span<const Quat> R_WS);

}  // namespace osteon
