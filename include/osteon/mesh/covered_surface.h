#pragma once

#include <cstdint>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/mesh/distance.h"

namespace osteon {

/// A bone with layers on it, of cartilage for example, as one solid: what can be touched of both.
/// The layers may touch the bone or each other, overlap them, or lie up to kGap_m above them: what
/// is between counts as inside. Exact but for the layers' rims, which are found to 0.1 mm.
/// Immutable; queries may run on several threads. The same bits from every compiler.
class CoveredSurface {
 public:
  static constexpr double kGap_m = 0.0003;

  /// All in one frame. Fails when the bone or a layer is not a closed surface that faces outwards,
  /// or a vertex is not finite; the message of a layer names its place in the list.
  static Result<CoveredSurface> make(const TriMesh& bone, const std::vector<TriMesh>& layers);

  /// Nearest point of what can be touched; distance negative inside bone or layer. `guess`, as
  /// MeshDistance has it, is a triangle of `touched`.
  ClosestPoint closest(const Vec3& p, std::uint32_t guess) const;
  ClosestPoint closest(const Vec3& p) const;

  /// What can be touched: a surface with seams, not closed.
  const TriMesh& touched() const { return touched_.mesh(); }
  const TriMesh& bone() const { return bone_.mesh(); }
  std::size_t layers() const { return layers_.size(); }
  const TriMesh& layer(std::size_t i) const { return layers_[i].mesh(); }

 private:
  struct Maker;
  CoveredSurface(MeshDistance bone, std::vector<MeshDistance> layers, MeshDistance touched);
  bool inside(const Vec3& p) const;

  MeshDistance bone_;
  std::vector<MeshDistance> layers_;
  MeshDistance touched_;
  std::vector<std::uint8_t> seams_;  ///< of each triangle that can be touched: its open sides
};

}  // namespace osteon
