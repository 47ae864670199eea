#include "tet/tet_work.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace osteon {

// At an edge of length l between faces of areas A and B: sin = 3 V l / (2 A B).
double least_sine(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 ab = b - a, ac = c - a, ad = d - a, bc = c - b, bd = d - b, cd = d - c;
  const double six_volumes = ab.cross(ac).dot(ad);
  if (!(six_volumes > 0)) return -1;
  const double over_d = ab.cross(ac).squaredNorm(), over_c = ab.cross(ad).squaredNorm(),
               over_b = ac.cross(ad).squaredNorm(), over_a = bc.cross(bd).squaredNorm();
  double least = ab.squaredNorm() / (over_c * over_d);
  least = std::min(least, ac.squaredNorm() / (over_b * over_d));
  least = std::min(least, ad.squaredNorm() / (over_b * over_c));
  least = std::min(least, bc.squaredNorm() / (over_a * over_d));
  least = std::min(least, bd.squaredNorm() / (over_a * over_c));
  least = std::min(least, cd.squaredNorm() / (over_a * over_b));
  return six_volumes * std::sqrt(least);
}

bool names(const Tetrahedron& tet, std::uint32_t v) {
  return tet[0] == v || tet[1] == v || tet[2] == v || tet[3] == v;
}

TetWork::TetWork(TetMesh mesh)
    : mesh_(std::move(mesh)),
      alive_(mesh_.tets.size(), 1),
      on_boundary_(mesh_.vertices.size(), 0),
      around_(mesh_.vertices.size()) {
  worth_.reserve(mesh_.tets.size());
  for (std::uint32_t t = 0; t < mesh_.tets.size(); ++t) {
    worth_.push_back(worth_of(mesh_.tets[t]));
    for (const std::uint32_t v : mesh_.tets[t]) around_[v].push_back(t);
  }
  for (const std::uint32_t v : boundary(mesh_).vertex_of) on_boundary_[v] = 1;
}

double TetWork::worth_of(const Tetrahedron& t) const {
  return least_sine(place(t[0]), place(t[1]), place(t[2]), place(t[3]));
}

double TetWork::least_worth_around(std::uint32_t v) const {
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t t : around_[v]) least = std::min(least, worth_[t]);
  return least;
}

double TetWork::least_worth_around(std::uint32_t v, const Vec3& p, double floor) const {
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t t : around_[v]) {
    const Tetrahedron& corner = mesh_.tets[t];
    const auto at = [&](std::size_t k) -> const Vec3& {
      return corner[k] == v ? p : mesh_.vertices[corner[k]];
    };
    least = std::min(least, least_sine(at(0), at(1), at(2), at(3)));
    if (least <= floor) return least;
  }
  return least;
}

void TetWork::move(std::uint32_t v, const Vec3& p) {
  mesh_.vertices[v] = p;
  for (const std::uint32_t t : around_[v]) worth_[t] = worth_of(mesh_.tets[t]);
}

void TetWork::remove(std::uint32_t t) {
  alive_[t] = 0;
  for (const std::uint32_t v : mesh_.tets[t]) std::erase(around_[v], t);
}

void TetWork::add(const Tetrahedron& added) {
  const auto t = static_cast<std::uint32_t>(mesh_.tets.size());
  mesh_.tets.push_back(added);
  alive_.push_back(1);
  worth_.push_back(worth_of(added));
  for (const std::uint32_t v : added) around_[v].push_back(t);
}

std::vector<std::uint32_t> TetWork::around_edge(std::uint32_t a, std::uint32_t b) const {
  std::vector<std::uint32_t> found;
  for (const std::uint32_t t : around_[a])
    if (names(mesh_.tets[t], b)) found.push_back(t);
  return found;
}

std::uint32_t TetWork::across(std::uint32_t t, std::size_t face) const {
  const Tetrahedron& corner = mesh_.tets[t];
  const std::uint32_t a = corner[kTetFaces[face][0]], b = corner[kTetFaces[face][1]],
                      c = corner[kTetFaces[face][2]];
  for (const std::uint32_t other : around_[a])
    if (other != t && names(mesh_.tets[other], b) && names(mesh_.tets[other], c)) return other;
  return kNone;
}

TetMesh TetWork::take() {
  TetMesh out;
  std::vector<std::uint32_t> renamed(mesh_.vertices.size(), kNone);
  for (std::uint32_t t = 0; t < mesh_.tets.size(); ++t) {
    if (!alive(t)) continue;
    Tetrahedron tet = mesh_.tets[t];
    for (std::uint32_t& v : tet) {
      if (renamed[v] == kNone) {
        renamed[v] = static_cast<std::uint32_t>(out.vertices.size());
        out.vertices.push_back(mesh_.vertices[v]);
      }
      v = renamed[v];
    }
    out.tets.push_back(tet);
  }
  return out;
}

}  // namespace osteon
