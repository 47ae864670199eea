#pragma once

#include "osteon/render/renderer.h"

namespace osteon {

/// The camera's gain for what the bound square picture of floats shows, `side` pixels wide; its rim
/// does not count. Few rows are read: all of it takes a processor's time. Needs the context.
double gain_for(int side);

/// The bound picture, the upper row first. Needs the context.
Image read_back(int width, int height);

}  // namespace osteon
