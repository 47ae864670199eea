#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"
#include "osteon/mesh/covered_surface.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Height of a point over a bone's surface.
struct FieldSample {
  /// m, negative inside. Where `near` is false a bound: the surface is at least that far.
  double distance = 0;
  Vec3 gradient = Vec3::Zero();  ///< of `distance`, upwards; far from the surface a rough direction
  bool near = false;             ///< within the band, where both are interpolated
};

struct FieldOptions {
  double cell_m = 0.00025;     ///< wanted; finer on a bone of less than 16 such cells
  double outside_m = 0.00125;  ///< the band's reach: at least the radius of the tip that will touch
  double inside_m = 0.0005;
  std::size_t most_blocks = 32768;  ///< of memory, 2.7 kB each: cells are doubled until they fit
};

/// All that a field consists of. Nodes stand at lo + cell (i, j, k); a block is 8 x 8 x 8 cells and
/// is stored with the 11 x 11 x 11 coefficients that its splines need, x fastest.
struct FieldData {
  static constexpr int kSide = 8;   ///< cells along a block
  static constexpr int kSpan = 11;  ///< coefficients along a block
  static constexpr std::size_t kBlock = kSpan * kSpan * kSpan;
  static constexpr std::uint32_t kNone = 0xffffffffu;

  double cell_m = 0;
  double step_m = 0;  ///< height that one unit of `height` stands for
  double outside_m = 0, inside_m = 0;
  Aabb box;                ///< of the mesh
  Vec3 lo = Vec3::Zero();  ///< corner of the first block
  std::array<std::int32_t, 3> blocks{};
  std::vector<float> middle;          ///< of each block: the exact height of its middle, m
  std::vector<std::uint32_t> stored;  ///< of each block: its place in `height`; kNone: none
  std::vector<std::int16_t> height;   ///< kBlock a stored block
};

/// Signed distance to a closed mesh, in a narrow band around it: a grid of cubic B-splines (two
/// continuous derivatives) whose coefficients are the exact distances less a sixth of their second
/// differences, which makes the interpolation exact for cubics (quasi-interpolation, de Boor and
/// Fix 1973). Outside of the band only a bound is known. Immutable; queries allocate nothing.
class DistanceField {
 public:
  /// Of a closed mesh that faces outwards; the sign is that of MeshDistance. Fails when the mesh is
  /// empty, open, not finite or without size. Same bits from every compiler.
  static Result<DistanceField> make(const TriMesh& mesh, const FieldOptions& options = {});
  /// Of a bone with layers on it.
  static Result<DistanceField> make(const CoveredSurface& body, const FieldOptions& options = {});
  /// Takes what `data` gave; none when it does not fit together.
  static std::shared_ptr<const DistanceField> from(FieldData data);

  /// At a point of the bone's frame. Not finite: a distance that is not a number.
  FieldSample at(const Vec3& p_B) const;
  /// Its distance alone, the same bits in less time.
  double distance_at(const Vec3& p_B) const;

  const FieldData& data() const { return data_; }
  double cell_m() const { return data_.cell_m; }
  const Aabb& box() const { return data_.box; }
  std::size_t bytes() const;
  std::uint64_t hash() const { return hash_; }

 private:
  explicit DistanceField(FieldData data);
  struct Spot;
  bool find(const Vec3& p_B, Spot& out) const;
  FieldSample beyond_grid(const Vec3& p) const;
  double bound_in(const std::array<int, 3>& block, const Vec3& p) const;
  FieldSample in_far_block(const std::array<int, 3>& block, const Vec3& p) const;
  std::size_t index_of(const std::array<int, 3>& block) const;

  FieldData data_;
  std::uint64_t hash_ = 0;
};

}  // namespace osteon
