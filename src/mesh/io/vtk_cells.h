#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Cells as VTK's files hold them: the corners of cell i lie from offset[i] to offset[i + 1].
struct VtkFaces {
  std::vector<std::int64_t> offset{0};
  std::vector<std::int64_t> corner;
};

/// Adds them as triangles. False when an offset or a corner is out of range.
bool add_vtk_polygons(TriMesh& mesh, const VtkFaces& faces);
bool add_vtk_strips(TriMesh& mesh, const VtkFaces& faces);

/// Bytes of one number of a type such as "float" or "Float32"; 0 when it is not known.
std::size_t vtk_type_size(std::string_view type);
/// Reads one, least byte first, as the type says.
double vtk_number(const char* bytes, std::string_view type);

}  // namespace osteon
