// Any bytes as case.toml: an error or a case that keeps its promises.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "osteon/base/check.h"
#include "osteon/scene/case_io.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto parsed =
      osteon::parse_case_toml({reinterpret_cast<const char*>(data), size}, "case.toml");
  if (!parsed) return 0;
  osteon::demand(parsed->def.bones.size() == parsed->mesh_files.size(), "a bone has no mesh");
  osteon::demand(!parsed->def.bones.empty() && parsed->def.bones.size() <= osteon::kMaxBones,
                 "the number of bones is out of range");
  for (const osteon::BoneDef& bone : parsed->def.bones) {
    osteon::demand(osteon::is_finite(bone.X_WB), "a pose is not finite");
    osteon::demand(std::abs(bone.X_WB.q.norm() - 1) < 1e-9, "a rotation is not of unit length");
  }
  for (const std::string& file : parsed->mesh_files) {
    const std::filesystem::path normal = std::filesystem::path(file).lexically_normal();
    osteon::demand(normal.is_relative() && *normal.begin() != "..",
                   "a mesh lies outside the folder");
  }
  return 0;
}
