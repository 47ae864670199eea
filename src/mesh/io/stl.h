#pragma once

#include <string>
#include <string_view>

#include "osteon/base/result.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Coordinates of an STL file, binary or ASCII, in the file's unit. Three vertices a triangle, in
/// the file's order; the stored normals are not read.
Result<TriMesh> parse_stl(std::string_view bytes, const std::string& where);

/// Bytes of a binary STL file.
std::string format_stl(const TriMesh& mesh, double metres_per_unit);

}  // namespace osteon
