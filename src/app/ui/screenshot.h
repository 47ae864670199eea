#pragma once

#include "osteon/render/renderer.h"

namespace osteon {

/// What has been drawn into the window's framebuffer. Needs its context.
Image read_framebuffer(int width, int height);

}  // namespace osteon
