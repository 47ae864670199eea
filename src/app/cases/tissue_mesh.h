#pragma once

#include <string>

#include "osteon/base/result.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// A closed surface in World by what a user names it: a mesh file, or CASE#PART for one bone or
/// soft part of a case. `unit` of a file: "m", "cm", "mm", or empty: mm when it is more than three
/// units across, else m (a tissue of more than three metres is none). Vertices are welded; nothing
/// else is mended: an open surface has no inside and is refused.
Result<TriMesh> load_tissue_mesh(const std::string& spec, const std::string& unit);

}  // namespace osteon
