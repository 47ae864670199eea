#pragma once

#include <string_view>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/mesh/tri_mesh.h"
#include "osteon/scene/case.h"
#include "osteon/scene/placing.h"
#include "surface/tissue_part.h"

namespace osteon {

/// How a soft part of a kind looks, as cases name kinds.
TissuePattern pattern_of(std::string_view kind);
/// Fibres run from one bone to the other, where a part tells its footprints on just two, else along
/// its longest axis; they are the finer the thinner it is. A meniscus lies across its shortest.
void find_fibres(const SoftPart& soft, TissuePart& tissue);
/// Closed, its triangles outwards.
bool faces_out(const TriMesh& mesh);
/// Share of half the flat picture's width to which the round picture and what softening spreads
/// into it reach.
double seen_radius(int side_px);
/// What a square flat picture of so many pixels shows and the round one does not, in clip space on
/// the near plane: its corners, but for so much as softening spreads. Empty where that is all.
TriMesh unseen_corners(int side_px);
TissuePart steel();
/// A piece of a soft part that was cut off, in the frame of its bone, which stood at `X_WB` at
/// rest: it looks as the part does.
TissuePart loose_part_of(const TissuePart& soft, const Pose& X_WB);
/// An instrument of another hand's recorded way.
TissuePart ghost_part();
/// Thread, graft or button, in World.
TissuePart placed_part(const PlacingRod& rod);
bool same_rods(const std::vector<PlacingRod>& a, const std::vector<PlacingRod>& b);

}  // namespace osteon
