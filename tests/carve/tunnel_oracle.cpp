#include "tunnel_oracle.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>

#include "mesh/surface_checks.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/self_crossing.h"

namespace osteon::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace pmp = CGAL::Polygon_mesh_processing;

Mesh to_cgal(const TriMesh& mesh) {
  Mesh out;
  std::vector<Mesh::Vertex_index> v;
  v.reserve(mesh.vertices.size());
  for (const Vec3& p : mesh.vertices)
    v.push_back(out.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z())));
  for (const Triangle& t : mesh.triangles) out.add_face(v[t[0]], v[t[1]], v[t[2]]);
  return out;
}

TriMesh cylinder(const Vec3& from, const Vec3& to, double diameter_m, std::uint32_t sides) {
  const Vec3 z = (to - from).normalized();
  const Vec3 x = z.unitOrthogonal(), y = z.cross(x);
  // As much across as the circle has.
  const double radius = 0.5 * diameter_m * std::sqrt(2 * M_PI / sides / std::sin(2 * M_PI / sides));
  TriMesh m;
  for (const Vec3& end : {from, to})
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double a = 2 * M_PI * i / sides + 0.1234;
      m.vertices.push_back(end + radius * (std::cos(a) * x + std::sin(a) * y));
    }
  m.vertices.push_back(from);
  m.vertices.push_back(to);
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t j = (i + 1) % sides;
    m.triangles.push_back({i, j, sides + j});
    m.triangles.push_back({i, sides + j, sides + i});
    m.triangles.push_back({2 * sides, j, i});
    m.triangles.push_back({2 * sides + 1, sides + i, sides + j});
  }
  return m;
}

}  // namespace

double cgal_volume_less_cylinder(const TriMesh& bone, const Vec3& from, const Vec3& to,
                                 double diameter_m) {
  Mesh a = to_cgal(bone), b = to_cgal(cylinder(from, to, diameter_m, 1024)), out;
  if (!pmp::corefine_and_compute_difference(a, b, out)) return -1;
  return CGAL::to_double(pmp::volume(out));
}

std::string faults_of(const TriMesh& bone, const TunnelPlan& plan, const TunnelCut& cut) {
  const TriMesh drilled = drilled_bone(plan, cut);
  std::string faults;
  if (!checks::is_closed_manifold(drilled)) faults += "not a closed manifold; ";
  if (!checks::has_single_fans(drilled)) faults += "a vertex with two fans; ";
  if (const auto crossings = self_crossings(drilled, 5); !crossings.empty())
    faults += "triangles cross; ";
  const double removed = volume(bone) - volume(drilled);
  if (std::abs(removed - cut.removed_m3) > 1e-15 + 1e-9 * volume(bone))
    faults += "removed volume is wrong; ";
  const Vec3 along = (plan.line.to - plan.line.from).normalized();
  for (const auto& rim : cut.rims)
    for (std::size_t i = 0; i < rim.size(); ++i) {
      // Corners and the middles of the edges between them.
      for (const Vec3& p : {rim[i], Vec3(0.5 * (rim[i] + rim[(i + 1) % rim.size()]))}) {
        const double r = (p - plan.line.from).cross(along).norm();
        if (std::abs(r - 0.5 * plan.line.diameter_m) > 0.02e-3 && i + 1 < rim.size()) {
          faults += "a rim lies off the cylinder; ";
          return faults;
        }
      }
    }
  return faults;
}

}  // namespace osteon::test
