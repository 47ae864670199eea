// A legacy VTK file: reading and measuring must end without a crash.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "osteon/base/check.h"
#include "osteon/mesh/tet_io.h"
#include "osteon/mesh/tet_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto mesh = osteon::load_vtk_from_memory(bytes, 0.001, "fuzz");
  if (!mesh) return 0;
  osteon::demand(!mesh->tets.empty(), "no tetrahedron was read");
  const osteon::TetQuality quality = osteon::quality(*mesh);
  osteon::demand(quality.inverted <= mesh->tets.size(), "the report is wrong");
  const osteon::TetBoundary shell = osteon::boundary(*mesh);
  osteon::demand(shell.vertex_of.size() <= mesh->vertices.size(), "the boundary is wrong");
  return 0;
}
