#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "osteon/base/result.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Larger files are refused.
inline constexpr std::uint64_t kMeshFileLimitBytes = 512ull << 20;
/// A coordinate further from the origin than this hints at a wrong unit and is refused, m.
inline constexpr double kLargestCoordinate_m = 100.0;

/// True for the extensions that load_mesh reads (.stl, .obj, .ply, .gltf, .glb; any case).
bool is_mesh_file(const std::filesystem::path& path);

/// Reads STL, OBJ, PLY, VTK (.vtk, .vtp) or glTF as it stands (all its parts joined in one frame,
/// triangles only), each coordinate times `metres_per_unit`. Fails on a file that cannot be read,
/// is truncated, holds no triangle, holds a coordinate that is not finite or lies beyond
/// kLargestCoordinate_m. STL comes as it is stored, three vertices a triangle: see repair.h for
/// welding and mending.
Result<TriMesh> load_mesh(const std::filesystem::path& path, double metres_per_unit);

/// The same from memory. `extension`: "stl", "obj", "ply", "gltf" or "glb"; `where` names the
/// source in errors. A glTF that refers to other files cannot be read this way.
Result<TriMesh> load_mesh_from_memory(std::string_view bytes, const std::string& extension,
                                      double metres_per_unit, const std::string& where);

/// Writes binary STL, each coordinate divided by `metres_per_unit` and rounded to single
/// precision. The same mesh gives the same bytes. In one step, see write_file_atomic.
Result<void> save_stl(const TriMesh& mesh, const std::filesystem::path& path,
                      double metres_per_unit);

}  // namespace osteon
