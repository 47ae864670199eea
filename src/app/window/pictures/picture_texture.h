#pragma once

#include "osteon/render/renderer.h"

namespace osteon {

/// OpenGL's texture of a picture, for ImGui. Needs a current context; the caller deletes it.
unsigned make_texture(const Image& image);

}  // namespace osteon
