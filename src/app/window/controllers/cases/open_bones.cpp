#include "window/controllers/cases/open_bones.h"

#include "osteon/hull/decompose.h"
#include "ui/label.h"

namespace osteon {

std::vector<bool> open_bones(const Case& the_case) {
  std::vector<bool> open;
  for (const Bone& bone : the_case.bones) open.push_back(!can_decompose(bone.mesh));
  return open;
}

std::string open_bones_notice(const Case& the_case) {
  const std::vector<bool> open = open_bones(the_case);
  std::string names;
  std::size_t count = 0;
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (!open[i]) continue;
    if (++count <= 3) names += (count == 1 ? "" : ", ") + label_of(the_case.bones[i].name);
  }
  if (count == 0) return {};
  if (count > 3) names += " and " + std::to_string(count - 3) + " more";
  const std::string who =
      count == 1 ? "A bone has an open surface and feels like its hull"
                 : std::to_string(count) + " bones have an open surface and feel like their hulls";
  return who + ", which bridges hollows: " + names +
         ". Close the surface where the scan cut it, and import it again.";
}

}  // namespace osteon
