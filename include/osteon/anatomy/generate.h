#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// A bone grown from its parametric description.
struct GeneratedBone {
  std::string name;
  int fma_id = 0;
  Pose X_WB;     ///< bone in World
  TriMesh mesh;  ///< in Bone, metres; closed, manifold, outward
  double density_kg_per_m3 = 1900;
};

struct GeneratedLandmark {
  std::string name;
  Vec3 p_W = Vec3::Zero();
};

struct GeneratedAnatomy {
  std::string name;
  std::string side;
  std::vector<GeneratedBone> bones;
  std::vector<GeneratedLandmark> landmarks;
};

struct GenerateOptions {
  /// Of the grid on which surfaces are found; none: what the description says for each bone.
  std::optional<double> cell_m = {};
  /// Told the share done, 0 to 1, before each bone and at the end; may throw to stop.
  std::function<void(double)> progress = {};
};

/// Grows every bone of a description (assets/anatomy/*.toml; docs/file-formats.md). The same
/// description and options give the same bytes on every compiler. Errors name the file, the bone
/// and the key.
Result<GeneratedAnatomy> generate_anatomy(const std::filesystem::path& description,
                                          const GenerateOptions& options = {});

}  // namespace osteon
