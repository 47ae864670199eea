#pragma once

#include <utility>
#include <vector>

#include "knee/knee_parts.h"

namespace osteon {

/// Two directions in a picture of the knee from the side; all as in KneeParts.
struct SideAxes {
  Vec3 origin = Vec3::Zero();
  Vec3 along = Vec3::UnitX(), across = Vec3::UnitZ();

  double u(const Vec3& p) const { return along.dot(p - origin); }
  double v(const Vec3& p) const { return across.dot(p - origin); }
};

/// The grid of the quadrant method: `along` Blumensaat's line to the front, `across` away from the
/// roof.
struct QuadrantGrid {
  SideAxes axes;
  double hind = 0, front = 0;  ///< borders of the lateral condyle along the line
  double height = 0;           ///< from the line to the condyle's far border
  double roof_m = 0;           ///< along the line, where the roof of the notch ends in front

  double depth_share(const Vec3& p) const { return (axes.u(p) - hind) / (front - hind); }
  double height_share(const Vec3& p) const { return axes.v(p) / height; }
};
Result<QuadrantGrid> quadrant_grid(const CaseDef& def, const KneeParts& parts);

/// The tibial plateau: `along` the medial plateau to the back, `across` towards the foot.
struct PlateauGrid {
  SideAxes axes;
  double front = 0, back = 0;
  double medial = 0, lateral = 0;  ///< along y

  double front_share(const Vec3& p) const { return (axes.u(p) - front) / (back - front); }
  double medial_share(const Vec3& p) const { return (medial - p.y()) / (medial - lateral); }
};
Result<PlateauGrid> plateau_grid(const CaseDef& def, const KneeParts& parts);

/// Stretches of a straight line inside a closed surface, by distance from `p` along the unit
/// direction, in both directions, in order.
std::vector<std::pair<double, double>> stretches_inside(const TriMesh& mesh, const Vec3& p,
                                                        const Vec3& direction);

}  // namespace osteon
