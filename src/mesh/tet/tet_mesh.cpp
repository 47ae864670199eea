#include "osteon/mesh/tet_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

namespace osteon {
namespace {

constexpr std::uint32_t kUnnumbered = std::numeric_limits<std::uint32_t>::max();

/// The two corners of each edge, then the two others.
constexpr std::array<std::array<std::size_t, 4>, 6> kEdgesAndRest = {
    {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};

struct FaceUse {
  std::array<std::uint32_t, 3> sorted;
  std::uint32_t tet;
  std::uint8_t face;
};

std::vector<FaceUse> lone_faces(const std::vector<Tetrahedron>& tets) {
  std::vector<FaceUse> uses;
  uses.reserve(4 * tets.size());
  for (std::uint32_t t = 0; t < tets.size(); ++t) {
    for (std::uint8_t k = 0; k < 4; ++k) {
      std::array<std::uint32_t, 3> face{tets[t][kTetFaces[k][0]], tets[t][kTetFaces[k][1]],
                                        tets[t][kTetFaces[k][2]]};
      std::sort(face.begin(), face.end());
      uses.push_back({face, t, k});
    }
  }
  const auto order = [](const FaceUse& a, const FaceUse& b) {
    return std::tie(a.sorted, a.tet, a.face) < std::tie(b.sorted, b.tet, b.face);
  };
  std::sort(uses.begin(), uses.end(), order);
  std::vector<FaceUse> lone;
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t next = i + 1;
    while (next < uses.size() && uses[next].sorted == uses[i].sorted) ++next;
    if (next == i + 1) lone.push_back(uses[i]);
    i = next;
  }
  std::sort(lone.begin(), lone.end(), [](const FaceUse& a, const FaceUse& b) {
    return std::tie(a.tet, a.face) < std::tie(b.tet, b.face);
  });
  return lone;
}

}  // namespace

double signed_volume(const std::array<Vec3, 4>& c) {
  return (c[1] - c[0]).cross(c[2] - c[0]).dot(c[3] - c[0]) / 6;
}

std::array<double, 6> dihedral_angles(const std::array<Vec3, 4>& c) {
  std::array<double, 6> angles{};
  for (std::size_t e = 0; e < kEdgesAndRest.size(); ++e) {
    const Vec3& from = c[kEdgesAndRest[e][0]];
    const Vec3 along = c[kEdgesAndRest[e][1]] - from;
    const Vec3 n = along.cross(c[kEdgesAndRest[e][2]] - from);
    const Vec3 m = along.cross(c[kEdgesAndRest[e][3]] - from);
    angles[e] = std::atan2(n.cross(m).norm(), n.dot(m));
  }
  return angles;
}

std::array<Vec3, 4> corners_of(const TetMesh& mesh, const Tetrahedron& tet) {
  return {mesh.vertices[tet[0]], mesh.vertices[tet[1]], mesh.vertices[tet[2]],
          mesh.vertices[tet[3]]};
}

double volume(const TetMesh& mesh) {
  double sum = 0;
  for (const Tetrahedron& tet : mesh.tets) sum += signed_volume(corners_of(mesh, tet));
  return sum;
}

TetBoundary boundary(const TetMesh& mesh) {
  TetBoundary out;
  std::vector<std::uint32_t> renamed(mesh.vertices.size(), kUnnumbered);
  for (const FaceUse& use : lone_faces(mesh.tets)) {
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.tets[use.tet][kTetFaces[use.face][k]];
      if (renamed[v] == kUnnumbered) {
        renamed[v] = static_cast<std::uint32_t>(out.vertex_of.size());
        out.vertex_of.push_back(v);
        out.surface.vertices.push_back(mesh.vertices[v]);
      }
      triangle[k] = renamed[v];
    }
    out.surface.triangles.push_back(triangle);
    out.tet_of.push_back(use.tet);
  }
  return out;
}

TetQuality quality(const TetMesh& mesh) {
  TetQuality out;
  if (mesh.tets.empty()) return out;
  out.min_dihedral_rad = std::numbers::pi;
  for (const Tetrahedron& tet : mesh.tets) {
    const std::array<Vec3, 4> corners = corners_of(mesh, tet);
    if (!(signed_volume(corners) > 0)) ++out.inverted;
    double smallest = std::numbers::pi;
    for (const double angle : dihedral_angles(corners)) {
      smallest = std::min(smallest, angle);
      out.max_dihedral_rad = std::max(out.max_dihedral_rad, angle);
      const double bin = angle / std::numbers::pi * static_cast<double>(kDihedralBins);
      ++out.histogram[std::min(static_cast<std::size_t>(bin), kDihedralBins - 1)];
    }
    out.min_dihedral_rad = std::min(out.min_dihedral_rad, smallest);
    out.mean_smallest_rad += smallest / static_cast<double>(mesh.tets.size());
  }
  return out;
}

}  // namespace osteon
