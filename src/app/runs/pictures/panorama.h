#pragma once

#include <span>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/render/renderer.h"
#include "runs/pictures/scope_lens.h"

namespace osteon {

/// Front: as the outside view. Top: from the fingers or the hip. Left: from the left of the front.
Result<Camera> panorama_camera(const Case& the_case, const std::string& side, double aspect);

/// Bones, menisci and discs seen through, without forces.
ViewState panorama_view(const Case& the_case, const Camera& camera);

/// A yellow cone where each scope looks.
std::vector<SolidMark> sight_marks(const Lenses& lenses, std::span<const ToolState> tools);

}  // namespace osteon
