#include "cases/tissue_mesh.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include "cases/mesh_source.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/mesh_io.h"
#include "osteon/mesh/repair.h"

namespace osteon {
namespace {

constexpr double kTissueFileMm = 0.001;
constexpr double kWidestTissue = 3;

Result<TriMesh> from_tissue_file(const std::string& file, const std::string& unit) {
  const auto given = unit_from_text(unit);
  // As millimetres first: they pass the limit on coordinates whatever the unit is.
  auto mesh = load_mesh(file, given.value_or(kTissueFileMm));
  if (!mesh) return mesh;
  const double width = bounds(*mesh).extent().maxCoeff() / kTissueFileMm;
  if (!given && !(width > kWidestTissue))
    for (Vec3& v : mesh->vertices) v /= kTissueFileMm;
  weld_vertices(*mesh, 1e-7);
  return mesh;
}

Result<void> check_closed(const TriMesh& mesh, const std::string& where) {
  const Topology t = topology(mesh);
  if (t.closed() && volume(mesh) > 0) return {};
  if (t.closed())
    return fail("the tissue's surface faces inwards or encloses nothing", where,
                "Turn its triangles outwards, e.g. with: osteon import mesh");
  return fail("the tissue's surface is not closed: " + std::to_string(t.boundary_edges) +
                  " open edges, " + std::to_string(t.non_manifold_edges) +
                  " shared by three triangles or more, " + std::to_string(t.misoriented_edges) +
                  " shared by triangles of opposite orientation",
              where, "Close it first, e.g. with: osteon import mesh");
}

}  // namespace

Result<TriMesh> load_tissue_mesh(const std::string& spec, const std::string& unit) {
  std::error_code ec;
  const bool is_part = spec.rfind('#') != std::string::npos && !std::filesystem::exists(spec, ec);
  Result<TriMesh> mesh = TriMesh{};
  if (is_part) {
    auto source = load_mesh_source(spec, unit);
    if (!source) return tl::unexpected(source.error());
    mesh = std::move(source->mesh);
  } else {
    mesh = from_tissue_file(spec, unit);
  }
  if (!mesh) return mesh;
  if (const auto ok = check_closed(*mesh, spec); !ok) return tl::unexpected(ok.error());
  return mesh;
}

}  // namespace osteon
