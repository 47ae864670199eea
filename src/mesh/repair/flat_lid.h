#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Triangulation of a closed polygon whose corners lie about in one plane, such as the rim of a cut
/// shaft: ears are clipped in the plane's projection, O(n^2). Corners are numbered by `loop`; the
/// triangles run the way of the loop. A pair of corners for which `may_join` is false gets no
/// diagonal. Empty when the rim strays from its plane by more than a tenth of its width, or when it
/// crosses itself there.
std::vector<Triangle> flat_lid(const std::vector<Vec3>& vertices,
                               const std::vector<std::uint32_t>& loop,
                               const std::function<bool(std::uint32_t, std::uint32_t)>& may_join);

}  // namespace osteon
