#pragma once

#include <cstdint>

#include "osteon/base/types.h"

namespace osteon {

struct SoftBand;
struct BandSpan;

/// A place of a soft part that jaws or suction hold: what physics tells the 1 kHz tick.
struct SoftHold {
  enum class Of : std::uint8_t { kNothing, kBand, kSolid };
  Of of = Of::kNothing;
  std::uint32_t part = 0;        ///< which band or solid
  std::uint32_t bone = 0;        ///< of a solid: that it goes with
  Vec3 p_T = Vec3::Zero();       ///< the held place, in Tool
  double share = 0.5;            ///< of a band: so much of its length lies before that place
  double others_taken_m = 0;     ///< of a band: length of its path that other contacts take
  double left = 1;               ///< of a band: share of its strands that are whole
  Vec3 p_B = Vec3::Zero();       ///< of a solid: the place at rest
  double stiffness_n_per_m = 0;  ///< of a solid there, the way that it is pulled
  /// Above 0: suction holds it, no harder than so. It pulls straight towards the mouth alone:
  /// `stiffness_n_per_m` is then that of solid and mouth together, or of the mouth on a band.
  double most_n = 0;
  Vec3 nhat_B = Vec3::UnitZ();  ///< of a solid that suction holds: unit, out of it
  bool operator==(const SoftHold&) const = default;
};

/// How what is between jaws yields; a hand whose coupling is softer feels that. Stiffer, a heavy
/// hand that holds loosely would swing for long.
inline constexpr double kJawSpring_n_per_m = 1000;

/// How a band is held by jaws.
struct HeldBand {
  Vec3 force_W = Vec3::Zero();  ///< on the tool
  Vec3 held_W = Vec3::Zero();   ///< where the held place of the band is
  double tension_n = 0;         ///< of the leg that is pulled more
  double taken_m = 0;           ///< by so much the string's path is longer than the straight one
};

/// The band as two straight legs to the place that the jaws hold, in balance with a spring of
/// `spring_n_per_m` from there to `grip_W`, where the jaws are. The fibres do not slip in the jaws:
/// each leg has its share of their length. Zero where the band ends or what is held is no number.
HeldBand hold_band(const SoftBand& band, const BandSpan& span, const Vec3& grip_W,
                   const SoftHold& hold, double spring_n_per_m);

/// Force on the mouth at `mouth_W` of a solid that suction holds: `rest_W` and `nhat_W` are of the
/// held place at rest. It only pulls.
inline Vec3 suck_solid(const SoftHold& hold, const Vec3& rest_W, const Vec3& nhat_W,
                       const Vec3& mouth_W) {
  const double gap_m = nhat_W.dot(mouth_W - rest_W);
  if (!(gap_m > 0)) return Vec3::Zero();
  const double pull_n = hold.stiffness_n_per_m * gap_m;
  return -(pull_n < hold.most_n ? pull_n : hold.most_n) * nhat_W;
}

/// Force on the tool of a solid whose held place at rest is `rest_W`: a spring, the solid and
/// `spring_n_per_m` one behind the other.
inline Vec3 hold_solid(const SoftHold& hold, const Vec3& rest_W, const Vec3& grip_W,
                       double spring_n_per_m) {
  const double k = hold.stiffness_n_per_m;
  if (!(k > 0) || !(spring_n_per_m > 0)) return Vec3::Zero();
  const Vec3 force = -(k * spring_n_per_m / (k + spring_n_per_m)) * (grip_W - rest_W);
  return is_finite(force) ? force : Vec3(Vec3::Zero());
}

}  // namespace osteon
