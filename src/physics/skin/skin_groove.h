#pragma once

#include <span>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/mesh/tri_mesh.h"
#include "osteon/tissue/skin_sheet.h"

namespace osteon {

/// The walls and the floor of cuts, for pictures: under each lip the skin goes straight down as far
/// as it is thick, below it the fat goes out to a floor that both sides share. Its vertices are its
/// own, also under the lips, with how deep each lies: above 0.
struct SkinGroove {
  std::vector<Vec3> points;  ///< z up, as sheet_surface has them
  std::vector<double> depth_m;
  std::vector<Triangle> triangles;
};
/// `surface`: of copies, as sheet_surface gives them.
SkinGroove skin_groove(const SplitSheet& split, std::span<const Vec3> surface, double thickness_m);

}  // namespace osteon
