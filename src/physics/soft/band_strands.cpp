// Symbols: strand i lies at (x, y) r / 4.5 across the band's section, r the band's radius, in a
// hexagon of four rings about the middle one: 1 + 6 + 12 + 18 + 24 = 61.
#include "osteon/physics/band_strands.h"

#include <array>
#include <bit>

namespace osteon {
namespace {

constexpr int kStrandRings = 4;
constexpr double kPerRadius = kStrandRings + 0.5;  // the outer ones reach the band's surface
constexpr double kHalfRoot3 = 0.86602540378443865;
constexpr double kSpread = 0.25;
constexpr int kScatter = 17;  // 61 is a prime: i * 17 meets each rank once

struct StrandPlace {
  double x = 0, y = 0;
};

constexpr std::array<StrandPlace, kStrands> places() {
  std::array<StrandPlace, kStrands> out{};
  std::size_t n = 0;
  for (int row = -kStrandRings; row <= kStrandRings; ++row) {
    const int size = 2 * kStrandRings + 1 - (row < 0 ? -row : row);
    for (int i = 0; i < size; ++i) out[n++] = {i - 0.5 * (size - 1), kHalfRoot3 * row};
  }
  return out;
}
constexpr std::array<StrandPlace, kStrands> kPlaces = places();

bool is_left(std::uint64_t gone, int strand) { return (gone >> strand & 1) == 0; }

double height(int strand, const StrandAxes& section, const Vec3& nhat_W) {
  const StrandPlace& at = kPlaces[static_cast<std::size_t>(strand)];
  return at.x * section.u_W.dot(nhat_W) + at.y * section.v_W.dot(nhat_W);
}

}  // namespace

double strands_left(std::uint64_t gone) {
  return static_cast<double>(kStrands - std::popcount(gone & kAllStrands)) / kStrands;
}

StrandAxes section_of(const SoftBand& band, const BandSpan& span, const Pose& X_WB) {
  const Vec3 along = (span.b_W - span.a_W).normalized();
  const Vec3 aside = X_WB.rotate(band.section_B);
  const Vec3 flat = aside - aside.dot(along) * along;
  StrandAxes out;
  out.u_W = flat.norm() > 1e-3 ? Vec3(flat.normalized()) : Vec3(along.unitOrthogonal());
  out.v_W = along.cross(out.u_W);
  return out;
}

int strand_under(std::uint64_t gone, const StrandAxes& section, const Vec3& nhat_W) {
  int best = -1;
  double highest = 0;
  for (int i = 0; i < kStrands; ++i) {
    if (!is_left(gone, i)) continue;
    const double here = height(i, section, nhat_W);
    if (best >= 0 && !(here > highest)) continue;
    best = i;
    highest = here;
  }
  return best;
}

double hollow_m(const SoftBand& band, std::uint64_t gone, const StrandAxes& section,
                const Vec3& nhat_W) {
  if (gone == 0 || (gone & kAllStrands) == kAllStrands) return 0;
  const double whole = height(strand_under(0, section, nhat_W), section, nhat_W);
  const double left = height(strand_under(gone, section, nhat_W), section, nhat_W);
  return (whole - left) * band.radius_m / kPerRadius;
}

Vec3 off_strand(const SoftBand& band, int strand, const StrandAxes& section) {
  const StrandPlace& at = kPlaces[static_cast<std::size_t>(strand)];
  return band.radius_m / kPerRadius * (at.x * section.u_W + at.y * section.v_W);
}

int weakest_strand(std::uint64_t gone) {
  int best = -1;
  for (int i = 0; i < kStrands; ++i)
    if (is_left(gone, i) && (best < 0 || strand_strength(i) < strand_strength(best))) best = i;
  return best;
}

double strand_strength(int strand) {
  return 1 + kSpread * (strand * kScatter % kStrands) / (kStrands - 1);
}

}  // namespace osteon
