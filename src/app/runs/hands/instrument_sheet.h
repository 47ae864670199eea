#pragma once

#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/render/renderer.h"
#include "osteon/scene/instrument.h"

namespace osteon {

/// A picture of instruments side by side, jaws open: each whole, fitted to the height of its cell,
/// and to the right of it its tip, four times life size of the largest that fits. Draws off-screen.
Result<Image> instrument_sheet(const std::vector<Instrument>& instruments, int columns, int width,
                               int height);

}  // namespace osteon
