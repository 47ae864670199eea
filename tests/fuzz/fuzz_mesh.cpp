// The first byte chooses the format, the rest is the file: reading, mending and measuring must end
// without a crash.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "osteon/base/check.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/mesh_io.h"
#include "osteon/mesh/repair.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static constexpr const char* kFormats[] = {"stl", "obj", "ply", "gltf", "glb"};
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  auto mesh = osteon::load_mesh_from_memory(bytes, kFormats[data[0] % 5], 0.001, "fuzz");
  if (!mesh) return 0;
  const osteon::RepairReport report = osteon::repair(*mesh);
  const osteon::Topology left = osteon::topology(*mesh);
  osteon::demand(report.non_manifold_edges == left.non_manifold_edges, "the report is wrong");
  osteon::demand(report.open_holes > 0 || left.boundary_edges == 0, "an open hole went unseen");
  return 0;
}
