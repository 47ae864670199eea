#pragma once

#include <cstdint>
#include <vector>

#include "osteon/base/types.h"

namespace osteon::tunnel {

/// Where a facet lies along the drill.
enum class Layer : std::uint8_t { kBefore, kWithin, kBeyond };

struct Facet {
  Triangle v{};
  bool near = false;  ///< may meet the drill; the others share an edge with one that may
  Layer layer = Layer::kBefore;
};

/// The part of a surface that a drill can change, in the drill's frame.
struct Patch {
  std::vector<Vec3> points_A;
  std::vector<Facet> facets;
};

/// An edge of a patch: its two points, the smaller index first.
struct EdgeKey {
  std::uint32_t lo = 0, hi = 0;
  EdgeKey() = default;
  EdgeKey(std::uint32_t a, std::uint32_t b) : lo(a < b ? a : b), hi(a < b ? b : a) {}
  auto operator<=>(const EdgeKey&) const = default;
};

/// Cuts the near facets, and those that share a cut edge, along the plane z = `z_m`: afterwards no
/// near facet lies on both sides. New points have exactly this z. Returns the least distance from
/// the plane of a near facet's point.
double split_at(Patch& patch, double z_m);

/// Says of every near facet where it lies. The patch has been split at both ends.
void sort_into_layers(Patch& patch, double start_m, double end_m);

}  // namespace osteon::tunnel
