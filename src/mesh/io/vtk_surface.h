#pragma once

#include <string>
#include <string_view>

#include "osteon/base/result.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// The polygons and triangle strips of a legacy VTK file with a POLYDATA set, ASCII or binary, of
/// versions 1 to 5, in the file's unit. Other sections are passed over.
Result<TriMesh> parse_vtk_surface(std::string_view bytes, const std::string& where);

}  // namespace osteon
