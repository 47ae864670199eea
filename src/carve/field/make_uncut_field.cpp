// Making of a bone's field from its mesh.
#include <algorithm>
#include <cmath>
#include <string>

#include "osteon/base/hash.h"
#include "osteon/carve/uncut_field.h"
#include "osteon/mesh/distance.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

constexpr double kClear = 3;       // cells between the surface and any block that is not stored
constexpr double kLeastCells = 4;  // along the bone's longest side
constexpr double kDiagonal = 1.7320508075688772;

Result<void> check_mesh(const TriMesh& mesh) {
  constexpr const char* kMend = "Repair the mesh with 'osteon import mesh'";
  if (mesh.triangles.empty()) return fail("the bone has no triangles", "carving", kMend);
  for (const Vec3& v : mesh.vertices)
    if (!is_finite(v)) return fail("a vertex of the bone is not finite", "carving", kMend);
  const Topology shape = topology(mesh);
  if (shape.boundary_edges > 0)
    return fail("the bone has holes: " + std::to_string(shape.boundary_edges) +
                    " edges have one triangle only",
                "carving", kMend);
  if (!shape.closed())
    return fail("the bone is not one closed surface that faces outwards", "carving", kMend);
  if (!(volume(mesh) > 0)) return fail("the bone is inside out", "carving", kMend);
  return {};
}

std::string megabytes(double bytes) {
  return std::to_string(static_cast<long long>(std::ceil(bytes / (1 << 20)))) + " MB";
}

tl::unexpected<Error> too_large(double needed, std::size_t allowed) {
  return fail("the field would take " + megabytes(needed) + ", and " +
                  megabytes(static_cast<double>(allowed)) + " are allowed",
              "carving", "Choose larger cells or allow more memory");
}

Result<void> check_options(const Aabb& box, const UncutFieldOptions& options) {
  constexpr double kFinest_m = 2e-5, kCoarsest_m = 2e-3;
  if (!(options.cell_m >= kFinest_m && options.cell_m <= kCoarsest_m))
    return fail("the cell must be 0.02 to 2 mm", "carving", "0.25 mm suits most bones");
  constexpr double kFarthest_m = 0.03;
  if (!(options.outside_m >= 0 && options.outside_m <= kFarthest_m))
    return fail("heights must reach 0 to 30 mm out of the bone", "carving");
  if (!(options.room_m >= 0 && options.room_m <= kFarthest_m))
    return fail("the grid must reach 0 to 30 mm out of the bone", "carving");
  if (!(box.extent().maxCoeff() >= kLeastCells * options.cell_m))
    return fail("the bone is smaller than 4 cells", "carving", "Choose a smaller cell");
  return {};
}

}  // namespace

/// What the field is made of.
struct UncutField::Source {
  Aabb box;
  std::function<ClosestPoint(const Vec3& p, std::uint32_t guess)> closest;
  /// A field on the same grid, of a surface that differs within this box alone; or none.
  const UncutField* like = nullptr;
  Aabb differs = {};
};

// Cubes of blocks are halved until a cube is clear of the surface by its distance, or one block.
struct UncutField::Maker {
  Maker(const Source& bone, const UncutFieldOptions& wanted) : options(wanted), mesh(bone) {}

  const UncutFieldOptions& options;
  const Source& mesh;
  UncutField field = {};
  std::vector<std::uint32_t> near = {};      // stored blocks, in the order of their slots
  std::vector<std::uint32_t> triangle = {};  // of each: nearest to its middle

  using Corner = std::array<int, 3>;
  double cell() const { return field.grid_.cell_m; }

  void lay_out_on(const BlockGrid& grid) {
    field.box_ = mesh.box;
    field.grid_ = grid;
    field.middle_.resize(grid.count());
    field.slot_.assign(grid.count(), kOut);
  }

  Result<void> lay_out() {
    field.box_ = mesh.box;
    const double h = options.cell_m;
    // Nodes stay off faces that lie along the axes.
    const double margin = std::max({kClear * h, options.outside_m, options.room_m}) + 1.37 * h;
    const Vec3 count =
        ((field.box_.extent() + Vec3::Constant(2 * margin)) / (8 * h)).array().ceil();
    const double bytes = 8 * count.prod();
    if (bytes > static_cast<double>(options.most_bytes))
      return too_large(bytes, options.most_bytes);
    field.grid_.cell_m = h;
    field.grid_.lo = field.box_.lo - Vec3::Constant(margin);
    for (std::size_t k = 0; k < 3; ++k)
      field.grid_.blocks[k] = static_cast<int>(count[static_cast<Eigen::Index>(k)]);
    field.middle_.resize(field.grid_.count());
    field.slot_.assign(field.grid_.count(), kOut);
    return {};
  }

  void classify(const Corner& lo, const Corner& hi, std::uint32_t guess) {
    const Vec3 a = field.grid_.node(8 * lo[0], 8 * lo[1], 8 * lo[2]);
    const Vec3 b = field.grid_.node(8 * hi[0] - 1, 8 * hi[1] - 1, 8 * hi[2] - 1);
    const ClosestPoint found = mesh.closest(0.5 * (a + b), guess);
    const double d = found.signed_distance, reach = 0.5 * (b - a).norm();
    if (d - reach > std::max(kClear * cell(), options.outside_m))
      return all_outside(lo, hi, d, 0.5 * (a + b));
    std::size_t widest = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (hi[k] - lo[k] > hi[widest] - lo[widest]) widest = k;
    if (hi[widest] - lo[widest] == 1) return one_block(lo, found, -d - reach > kClear * cell());
    Corner end = hi, begin = lo;
    end[widest] = begin[widest] = (lo[widest] + hi[widest]) / 2;
    classify(lo, end, found.triangle);
    classify(begin, hi, found.triangle);
  }

  void one_block(const Corner& at, const ClosestPoint& found, bool deep) {
    const std::uint32_t block = field.grid_.index(at);
    field.middle_[block] = static_cast<float>(found.signed_distance);
    field.slot_[block] = deep ? kIn : static_cast<std::uint32_t>(near.size());
    if (deep) return;
    near.push_back(block);
    triangle.push_back(found.triangle);
  }

  void all_outside(const Corner& lo, const Corner& hi, double d, const Vec3& middle) {
    for (int k = lo[2]; k < hi[2]; ++k)
      for (int j = lo[1]; j < hi[1]; ++j)
        for (int i = lo[0]; i < hi[0]; ++i)
          field.middle_[field.grid_.index({i, j, k})] =
              static_cast<float>(d - (field.grid_.middle({i, j, k}) - middle).norm());
  }

  static std::int16_t whole_um(double m) {
    return static_cast<std::int16_t>(std::round(std::clamp(1e6 * m, -32767.0, 32767.0)));
  }

  // Heights of a cube of 4 nodes a side: exact near the surface; farther off along the gradient.
  void fill_part(const Corner& first, std::uint32_t guess, std::int16_t* out) const {
    const Vec3 middle =
        field.grid_.node(first[0], first[1], first[2]) + Vec3::Constant(1.5 * cell());
    const ClosestPoint found = mesh.closest(middle, guess);
    const bool far = std::abs(found.signed_distance) > (1.5 * kDiagonal + 2.5) * cell();
    const Vec3 up = far ? Vec3((middle - found.point) / found.signed_distance) : Vec3::Zero();
    std::uint32_t last = found.triangle;
    for (int n = 0; n < 64; ++n) {
      const int i = n % 4, j = n / 4 % 4, k = n / 16;
      const Vec3 p = field.grid_.node(first[0] + i, first[1] + j, first[2] + k);
      double d = found.signed_distance + up.dot(p - middle);
      if (!far) {
        const ClosestPoint here = mesh.closest(p, last);
        d = here.signed_distance;
        last = here.triangle;
      }
      out[64 * k + 8 * j + i] = whole_um(d);
    }
  }

  // Nearest to any node of the block is a place that both surfaces have, and nothing is nearer to
  // it in either: a node is no farther from the surface than the middle and the way to there.
  bool same_as_like(std::uint32_t block) const {
    if (!mesh.like || !mesh.like->stored(block)) return false;
    const Vec3 middle = field.grid_.middle(field.grid_.place(block));
    const Vec3 out_of = (mesh.differs.lo - middle).cwiseMax(middle - mesh.differs.hi).cwiseMax(0.0);
    return out_of.norm() > std::abs(mesh.like->middle_m(block)) + 3 * field.grid_.reach_m();
  }

  void fill(std::size_t slot) {
    const Corner at = field.grid_.place(near[slot]);
    std::int16_t* out = field.heights_.data() + slot * BlockGrid::kNodes;
    if (same_as_like(near[slot])) {
      std::copy_n(mesh.like->stored(near[slot]), BlockGrid::kNodes, out);
      return;
    }
    for (int part = 0; part < 8; ++part) {
      const int i = 4 * (part & 1), j = 4 * (part >> 1 & 1), k = 4 * (part >> 2);
      fill_part({8 * at[0] + i, 8 * at[1] + j, 8 * at[2] + k}, triangle[slot],
                out + 64 * k + 8 * j + i);
    }
  }

  void fill_all() {
    field.heights_.resize(near.size() * BlockGrid::kNodes);
    constexpr std::size_t kAtOnce = 64;
    const std::size_t tasks = (near.size() + kAtOnce - 1) / kAtOnce;
    const auto task = [this](std::size_t t) {
      for (std::size_t s = t * kAtOnce; s < std::min(near.size(), (t + 1) * kAtOnce); ++s) fill(s);
    };
    if (options.run) return options.run(tasks, task);
    for (std::size_t t = 0; t < tasks; ++t) task(t);
  }

  void finish() {
    Hasher hasher;
    hasher.add(field.grid_.cell_m);
    hasher.add(field.grid_.lo);
    for (const int n : field.grid_.blocks) hasher.add(n);
    hasher.bytes(field.slot_.data(), field.slot_.size() * sizeof(std::uint32_t));
    hasher.bytes(field.middle_.data(), field.middle_.size() * sizeof(float));
    hasher.bytes(field.heights_.data(), field.heights_.size() * sizeof(std::int16_t));
    field.hash_ = hasher.value();
  }
};

Result<std::shared_ptr<UncutField>> UncutField::make(const Source& source,
                                                     const UncutFieldOptions& options,
                                                     const UncutField* same_grid) {
  Maker maker(source, options);
  if (same_grid)
    maker.lay_out_on(same_grid->grid());
  else if (auto made = maker.lay_out(); !made)
    return tl::unexpected(made.error());
  maker.classify({0, 0, 0}, maker.field.grid_.blocks, 0);
  const double bytes = 8.0 * static_cast<double>(maker.field.grid_.count()) +
                       2.0 * BlockGrid::kNodes * static_cast<double>(maker.near.size()) +
                       static_cast<double>(same_grid ? same_grid->bytes() : 0);
  if (bytes > static_cast<double>(options.most_bytes)) return too_large(bytes, options.most_bytes);
  maker.fill_all();
  maker.finish();
  return std::make_shared<UncutField>(std::move(maker.field));
}

Result<std::shared_ptr<const UncutField>> UncutField::make(const TriMesh& mesh,
                                                           const UncutFieldOptions& options) {
  if (auto sound = check_mesh(mesh); !sound) return tl::unexpected(sound.error());
  const Aabb box = bounds(mesh);
  if (auto sound = check_options(box, options); !sound) return tl::unexpected(sound.error());
  const MeshDistance distance(mesh);
  const Source source{
      box, [&](const Vec3& p, std::uint32_t guess) { return distance.closest(p, guess); }};
  return make(source, options, nullptr);
}

Result<std::shared_ptr<const UncutField>> UncutField::make(const CoveredSurface& body,
                                                           const UncutFieldOptions& options) {
  const Aabb box = bounds(body.touched());
  if (auto sound = check_options(box, options); !sound) return tl::unexpected(sound.error());
  const Source both{box,
                    [&](const Vec3& p, std::uint32_t guess) { return body.closest(p, guess); }};
  auto made = make(both, options, nullptr);
  if (!made) return tl::unexpected(made.error());
  const MeshDistance distance(body.bone());
  Aabb layers;
  for (std::size_t i = 0; i < body.layers(); ++i)
    for (const Vec3& v : body.layer(i).vertices) layers.include(v);
  const Source alone{bounds(body.bone()),
                     [&](const Vec3& p, std::uint32_t guess) { return distance.closest(p, guess); },
                     made->get(), layers};
  auto bare = make(alone, options, made->get());
  if (!bare) return tl::unexpected(bare.error());
  Hasher hasher;
  hasher.add((*made)->hash_);
  hasher.add((*bare)->hash_);
  (*made)->hash_ = hasher.value();
  (*made)->bare_ = std::move(*bare);
  return std::shared_ptr<const UncutField>(std::move(*made));
}

Result<std::shared_ptr<const UncutField>> UncutField::make_beside(
    const TriMesh& mesh, const UncutFieldOptions& options) const {
  if (auto sound = check_mesh(mesh); !sound) return tl::unexpected(sound.error());
  const Aabb box = bounds(mesh);
  if (!((box.lo - box_.lo).minCoeff() > -kClear * grid_.cell_m &&
        (box_.hi - box.hi).minCoeff() > -kClear * grid_.cell_m))
    return fail("the mesh reaches out of the bone", "carving");
  const MeshDistance distance(mesh);
  const Source source{
      box, [&](const Vec3& p, std::uint32_t guess) { return distance.closest(p, guess); }};
  return make(source, options, this);
}

}  // namespace osteon
