#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"
#include "osteon/collide/distance_field.h"

namespace osteon {

/// A soft solid that lies on something, in the frame of what carries it.
struct PressedSolidDef {
  Aabb box;                                    ///< of its surface
  std::shared_ptr<const DistanceField> field;  ///< of its surface
  Vec3 up = Vec3::UnitZ();                     ///< unit, away from what it lies on
  std::function<bool(const Vec3&)> held;       ///< what is there does not move
  std::function<bool(const Vec3&)> rests;      ///< does not go down when pressed from above
  double stiffness_n_per_m = 900;              ///< to a hand that presses from above
  double poisson = 0.3;
  std::size_t most_nodes = 300;
  /// Young's modulus. 0: what makes a press from above meet `stiffness_n_per_m`, wherever it is.
  double young_pa = 0;
  /// With which fibres along `fibres` (unit) pull before anything presses, where both of their ends
  /// are held; what is free at one end pulls at nothing. Of a solid with a modulus alone.
  double tension_pa = 0;
  Vec3 fibres = Vec3::UnitX();
};

/// Nodes that share a force, and whose mean way is that of the place.
struct SolidPatch {
  static constexpr std::size_t kMost = 48;
  std::uint32_t count = 0;
  std::array<std::uint32_t, kMost> node{};
  std::array<double, kMost> weight{};  ///< 1 in all
};

/// A push on a solid: with `force_n` against `nhat`, which points out of it. Made by push_at.
struct SolidPush {
  SolidPatch patch;
  Vec3 nhat = Vec3::UnitZ();
  double force_n = 0;
  double gain = 1;  ///< what the solid's ways with a modulus of 1 Pa are multiplied by
};

/// A linear elastic solid of cubes, partly filled at its surface, in balance under every load
/// (condensed, after Bro-Nielsen 1998): what it does is a function of the pushes alone. Its
/// stiffness is made once, for two cases: lying on its support, and lifted from it. A push from
/// above meets the first, one from below the second, others a mean of both.
///
/// A hand that presses from above meets the wanted stiffness everywhere: the shape, what one push
/// does elsewhere, and by how much more the solid gives where it is lifted (twice at most) are
/// those of the elastic solid. Of one that was cut it is as much softer as the cuts make it. One
/// with a modulus of its own is as stiff as the elastic solid is, under the tension of its fibres
/// (the stiffness of a stretched string: tension times the slope across).
class PressedSolid {
 public:
  /// Fails on a solid that nothing holds, or that is too small for its cells.
  static Result<PressedSolid> make(const PressedSolidDef& def);
  ~PressedSolid();
  PressedSolid(PressedSolid&&) noexcept;
  PressedSolid& operator=(PressedSolid&&) noexcept;

  SolidPatch patch_at(const Vec3& p) const;
  /// Allocates nothing.
  SolidPush push_at(const Vec3& p, const Vec3& nhat, double force_n = 1) const;
  /// How far `at` gives way along its normal for each newton at `push`, m/N. Allocates nothing.
  double compliance(const SolidPush& at, const SolidPush& push) const;
  /// Ways of all nodes under the pushes, m.
  std::vector<Vec3> moved(std::span<const SolidPush> pushes) const;
  /// The mean of the nodes' ways.
  static Vec3 moved_at(const SolidPatch& patch, std::span<const Vec3> moved);

  Vec3 node_at(std::size_t node) const;
  std::size_t nodes() const;
  std::size_t cells() const;  ///< of a cut one: parts of cells
  double cell_m() const;
  Vec3 cell_lo(std::size_t cell) const;  ///< its lowest corner
  std::uint64_t hash() const;

 private:
  friend class CutSolidWork;
  struct Impl;
  explicit PressedSolid(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace osteon
