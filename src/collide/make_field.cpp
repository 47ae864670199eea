// Making of a distance field from a mesh.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "node_heights.h"
#include "osteon/collide/distance_field.h"
#include "osteon/mesh/distance.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

using Block = std::array<int, 3>;

constexpr int kSide = FieldData::kSide;
constexpr int kSpan = FieldData::kSpan;
constexpr double kLeastSize = 1e-6;  // m; below this nothing is a bone
constexpr int kLeastCells = 16;      // along a bone's longest side
// Nodes before the first block's corner: one for the splines, one for their second differences.
constexpr int kBefore = 2;

class FieldMaker {
 public:
  FieldMaker(const HeightSource& surface, const FieldOptions& options, double cell_m)
      : options_(options), heights_(lay_out(surface, cell_m)) {}

  /// None when it would take more blocks than allowed.
  std::optional<FieldData> run() {
    std::size_t found = 0;
    for_each_block([&](const Block& block) {
      const double middle = heights_.exact(place(block, 0.5, 0.5, 0.5));
      data_.middle.push_back(static_cast<float>(middle));
      const bool wanted = found <= options_.most_blocks && near(middle, 1) && band_crosses(block);
      data_.stored.push_back(wanted ? static_cast<std::uint32_t>(found) : FieldData::kNone);
      found += wanted;
    });
    if (found > options_.most_blocks) return std::nullopt;
    data_.height.reserve(found * FieldData::kBlock);
    std::size_t i = 0;
    for_each_block([&](const Block& block) {
      if (data_.stored[i++] != FieldData::kNone) store(block);
    });
    return std::move(data_);
  }

 private:
  NodeHeights lay_out(const HeightSource& surface, double cell_m) {
    const double margin = options_.outside_m + cell_m;
    data_.cell_m = cell_m;
    data_.outside_m = options_.outside_m;
    data_.inside_m = options_.inside_m;
    data_.box = surface.box;
    data_.lo = data_.box.lo - Vec3::Constant(margin);
    NodeHeights::Node nodes{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double wide = data_.box.extent()[static_cast<Eigen::Index>(k)] + 2 * margin;
      data_.blocks[k] = 1 + static_cast<std::int32_t>(std::floor(wide / (kSide * cell_m)));
      nodes[k] = kSide * data_.blocks[k] + kSpan + 2;
    }
    // No height of a stored block can be larger: the band reaches into each.
    const double side = (kSide + 4) * cell_m;
    const double most = std::max(options_.outside_m, options_.inside_m) + 1.75 * side;
    data_.step_m = most / 32767;
    return {surface, data_.lo - Vec3::Constant(kBefore * cell_m), cell_m, nodes};
  }

  template <class Visit>
  void for_each_block(const Visit& visit) {
    for (int k = 0; k < data_.blocks[2]; ++k)
      for (int j = 0; j < data_.blocks[1]; ++j)
        for (int i = 0; i < data_.blocks[0]; ++i) visit(Block{i, j, k});
  }

  Vec3 place(const Block& block, double x, double y, double z) const {
    return data_.lo + kSide * data_.cell_m * Vec3(block[0] + x, block[1] + y, block[2] + z);
  }

  /// Whether the band may come into a cube of that share of a block's side about such a height.
  bool near(double middle, double share) const {
    const double reach = 0.87 * share * kSide * data_.cell_m;
    return middle - reach < options_.outside_m && middle + reach > -options_.inside_m;
  }

  bool band_crosses(const Block& block) {
    constexpr int kParts = 4;
    for (int k = 0; k < kParts; ++k)
      for (int j = 0; j < kParts; ++j)
        for (int i = 0; i < kParts; ++i) {
          const double x = (i + 0.5) / kParts, y = (j + 0.5) / kParts, z = (k + 0.5) / kParts;
          if (near(heights_.exact(place(block, x, y, z)), 1.0 / kParts)) return true;
        }
    return false;
  }

  double height(int i, int j, int k) { return static_cast<double>(heights_.at({i, j, k})); }

  /// Coefficient of the spline on a node: its height less a sixth of the second differences.
  double coefficient(int i, int j, int k) {
    const double here = height(i, j, k);
    const double x = height(i - 1, j, k) - 2 * here + height(i + 1, j, k);
    const double y = height(i, j - 1, k) - 2 * here + height(i, j + 1, k);
    const double z = height(i, j, k - 1) - 2 * here + height(i, j, k + 1);
    return here - (x + y + z) / 6;
  }

  void store(const Block& block) {
    const int i0 = kSide * block[0] + kBefore - 1;
    const int j0 = kSide * block[1] + kBefore - 1;
    const int k0 = kSide * block[2] + kBefore - 1;
    for (int k = k0; k < k0 + kSpan; ++k)
      for (int j = j0; j < j0 + kSpan; ++j)
        for (int i = i0; i < i0 + kSpan; ++i) {
          const double units = std::round(coefficient(i, j, k) / data_.step_m);
          data_.height.push_back(static_cast<std::int16_t>(std::clamp(units, -32767.0, 32767.0)));
        }
  }

  FieldOptions options_;
  FieldData data_;
  NodeHeights heights_;
};

Result<void> check(const TriMesh& mesh) {
  constexpr const char* kMend = "Repair the mesh with 'osteon import mesh', or feel it as pieces";
  if (mesh.triangles.empty()) return fail("the mesh has no triangles", "distance field", kMend);
  for (const Vec3& v : mesh.vertices)
    if (!is_finite(v)) return fail("a vertex is not finite", "distance field", kMend);
  const Topology shape = topology(mesh);
  if (shape.boundary_edges > 0)
    return fail("the mesh is open: " + std::to_string(shape.boundary_edges) +
                    " edges have one triangle only",
                "distance field", kMend);
  if (!shape.closed())
    return fail("the mesh is not one closed surface that faces outwards", "distance field", kMend);
  if (!(volume(mesh) > 0)) return fail("the mesh is inside out", "distance field", kMend);
  if (!(bounds(mesh).extent().maxCoeff() > kLeastSize))
    return fail("the mesh is smaller than a micrometre", "distance field", "Check its unit");
  return {};
}

// Symbols: f is the signed distance at a node, c = f - (second differences of f) / 6 the
// coefficient of the cubic B-spline there, which is f to fourth order (quasi-interpolation, de Boor
// 1978). Invariant: a block is stored wherever the band may reach into it, since a distance rises
// by no more than the way. Ends: each round doubles the cell, until the box takes few enough
// blocks.
FieldData make_data(const HeightSource& surface, const FieldOptions& options) {
  constexpr double kMostBlocks = 4e6;   // of the whole box
  constexpr double kFinest = 1.0 / 40;  // of the band
  const double wanted = surface.box.extent().maxCoeff() / kLeastCells;
  double cell = std::min(options.cell_m, std::max(wanted, kFinest * options.outside_m));
  for (;; cell *= 2) {
    const Vec3 wide = surface.box.extent() + Vec3::Constant(2 * (options.outside_m + cell));
    if ((wide / (kSide * cell)).array().ceil().prod() > kMostBlocks) continue;
    if (auto data = FieldMaker(surface, options, cell).run()) return std::move(*data);
  }
}

}  // namespace

Result<DistanceField> DistanceField::make(const TriMesh& mesh, const FieldOptions& options) {
  if (auto sound = check(mesh); !sound) return tl::unexpected(sound.error());
  const MeshDistance exact(mesh);
  const HeightSource source{
      bounds(mesh), [&](const Vec3& p, std::uint32_t guess) { return exact.closest(p, guess); }};
  return DistanceField(make_data(source, options));
}

Result<DistanceField> DistanceField::make(const CoveredSurface& body, const FieldOptions& options) {
  if (auto sound = check(body.bone()); !sound) return tl::unexpected(sound.error());
  const HeightSource source{bounds(body.touched()), [&](const Vec3& p, std::uint32_t guess) {
                              return body.closest(p, guess);
                            }};
  return DistanceField(make_data(source, options));
}

}  // namespace osteon
