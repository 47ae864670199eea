#pragma once

#include <string>
#include <string_view>

#include "osteon/base/result.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Vertices and faces of a Wavefront OBJ file, in the file's unit. All objects and groups are
/// joined; texture, normals and materials are passed over.
Result<TriMesh> parse_obj(std::string_view bytes, const std::string& where);

}  // namespace osteon
