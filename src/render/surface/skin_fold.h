#pragma once

#include <vector>

#include "osteon/render/prepare.h"
#include "osteon/scene/case.h"
#include "surface/surface.h"

namespace osteon {

/// Skin that was made over a bent knee spans the hollow of the knee in a round web. Drawn into it
/// is the fold that skin has there, between thigh and shank that swell beside it; none where the
/// knee is hardly bent, or there is none.
std::vector<ShadedMesh::Root> find_fold(const Case& the_case, const Surface& skin);
/// How open the skin is to the sky: the less the deeper it lies in the fold.
std::vector<float> fold_openness(const std::vector<ShadedMesh::Root>& fold, const Surface& skin);

}  // namespace osteon
