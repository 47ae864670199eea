#pragma once

#include <string>
#include <string_view>

#include "osteon/base/result.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// The polygons and triangle strips of a VTK XML file of PolyData (.vtp): arrays as ASCII, in
/// base64 or appended (raw or base64), as they are or packed by zlib; in the file's unit. All
/// pieces make one mesh.
Result<TriMesh> parse_vtp(std::string_view bytes, const std::string& where);

}  // namespace osteon
