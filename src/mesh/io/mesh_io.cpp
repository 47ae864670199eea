#include "osteon/mesh/mesh_io.h"

#include <algorithm>
#include <cmath>

#include "io/obj.h"
#include "io/ply.h"
#include "io/scene_import.h"
#include "io/stl.h"
#include "io/vtk_surface.h"
#include "io/vtp.h"
#include "osteon/base/file.h"

namespace osteon {
namespace fs = std::filesystem;
namespace {

std::string extension_of(const fs::path& path) {
  std::string text = path.extension().string();
  if (!text.empty()) text.erase(0, 1);
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

bool is_known(const std::string& extension) {
  return extension == "stl" || extension == "obj" || extension == "ply" || extension == "gltf" ||
         extension == "glb" || extension == "vtk" || extension == "vtp";
}

tl::unexpected<Error> unknown_format(const std::string& where) {
  return fail("is not in a known mesh format", where, "Use STL, OBJ, PLY, VTK, VTP, glTF or GLB");
}

// Refuses what no bone can be; a wrong unit is the usual cause.
Result<void> check_vertex(const Vec3& v, std::size_t index, const std::string& where) {
  if (!is_finite(v))
    return fail("vertex " + std::to_string(index) + " is not a finite number", where,
                "Export the file again");
  if (v.cwiseAbs().maxCoeff() > kLargestCoordinate_m)
    return fail("vertex " + std::to_string(index) + " lies more than " +
                    std::to_string(static_cast<int>(kLargestCoordinate_m)) + " m from the origin",
                where, "Check the unit: m, cm or mm");
  return {};
}

Result<TriMesh> scaled(Result<TriMesh> mesh, double metres_per_unit, const std::string& where) {
  if (!mesh) return mesh;
  if (mesh->triangles.empty())
    return fail("holds no triangles", where, "Export it as a surface of triangles");
  for (std::size_t i = 0; i < mesh->vertices.size(); ++i) {
    mesh->vertices[i] *= metres_per_unit;
    if (auto fine = check_vertex(mesh->vertices[i], i, where); !fine)
      return tl::unexpected(fine.error());
  }
  return mesh;
}

Result<TriMesh> parse(std::string_view bytes, const std::string& extension,
                      const std::string& where) {
  if (extension == "stl") return parse_stl(bytes, where);
  if (extension == "obj") return parse_obj(bytes, where);
  if (extension == "ply") return parse_ply(bytes, where);
  if (extension == "vtk") return parse_vtk_surface(bytes, where);
  if (extension == "vtp") return parse_vtp(bytes, where);
  return import_scene(bytes, extension, where);
}

Result<void> check_unit(double metres_per_unit, const std::string& where) {
  if (std::isfinite(metres_per_unit) && metres_per_unit > 0) return {};
  return fail("the unit must be a positive number of metres", where, "Use m, cm or mm");
}

}  // namespace

bool is_mesh_file(const fs::path& path) { return is_known(extension_of(path)); }

Result<TriMesh> load_mesh_from_memory(std::string_view bytes, const std::string& extension,
                                      double metres_per_unit, const std::string& where) {
  if (auto fine = check_unit(metres_per_unit, where); !fine) return tl::unexpected(fine.error());
  if (!is_known(extension)) return unknown_format(where);
  if (bytes.empty()) return fail("is empty", where, "Copy or export the file again");
  return scaled(parse(bytes, extension, where), metres_per_unit, where);
}

Result<TriMesh> load_mesh(const fs::path& path, double metres_per_unit) {
  const std::string extension = extension_of(path);
  if (!is_known(extension)) return unknown_format(path.string());
  if (auto fine = check_unit(metres_per_unit, path.string()); !fine)
    return tl::unexpected(fine.error());
  auto bytes = read_file(path, kMeshFileLimitBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  if (extension != "gltf")
    return load_mesh_from_memory(*bytes, extension, metres_per_unit, path.string());
  return scaled(import_scene_file(path, extension), metres_per_unit, path.string());
}

Result<void> save_stl(const TriMesh& mesh, const fs::path& path, double metres_per_unit) {
  if (auto fine = check_unit(metres_per_unit, path.string()); !fine) return fine;
  return write_file_atomic(path, format_stl(mesh, metres_per_unit));
}

}  // namespace osteon
