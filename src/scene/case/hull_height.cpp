#include "case/hull_height.h"

#include <algorithm>
#include <cmath>

#include "osteon/hull/hull.h"
#include "osteon/mesh/distance.h"
#include "osteon/mesh/measure.h"

namespace osteon {

double hull_height(const TriMesh& mesh) {
  constexpr double kSteps = 100;
  const HullOutcome outcome = build_hull(mesh.vertices);
  if (!outcome.hull || mesh.triangles.empty()) return 0;
  const double spacing = bounds(mesh).extent().maxCoeff() / kSteps;
  const MeshDistance surface(mesh);
  double most = 0;
  for (const Triangle& t : outcome.hull->triangles) {
    const Vec3 &a = outcome.hull->vertices[t[0]], &b = outcome.hull->vertices[t[1]],
               &c = outcome.hull->vertices[t[2]];
    const double side = std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
    const int n = 1 + static_cast<int>(side / spacing);
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) {
        const Vec3 p =
            a + static_cast<double>(i) / n * (b - a) + static_cast<double>(j) / n * (c - a);
        most = std::max(most, std::abs(surface.closest(p).signed_distance));
      }
  }
  return most;
}

}  // namespace osteon
