#pragma once

#include <cstdint>

#include "osteon/base/types.h"
#include "osteon/scene/soft_band.h"

namespace osteon {

/// A band as strands side by side, in rings of six about a middle one, that all go from bone to
/// bone and are stretched alike. Bits of a word say which of them are cut or torn.
inline constexpr int kStrands = 61;
inline constexpr std::uint64_t kAllStrands = (std::uint64_t{1} << kStrands) - 1;

/// The share of the strands that is left.
double strands_left(std::uint64_t gone);

/// `X_WB`: of the band's first bone.
StrandAxes section_of(const SoftBand& band, const BandSpan& span, const Pose& X_WB);

/// By so much the surface of what is left lies deeper than that of the whole, seen along `nhat_W`
/// from outside. The same to the last bit, zero, where nothing is gone.
double hollow_m(const SoftBand& band, std::uint64_t gone, const StrandAxes& section,
                const Vec3& nhat_W);
/// The strand that an edge meets first that comes from where `nhat_W` points. Some must be left.
int strand_under(std::uint64_t gone, const StrandAxes& section, const Vec3& nhat_W);

/// From the band's middle line to a strand.
Vec3 off_strand(const SoftBand& band, int strand, const StrandAxes& section);

/// The weakest that is left, and how much more than the mean load of the whole band at its failure
/// each one bears: the weakest none, the strongest a quarter more (D). So the load is highest as
/// the first one tears, and the others follow as the band is stretched further.
int weakest_strand(std::uint64_t gone);
double strand_strength(int strand);

}  // namespace osteon
