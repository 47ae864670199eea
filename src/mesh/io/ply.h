#pragma once

#include <string>
#include <string_view>

#include "osteon/base/result.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Vertices and faces of a PLY file (ASCII or binary of either byte order), in the file's unit.
/// Other elements and properties are passed over.
Result<TriMesh> parse_ply(std::string_view bytes, const std::string& where);

}  // namespace osteon
