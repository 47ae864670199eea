#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// What a locator fixes: a drill of `diameter_m` runs from `from` towards `to`, both in the bone's
/// frame. Its ends are flat.
struct TunnelLine {
  Vec3 from = Vec3::Zero();
  Vec3 to = Vec3::Zero();
  double diameter_m = 0;
};

/// A stretch of the line's axis inside bone: distances from `from`, m.
struct TunnelPass {
  double entry_m = 0;
  double exit_m = 0;
};

namespace tunnel {
struct Site;
}

/// All that is known of a tunnel once its line is fixed (vKASS, section 4.3, algorithm 1). The
/// triangles that the drill can reach are set apart, so that an advance looks at no others.
struct TunnelPlan {
  TunnelLine line;
  double length_m = 0;             ///< from `from` to `to`
  std::vector<TunnelPass> passes;  ///< of the axis from `from` on, beyond `to` as well, in order
  /// Closed rims of the tunnel drilled as far as `to`, where its wall meets the bone's surface.
  std::vector<std::vector<Vec3>> rims;
  std::shared_ptr<const TriMesh> bone;
  /// Triangles of the bone, ascending, that an advance replaces.
  std::vector<std::uint32_t> touched;
  std::shared_ptr<const tunnel::Site> site;
};

/// The bone's surface about a tunnel, as far as it is drilled: it replaces the plan's `touched`
/// triangles. Indices below the bone's count of vertices name the bone's own.
struct TunnelCut {
  std::vector<Vec3> vertices;  ///< new ones, counted on from the bone's
  std::vector<Triangle> triangles;
  std::vector<std::vector<Vec3>> rims;  ///< closed: where the wall meets the bone's surface
  double removed_m3 = 0;
  double bottom_m2 = 0;       ///< of both flat ends, where they stand in bone
  int sides = 0;              ///< of the wall
  double radius_shift_m = 0;  ///< what was added to the radius, see advance
};

/// Fixes the line. Fails on a bone that is not closed, on numbers that are not finite, a line
/// without length, a diameter that is not positive, and where the bone's surface passes through
/// itself in the drill's way.
Result<TunnelPlan> plan_tunnel(TriMesh bone, const TunnelLine& line);

/// Bone less the drill, whose flat end stands `depth_m` from `from` along the line; it may stand
/// beyond `to` by what the plan can reach, which is as far as the bone goes.
///
/// The wall is a prism of the cylinder's cross-section in area, with so many sides that no point of
/// it is further than 0.25 um from the cylinder. Where the surface touches the prism without
/// crossing it, or nearly, the prism is turned about its axis, then its radius changed by up to 1
/// um and its ends moved outwards by up to 2 um, until all is at least 0.1 um apart: after that,
/// every decision in double precision is the right one. The result has no crossings where the bone
/// has none.
Result<TunnelCut> advance(const TunnelPlan& plan, double depth_m);

/// The whole bone with the tunnel. Vertices that nothing uses are dropped. Empty where the drill
/// took all of it.
TriMesh drilled_bone(const TunnelPlan& plan, const TunnelCut& cut);

/// Length of the axis in bone as far as the drill went, m.
double drilled_length(const TunnelPlan& plan, double depth_m);

}  // namespace osteon
