#pragma once

#include <string>
#include <string_view>

#include "osteon/base/result.h"
#include "osteon/mesh/tet_mesh.h"

namespace osteon {

/// The tetrahedra of a legacy VTK file, in the file's unit; see tet_io.h.
Result<TetMesh> parse_vtk(std::string_view bytes, const std::string& where);
std::string format_vtk(const TetMesh& mesh, double metres_per_unit);

}  // namespace osteon
