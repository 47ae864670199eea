#pragma once

#include "osteon/carve/bone_heat.h"
#include "osteon/render/renderer.h"

namespace osteon {

static_assert(HeatVolume::kFrom_c == HeatCells::kFrom_c && HeatVolume::kTo_c == HeatCells::kTo_c);

/// What was worked out, as a renderer takes it.
inline HeatCells heat_cells(const HeatVolume& volume) {
  return {volume.lo_B, volume.cell_m, volume.count, volume.cells};
}

}  // namespace osteon
