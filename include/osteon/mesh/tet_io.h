#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "osteon/base/result.h"
#include "osteon/mesh/tet_mesh.h"

namespace osteon {

/// Reads the tetrahedra of a legacy VTK file (ASCII, unstructured grid, file versions 1 to 5), each
/// coordinate times `metres_per_unit`. Points, lines and faces among the cells are passed over, and
/// so are the data that hang on points and cells. Fails, with the line, on a binary file, another
/// data set, another solid cell, a cell that names a vertex twice or one that does not exist, a
/// coordinate that is not finite or lies beyond kLargestCoordinate_m (mesh_io.h), a file that
/// breaks off, and one without tetrahedra. Inverted elements come as they are: see quality().
Result<TetMesh> load_vtk(const std::filesystem::path& path, double metres_per_unit);
/// The same from memory; `where` names the source in errors.
Result<TetMesh> load_vtk_from_memory(std::string_view bytes, double metres_per_unit,
                                     const std::string& where);

/// Writes a legacy VTK file (ASCII, version 3.0), each coordinate divided by `metres_per_unit`, in
/// as many digits as bring the same number back. The same mesh gives the same bytes. In one step,
/// see write_file_atomic.
Result<void> save_vtk(const TetMesh& mesh, const std::filesystem::path& path,
                      double metres_per_unit);

}  // namespace osteon
