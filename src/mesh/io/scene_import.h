#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "osteon/base/result.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Triangles of a glTF or GLB file by assimp, in the file's unit, with the transforms
/// of all nodes applied. `extension` in lower case.
Result<TriMesh> import_scene(std::string_view bytes, const std::string& extension,
                             const std::string& where);

/// The same from a path: a glTF may then refer to buffers in files beside it.
Result<TriMesh> import_scene_file(const std::filesystem::path& path, const std::string& extension);

}  // namespace osteon
