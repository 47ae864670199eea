#include "osteon/mesh/tet_io.h"

#include <cmath>

#include "io/vtk.h"
#include "osteon/base/file.h"
#include "osteon/mesh/mesh_io.h"

namespace osteon {
namespace {

Result<void> check_scale(double metres_per_unit, const std::string& where) {
  if (std::isfinite(metres_per_unit) && metres_per_unit > 0) return {};
  return fail("the unit must be a positive number of metres", where, "Use m, cm or mm");
}

}  // namespace

Result<TetMesh> load_vtk_from_memory(std::string_view bytes, double metres_per_unit,
                                     const std::string& where) {
  if (auto fine = check_scale(metres_per_unit, where); !fine) return tl::unexpected(fine.error());
  if (bytes.empty()) return fail("is empty", where, "Copy or export the file again");
  auto mesh = parse_vtk(bytes, where);
  if (!mesh) return mesh;
  for (std::size_t i = 0; i < mesh->vertices.size(); ++i) {
    Vec3& v = mesh->vertices[i];
    v *= metres_per_unit;
    if (!is_finite(v))
      return fail("point " + std::to_string(i) + " is not finite", where, "Export the file again");
    if (v.cwiseAbs().maxCoeff() > kLargestCoordinate_m)
      return fail("point " + std::to_string(i) + " lies more than 100 m from the origin", where,
                  "Check the unit: m, cm or mm");
  }
  return mesh;
}

Result<TetMesh> load_vtk(const std::filesystem::path& path, double metres_per_unit) {
  auto bytes = read_file(path, kMeshFileLimitBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  return load_vtk_from_memory(*bytes, metres_per_unit, path.string());
}

Result<void> save_vtk(const TetMesh& mesh, const std::filesystem::path& path,
                      double metres_per_unit) {
  if (auto fine = check_scale(metres_per_unit, path.string()); !fine) return fine;
  return write_file_atomic(path, format_vtk(mesh, metres_per_unit));
}

}  // namespace osteon
