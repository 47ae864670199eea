#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "osteon/mesh/distance.h"

namespace osteon {

/// A surface in Patient.
struct ScanTarget {
  MeshDistance distance;
  Aabb box;
};

/// From `depth_m` under the surface on, a tissue has this CT number; a negative depth lies outside.
struct ScanLayer {
  double depth_m = 0;
  double hu = 0;
};

/// How much of a cell a part fills, and its CT number times that share.
struct ScanShare {
  double part = 0, hu = 0;
};

/// CT number by the signed distance to a surface: nothing of the part is seen above its first
/// layer.
class ScanProfile {
 public:
  ScanProfile() = default;
  /// `layers` by rising depth.
  explicit ScanProfile(std::vector<ScanLayer> layers) : layers_(std::move(layers)) {}

  /// The layer at this distance; null outside.
  const ScanLayer* at(double distance_m) const;
  /// Mean over distances within half of `width_m` of `distance_m`.
  ScanShare mean(double distance_m, double width_m) const;
  /// True when no border lies within `reach_m` of `distance_m`.
  bool flat(double distance_m, double reach_m) const;
  /// How far outside the surface anything of it is seen.
  double outside_m() const { return layers_.empty() ? 0 : -layers_.front().depth_m; }

 private:
  std::vector<ScanLayer> layers_;
};

/// Surfaces that are scanned as one: the nearest counts.
using ScanSurfaces = std::vector<ScanTarget>;

struct ScanPart {
  std::size_t surfaces = 0;  ///< index into ScanParts::surfaces; several parts may share them
  ScanProfile profile;
  double cell_m = 0;      ///< the distance may be continued along its gradient within so much
  bool is_shell = false;  ///< an open surface: its sides do not count
};

struct ScanParts {
  std::vector<ScanSurfaces> surfaces;
  std::vector<ScanPart> parts;  ///< what is seen first comes first
};

/// Signed distance to the nearest surface, negative inside, and its gradient.
struct NearSurface {
  double distance = 0;
  Vec3 gradient = Vec3::Zero();
  double at(const Vec3& from_here) const { return distance + gradient.dot(from_here); }
};

/// Distances to surfaces, of many points that lie close to one another.
class NearestSurfaces {
 public:
  explicit NearestSurfaces(const std::vector<ScanSurfaces>& surfaces);
  /// All points are farther than this from the surfaces: a bound that costs little.
  double at_least_m(std::size_t surfaces, const Vec3& p_P) const;
  NearSurface find(std::size_t surfaces, const Vec3& p_P);

 private:
  const std::vector<ScanSurfaces>& surfaces_;
  std::vector<std::size_t> last_;                     ///< of each: which was nearest last
  std::vector<std::vector<std::uint32_t>> triangle_;  ///< of each target: that was nearest last
};

}  // namespace osteon
