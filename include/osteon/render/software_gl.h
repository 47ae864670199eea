#pragma once

#include <string_view>

namespace osteon {

/// Whether OpenGL's renderer of this name (GL_RENDERER) draws with the processor: Mesa's llvmpipe
/// and softpipe, the older swrast, and OpenSWR.
bool is_software_gl(std::string_view renderer);

}  // namespace osteon
