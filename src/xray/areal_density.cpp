#include "osteon/xray/areal_density.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include "crossings.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

constexpr int kRowsABand = 16;

/// A layer and what it weighs.
struct LayerMaterial {
  std::size_t substance;
  double density_g_per_cm3;
};

/// What one ray meets, by substance: share of the way times density.
using RaySums = std::array<double, kXraySubstances>;

/// Follows one ray through its crossings.
///
/// count: how many surfaces of a layer the ray is inside of; a surface that is folded over itself
/// may count twice or, turned inside out, below zero: inside is where the count is above 0.
/// inside: a bit for each such layer. The lowest bit is the layer that is there.
/// A solid that the near plane cuts is left more often than entered: the ray starts inside it.
class RayWalk {
 public:
  explicit RayWalk(const std::vector<LayerMaterial>& layers) : layers_(layers) {}

  RaySums follow(std::span<Crossing> crossings) {
    sort_by_share(crossings);
    sums_ = {};
    for (const Crossing& c : crossings) change(c.layer, -c.enters);
    double from = 0;
    for (const Crossing& c : crossings) {
      const double to = std::min<double>(c.share, 1);
      pass(to - from);
      change(c.layer, c.enters);
      from = to;
    }
    pass(1 - from);
    for (const Crossing& c : crossings) count_[static_cast<std::size_t>(c.layer)] = 0;
    inside_ = 0;
    return sums_;
  }

 private:
  /// Few, and often nearly in order. Of equal places the order does not matter: nothing is between.
  static void sort_by_share(std::span<Crossing> c) {
    for (std::size_t n = 1; n < c.size(); ++n) {
      const Crossing moved = c[n];
      std::size_t k = n;
      for (; k > 0 && c[k - 1].share > moved.share; --k) c[k] = c[k - 1];
      c[k] = moved;
    }
  }
  void change(std::int16_t layer, int by) {
    const auto l = static_cast<std::size_t>(layer);
    count_[l] += by;
    const std::uint64_t bit = std::uint64_t{1} << l;
    inside_ = count_[l] > 0 ? inside_ | bit : inside_ & ~bit;
  }
  void pass(double share) {
    if (!inside_ || !(share > 0)) return;
    const LayerMaterial& m = layers_[static_cast<std::size_t>(std::countr_zero(inside_))];
    sums_[m.substance] += m.density_g_per_cm3 * share;
  }

  const std::vector<LayerMaterial>& layers_;
  std::array<int, kMaxXrayLayers> count_{};
  std::uint64_t inside_ = 0;
  RaySums sums_{};
};

/// Crossings of a band in the order of their pixels.
struct SortedCrossings {
  std::vector<std::uint32_t> first;  ///< of each pixel, and one past the last
  std::vector<Crossing> crossings;
};

SortedCrossings by_pixel(const std::vector<PixelCrossing>& found, std::size_t pixels) {
  SortedCrossings out;
  out.first.assign(pixels + 2, 0);
  for (const PixelCrossing& c : found) ++out.first[c.pixel + 2];
  for (std::size_t n = 2; n < out.first.size(); ++n) out.first[n] += out.first[n - 1];
  out.crossings.resize(found.size());
  for (const PixelCrossing& c : found) out.crossings[out.first[c.pixel + 1]++] = c.crossing;
  return out;
}

struct LayerTriangles {
  int layer;
  BandedTriangles banded;
};

class BandPainter {
 public:
  BandPainter(const XrayBody& body, const XrayView& view, const std::vector<LayerTriangles>& meshes,
              ArealDensity& out)
      : view_(view), meshes_(meshes), out_(out) {
    for (const XrayLayer& layer : body.layers)
      layers_.push_back(
          {static_cast<std::size_t>(layer.material.substance), layer.material.density_g_per_cm3});
  }

  void paint(std::size_t band) const {
    RowBand rows{static_cast<int>(band) * kRowsABand, 0, view_.width};
    rows.last = std::min(rows.first + kRowsABand, view_.height);
    std::vector<PixelCrossing> found;
    for (const LayerTriangles& mesh : meshes_)
      for (const std::uint32_t n : mesh.banded.of_band[band])
        add_crossings(mesh.banded.triangles[n], mesh.layer, rows, found);
    SortedCrossings sorted = by_pixel(found, static_cast<std::size_t>(rows.last - rows.first) *
                                                 static_cast<std::size_t>(view_.width));
    RayWalk walk(layers_);
    std::size_t pixel = 0;
    for (int row = rows.first; row < rows.last; ++row)
      for (int column = 0; column < view_.width; ++column, ++pixel)
        if (const std::uint32_t a = sorted.first[pixel], b = sorted.first[pixel + 1]; a != b)
          store(column, row, walk.follow({sorted.crossings.data() + a, b - a}));
  }

 private:
  void store(int column, int row, const RaySums& sums) const {
    const double length_cm = 100 * (view_.pixel_W(column, row) - view_.source_W).norm();
    const auto at = static_cast<std::size_t>(row) * static_cast<std::size_t>(view_.width) +
                    static_cast<std::size_t>(column);
    for (std::size_t s = 0; s < kXraySubstances; ++s)
      out_.of[s][at] = static_cast<float>(length_cm * sums[s]);
  }

  const XrayView& view_;
  const std::vector<LayerTriangles>& meshes_;
  ArealDensity& out_;
  std::vector<LayerMaterial> layers_;
};

void run_all(const RunXrayTasks& run, std::size_t count,
             const std::function<void(std::size_t)>& task) {
  if (run) return run(count, task);
  for (std::size_t n = 0; n < count; ++n) task(n);
}

Result<void> check_view(const XrayView& view) {
  const std::string where = "the X-ray view";
  for (const int side : {view.width, view.height})
    if (side < 1 || side > kMaxXraySide)
      return fail("has a side of " + std::to_string(side) + " pixels", where,
                  "Choose 1 to " + std::to_string(kMaxXraySide));
  if (!is_finite(view.source_W) || !is_finite(view.detector_center_W) || !is_finite(view.u_W) ||
      !is_finite(view.v_W) || !(view.pixel_m > 1e-6 && view.pixel_m < 1))
    return fail("has a number that is not finite or a pixel out of range", where);
  if (!(std::abs(view.u_W.norm() - 1) < 1e-9 && std::abs(view.v_W.norm() - 1) < 1e-9 &&
        std::abs(view.u_W.dot(view.v_W)) < 1e-9))
    return fail("has axes that are not unit vectors at right angles", where);
  if (!(view.source_detector_m() > 0.02)) return fail("has its source in the detector", where);
  return {};
}

Result<void> check_body(const XrayBody& body) {
  if (body.layers.size() > kMaxXrayLayers)
    return fail("has more than " + std::to_string(kMaxXrayLayers) + " layers", "the X-rayed body");
  for (const XrayLayer& layer : body.layers) {
    if (!(layer.material.density_g_per_cm3 >= 0 && layer.material.density_g_per_cm3 < 100))
      return fail("has a density out of range", "layer '" + layer.name + "'");
    for (const XraySurface& surface : layer.surfaces)
      if (!is_finite(surface.X_WM))
        return fail("has a position that is not finite", "layer '" + layer.name + "'");
  }
  return {};
}

bool fits(const TriMesh& mesh) {
  for (const Vec3& v : mesh.vertices)
    if (!is_finite(v) || !(v.cwiseAbs().maxCoeff() <= 1000)) return false;
  for (const Triangle& t : mesh.triangles)
    if (std::max({t[0], t[1], t[2]}) >= mesh.vertices.size()) return false;
  return true;
}

}  // namespace

Result<std::shared_ptr<const TriMesh>> xray_surface(TriMesh mesh, const std::string& name) {
  if (mesh.triangles.empty()) return fail("has no triangles", name, "Leave it out");
  if (!fits(mesh))
    return fail("has a vertex that is not finite or a triangle without its vertices", name,
                "Repair the mesh");
  if (!topology(mesh).closed())
    return fail("is not closed, so a ray's length in it is undefined", name,
                "Close its surface, as 'osteon import mesh' does");
  if (volume(mesh) < 0)
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return std::make_shared<const TriMesh>(std::move(mesh));
}

std::vector<float> ArealDensity::total() const {
  std::vector<float> sum(of[0]);
  for (std::size_t s = 1; s < kXraySubstances; ++s)
    for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += of[s][n];
  return sum;
}

Result<ArealDensity> areal_density(const XrayBody& body, const XrayView& view,
                                   const RunXrayTasks& run) {
  if (auto ok = check_view(view); !ok) return tl::unexpected(ok.error());
  if (auto ok = check_body(body); !ok) return tl::unexpected(ok.error());
  struct Job {
    int layer;
    const XraySurface* surface;
  };
  std::vector<Job> jobs;
  for (std::size_t l = 0; l < body.layers.size(); ++l)
    for (const XraySurface& surface : body.layers[l].surfaces)
      jobs.push_back({static_cast<int>(l), &surface});
  std::vector<LayerTriangles> meshes(jobs.size());
  run_all(run, jobs.size(), [&](std::size_t n) {
    const XraySurface& s = *jobs[n].surface;
    meshes[n] = {jobs[n].layer, banded_triangles(*s.mesh_M, s.X_WM, view, kRowsABand)};
  });
  ArealDensity out{view.width, view.height, {}};
  const std::size_t pixels =
      static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height);
  for (std::vector<float>& values : out.of) values.assign(pixels, 0);
  const BandPainter painter(body, view, meshes, out);
  run_all(run, static_cast<std::size_t>((view.height + kRowsABand - 1) / kRowsABand),
          [&](std::size_t band) { painter.paint(band); });
  return out;
}

}  // namespace osteon
