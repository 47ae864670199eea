#pragma once

#include <vector>

#include "osteon/mesh/tri_mesh.h"
#include "osteon/scene/soft_band.h"

namespace osteon {

/// How wide a band gapes once it is in two, metres: its ends draw back until no fibre is taut, as
/// far as the bones at rest stretch it, and by 1.5 mm at least (an assumption of ours).
double stump_gap_m(const SoftBand& band, const BandSpan& rest_W);

/// Where the points of a band's surface are once it is in two at `share` of the way from its first
/// end to its last: two stumps with flat ends, `gap_m` apart (at most a tenth of the way), each
/// closed where the band was. Between them triangles of no area are left. Points that lie before
/// the first end or behind the last stay. A strand of the surface whose triangles are longer than
/// half a stump stays whole.
std::vector<Vec3> stump_points(const TriMesh& rest_W, const BandSpan& span_W, double share,
                               double gap_m);

}  // namespace osteon
