#pragma once

#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/mesh/tri_mesh.h"
#include "osteon/render/renderer.h"
#include "osteon/scene/instrument.h"

namespace osteon {

/// What a sheet shows: a surface in Tool, origin at the tip, shaft along +z.
struct SheetItem {
  std::string name;
  TriMesh mesh;
};

/// Instruments in their usual size, jaws open.
std::vector<SheetItem> sheet_items(const std::vector<Instrument>& instruments);

/// A picture of instruments side by side: each whole, fitted to the height of its cell, and to the
/// right of it its tip, as large as fits. All columns and rows fit into the picture, whatever its
/// shape. Draws off-screen.
Result<Image> instrument_sheet(const std::vector<SheetItem>& items, int columns, int width,
                               int height);

}  // namespace osteon
