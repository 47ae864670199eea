#include "osteon/mesh/tetrahedra.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "osteon/mesh/distance.h"
#include "osteon/mesh/self_crossing.h"
#include "osteon/mesh/stuffing.h"
#include "osteon/mesh/thickness.h"

namespace osteon {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kThicknessSamples = 2000;
constexpr double kThinShare = 0.05;
/// A layer is whole when a cell is at most this share of its thickness.
constexpr double kCellOfThickness = 0.7;
constexpr double kFiner = 0.75;
constexpr int kMostTries = 6;
constexpr double kSagOfCell = 0.02;
const char* const kWhere = "tetrahedra";

std::string millimetres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g mm", metres * 1000);
  return text;
}

std::string counted(std::size_t count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

Result<void> check_numbers(const TriMesh& surface) {
  if (surface.triangles.empty())
    return fail("the surface has no triangles", kWhere, "Give a closed surface");
  for (std::size_t v = 0; v < surface.vertices.size(); ++v)
    if (!is_finite(surface.vertices[v]))
      return fail("vertex " + std::to_string(v) + " of the surface is not a finite number", kWhere,
                  "Export the surface again");
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (const std::uint32_t v : surface.triangles[t])
      if (v >= surface.vertices.size())
        return fail("triangle " + std::to_string(t) + " refers to a vertex that does not exist",
                    kWhere, "Export the surface again");
  return {};
}

Result<void> check_surface(const TriMesh& surface) {
  if (auto fine = check_numbers(surface); !fine) return fine;
  const Topology found = topology(surface);
  if (!found.closed())
    return fail("the surface is not closed: " + counted(found.boundary_edges, "open edge") + ", " +
                    counted(found.non_manifold_edges, "edge") + " of more than two triangles, " +
                    std::to_string(found.misoriented_edges) +
                    " between triangles of opposite orientation",
                kWhere, "Repair it first (with osteon import mesh)");
  if (!(volume(surface) > 0))
    return fail("the surface faces inwards or encloses no volume", kWhere,
                "Flip its triangles (osteon import mesh does so)");
  const auto crossings = self_crossings(surface);
  if (crossings.empty()) return {};
  const auto [a, b] = crossings.front();
  const Vec3 at_mm = 1000 * surface.vertices[surface.triangles[a][0]];
  char place[96];
  std::snprintf(place, sizeof place, "(%.2f, %.2f, %.2f) mm", at_mm.x(), at_mm.y(), at_mm.z());
  const std::string more = crossings.size() < kListedCrossings ? "" : "at least ";
  return fail("the surface intersects itself: " + more + counted(crossings.size(), "pair") +
                  " of triangles, the first " + std::to_string(a) + " and " + std::to_string(b) +
                  " near " + place,
              kWhere, "Edit or rebuild the surface there, so that it bounds one solid");
}

class Maker {
 public:
  Maker(const TriMesh& surface, const TetrahedraOptions& options)
      : surface_(surface), options_(options) {
    volume_m3_ = volume(surface);
    size_m_ = std::cbrt(volume_m3_);
    thickness_m_ = thickness_quantile(thickness_samples(surface_, kThicknessSamples, 0.5 * size_m_),
                                      kThinShare);
  }

  Result<Tetrahedra> with_cell(double cell_m) {
    StuffingOptions stuffing;
    stuffing.cell_m = cell_m;
    stuffing.most_tets = options_.most_tets;
    auto mesh = stuff_isosurface([this](const Vec3& p) { return distance(p); },
                                 bounds(surface_.mesh()), stuffing);
    if (!mesh) return tl::unexpected(mesh.error());
    Tetrahedra out;
    project_boundary(*mesh);
    out.report.before = quality(*mesh);
    out.report.volume_before_m3 = volume(*mesh);
    TetImproveOptions improvement;
    improvement.goal_deg = options_.goal_deg;
    improvement.slack_m = kSagOfCell * cell_m;
    out.report.improvement = improve(*mesh, projection(), improvement);
    out.mesh = std::move(*mesh);
    out.report.cell_m = cell_m;
    measure(out);
    warn(out.report);
    return out;
  }

  Result<Tetrahedra> with_fitting_cell();

 private:
  double distance(const Vec3& p) { return surface_.closest(p, last_).signed_distance; }
  SurfaceProjection projection() const {
    return [this](const Vec3& p, std::uint32_t& hint) {
      const ClosestPoint found = surface_.closest(p, hint);
      hint = found.triangle;
      return found.point;
    };
  }
  void project_boundary(TetMesh& mesh) const;
  void measure(Tetrahedra& out) const;
  void warn(TetrahedraReport& report) const;

  MeshDistance surface_;
  TetrahedraOptions options_;
  double volume_m3_ = 0;
  double size_m_ = 0;  ///< edge of the cube of the same volume
  double thickness_m_ = 0;
  std::uint32_t last_ = 0;
};

/// From where the lattice's edges met the surface to the nearest point on it: by 1e-4 of a cell.
void Maker::project_boundary(TetMesh& mesh) const {
  for (const std::uint32_t v : boundary(mesh).vertex_of)
    mesh.vertices[v] = surface_.closest(mesh.vertices[v]).point;
}

void Maker::measure(Tetrahedra& out) const {
  TetrahedraReport& report = out.report;
  report.thickness_m = thickness_m_;
  report.after = quality(out.mesh);
  report.surface_volume_m3 = volume_m3_;
  report.volume_m3 = volume(out.mesh);
  const TriMesh shell = boundary(out.mesh).surface;
  report.boundary = topology(shell);
  for (const Vec3& v : shell.vertices)
    report.vertex_distance_m =
        std::max(report.vertex_distance_m, std::abs(surface_.closest(v).signed_distance));
  for (const Triangle& t : shell.triangles) {
    const Vec3 middle = (shell.vertices[t[0]] + shell.vertices[t[1]] + shell.vertices[t[2]]) / 3;
    report.face_distance_m =
        std::max(report.face_distance_m, std::abs(surface_.closest(middle).signed_distance));
  }
  const MeshDistance to_shell(shell);
  for (const Vec3& v : surface_.mesh().vertices)
    report.surface_distance_m =
        std::max(report.surface_distance_m, std::abs(to_shell.closest(v).signed_distance));
}

void Maker::warn(TetrahedraReport& report) const {
  char text[200];
  if (report.cell_m > kCellOfThickness / kFiner * thickness_m_)
    report.warnings.push_back("the cell of " + millimetres(report.cell_m) +
                              " is too coarse for the thinnest part (" + millimetres(thickness_m_) +
                              "): choose " + millimetres(kCellOfThickness * thickness_m_) +
                              " or less");
  if (std::abs(report.volume_error()) > 0.01) {
    std::snprintf(text, sizeof text,
                  "the volume differs from the surface's by %.1f %%: choose a smaller cell",
                  100 * report.volume_error());
    report.warnings.emplace_back(text);
  }
  if (report.after.min_dihedral_rad < 15 * kPi / 180) {
    std::snprintf(
        text, sizeof text,
        "the smallest dihedral angle is %.1f degrees: another cell size may give a better one",
        report.after.min_dihedral_rad * 180 / kPi);
    report.warnings.emplace_back(text);
  }
  const std::size_t parts = topology(surface_.mesh()).components;
  if (report.boundary.components != parts)
    report.warnings.push_back("the surface has " + counted(parts, "part") + ", the mesh's has " +
                              std::to_string(report.boundary.components) +
                              ": choose a smaller cell");
  if (report.boundary.non_manifold_edges > 0)
    report.warnings.push_back(counted(report.boundary.non_manifold_edges, "edge") +
                              " of the mesh's surface have more than two faces: choose a smaller "
                              "cell");
}

/// From the thickness; smaller until volume and angles fit, or the next would be too many.
Result<Tetrahedra> Maker::with_fitting_cell() {
  // Of a solid part the thickness is no guide: there its size is.
  double cell = std::min(kCellOfThickness * thickness_m_, size_m_ / 6);
  Result<Tetrahedra> best = with_cell(cell);
  for (int tried = 1; tried < kMostTries; ++tried) {
    // Where a part thins out to nothing, no cell is fine enough to keep its rim in one piece.
    if (best && best->report.after.min_dihedral_rad >= 15 * kPi / 180 &&
        std::abs(best->report.volume_error()) <= options_.volume_share)
      break;
    cell *= kFiner;
    Result<Tetrahedra> finer = with_cell(cell);
    if (!finer && best) break;
    best = std::move(finer);
  }
  return best;
}

}  // namespace

Result<Tetrahedra> make_tetrahedra(const TriMesh& surface, const TetrahedraOptions& options) {
  if (auto fine = check_surface(surface); !fine) return tl::unexpected(fine.error());
  if (!(options.cell_m >= 0) || !std::isfinite(options.cell_m))
    return fail("the cell must be a positive length", kWhere, "Choose one in millimetres");
  if (!(options.goal_deg > 0) || !(options.goal_deg <= 40))
    return fail("the angle to reach must lie above 0 and at 40 degrees at most", kWhere,
                "Choose 15 to 25");
  Maker maker(surface, options);
  return options.cell_m > 0 ? maker.with_cell(options.cell_m) : maker.with_fitting_cell();
}

}  // namespace osteon
