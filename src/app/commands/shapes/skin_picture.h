#pragma once

#include <filesystem>

#include "osteon/base/result.h"
#include "osteon/tissue/skin_scene.h"

namespace osteon {

/// What is drawn: a piece of skin, and what lies around it.
struct SkinDrawing {
  TriMesh surface;
  std::size_t triangles = 0;  ///< of skin: those after them are the grooves'
  TriMesh around;             ///< more skin; may be empty
  Vec3 out_of_skin = Vec3::UnitZ(), up = Vec3::UnitY();
};

/// Draws it aslant from above, its grooves in a colour of their own, as a PNG.
Result<void> draw_skin(const SkinDrawing& drawing, const std::filesystem::path& file);

}  // namespace osteon
