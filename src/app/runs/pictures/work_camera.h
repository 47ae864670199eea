#pragma once

#include <span>

#include "osteon/render/camera.h"
#include "osteon/scene/graft_bench.h"

namespace osteon {

/// A look at a practice box from the side, from half above: what is worked on and the portals
/// through which it is done fit into a picture of this aspect, shafts come in from its left and
/// hide nothing. World's z is up. `from` gives the field of view; it is returned as it is where
/// there is no portal or no place.
Camera side_camera(const Camera& from, std::span<const Vec3> portals_W,
                   std::span<const Vec3> places_W, double aspect);

/// A look from above at the table of a bench and at the bands before it, as who works there sees
/// it. `near_fascia`: nearer, at where tendons are found.
Camera bench_camera(const Camera& from, const GraftBenchPlan& bench, double aspect,
                    bool near_fascia = false);
/// A look at skin that is to be cut, from near and a little aslant. `X_WS`: z out of it, y upwards
/// in the picture.
Camera skin_camera(const Camera& from, const Pose& X_WS);
/// Whether a tip is so near to what lies on a bench that a hand works there.
bool is_at_bench(const GraftBenchPlan& bench, const Vec3& tip_W);
/// Where a hand begins that comes to the bench; `near_fascia`: to where tendons are found.
Pose beside_bench(const GraftBenchPlan& bench, bool near_fascia = false);

}  // namespace osteon
