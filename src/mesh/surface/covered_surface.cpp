// The solid of a bone and the layers on it.
//
// Symbols: B the bone, L_i its layers, T the triangles of B and of all L_i that can be touched. A
// piece of B is covered where a layer holds it or lies over it along its normal; a piece of L_i is
// hidden where B or another layer holds it or faces it from at most kGap_m. A triangle of which
// some places are hidden and some are not is quartered. Invariant: away from T's open edges (its
// seams) T bounds the solid, so the pseudo-normal there gives the sign of a distance (Baerentzen
// and Aanaes 2005); where the nearest place lies at a seam, B and all L_i are asked.
// Ends: each round halves the edges, down to kFine_m.
#include "osteon/mesh/covered_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "osteon/mesh/measure.h"
#include "repair/edges.h"

namespace osteon {
namespace {

constexpr double kLargest_m = 1.0;   // no bone is longer: a mistaken unit
constexpr double kFine_m = 0.0001;   // no edge below this is divided
constexpr double kCoarse_m = 0.002;  // of a longer one its samples are too far apart to be believed
constexpr double kTouch_m = 0.00002;  // so near over a place a layer lies on it
constexpr double kFacing = -0.2;      // cosine between normals of faces that look at each other

using Corners = std::array<Vec3, 3>;

Result<void> check_closed(const TriMesh& mesh, const std::string& what) {
  for (const Vec3& v : mesh.vertices)
    if (!is_finite(v)) return fail("a vertex is not finite", what, "Repair the mesh");
  if (mesh.triangles.empty() || !topology(mesh).closed() || !(volume(mesh) > 0))
    return fail("it is not one closed surface that faces outwards", what,
                "Repair the mesh with 'osteon import mesh'");
  Aabb box;
  for (const Vec3& v : mesh.vertices) box.include(v);
  if (box.extent().maxCoeff() > kLargest_m)
    return fail("it is more than a metre long", what, "Check its unit");
  return {};
}

double longest_side(const Corners& c) {
  return std::max({(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[0] - c[2]).norm()});
}

Vec3 unit_normal(const Corners& c) {
  const Vec3 n = (c[1] - c[0]).cross(c[2] - c[0]);
  const double length = n.norm();
  return length > 0 ? Vec3(n / length) : Vec3(Vec3::Zero());
}

Vec3 face_normal(const MeshDistance& mesh, std::uint32_t t) {
  const auto& [a, b, c] = mesh.mesh().triangles[t];
  const auto& v = mesh.mesh().vertices;
  return unit_normal({v[a], v[b], v[c]});
}

void append_corners(TriMesh& to, const Corners& c) {
  const auto first = static_cast<std::uint32_t>(to.vertices.size());
  to.vertices.insert(to.vertices.end(), c.begin(), c.end());
  to.triangles.push_back({first, first + 1, first + 2});
}

// Keeps what is not hidden of one mesh; whole triangles keep their shared vertices.
template <class Far, class Hidden>
void append_touchable(const TriMesh& from, const Far& far, const Hidden& hidden, TriMesh& to) {
  const auto first = static_cast<std::uint32_t>(to.vertices.size());
  to.vertices.insert(to.vertices.end(), from.vertices.begin(), from.vertices.end());
  for (const Triangle& t : from.triangles) {
    const Corners whole{from.vertices[t[0]], from.vertices[t[1]], from.vertices[t[2]]};
    const Vec3 n = unit_normal(whole);
    std::vector<Corners> open{whole}, kept;
    bool divided = false;
    while (!open.empty()) {
      const Corners c = open.back();
      open.pop_back();
      const Vec3 middle = (c[0] + c[1] + c[2]) / 3;
      const double side = longest_side(c);
      if (far(middle, side)) {
        kept.push_back(c);
        continue;
      }
      const Vec3 ab = 0.5 * (c[0] + c[1]), bc = 0.5 * (c[1] + c[2]), ca = 0.5 * (c[2] + c[0]);
      const bool here = hidden(middle, n);
      bool alike = side <= kCoarse_m;
      // Corners lie on the rims themselves: one looks a little inside of them.
      for (const Vec3& p : {c[0], c[1], c[2], ab, bc, ca})
        alike = alike && hidden(Vec3(p + 0.05 * (middle - p)), n) == here;
      if (alike || side <= kFine_m) {
        if (!here) kept.push_back(c);
        continue;
      }
      divided = true;
      for (const Corners& part : {Corners{c[0], ab, ca}, Corners{ab, c[1], bc},
                                  Corners{ca, bc, c[2]}, Corners{ab, bc, ca}})
        open.push_back(part);
    }
    if (!divided && !kept.empty())
      to.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    else
      for (const Corners& part : kept) append_corners(to, part);
  }
}

TriMesh without_loose_vertices(const TriMesh& mesh) {
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> to(mesh.vertices.size(), kNone);
  TriMesh out;
  for (Triangle t : mesh.triangles) {
    for (std::uint32_t& v : t) {
      if (to[v] == kNone) {
        to[v] = static_cast<std::uint32_t>(out.vertices.size());
        out.vertices.push_back(mesh.vertices[v]);
      }
      v = to[v];
    }
    out.triangles.push_back(t);
  }
  return out;
}

// Of each triangle: bit k: its corner k lies at a seam; bit 3 + k: so does its side from there on.
std::vector<std::uint8_t> seams_of(const TriMesh& mesh) {
  std::vector<std::uint8_t> open(mesh.vertices.size(), 0), out(mesh.triangles.size(), 0);
  for_each_edge(edge_uses(mesh.triangles), [&](auto first, auto last) {
    if (last - first == 2) return;
    for (auto use = first; use != last; ++use) {
      const Triangle& t = mesh.triangles[use->triangle];
      open[t[use->corner]] = open[t[(use->corner + 1) % 3]] = 1;
      out[use->triangle] = static_cast<std::uint8_t>(out[use->triangle] | 8u << use->corner);
    }
  });
  for (std::size_t t = 0; t < out.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (open[mesh.triangles[t][k]] != 0) out[t] = static_cast<std::uint8_t>(out[t] | 1u << k);
  return out;
}

bool lies_at_seam(const TriMesh& mesh, std::uint32_t t, std::uint8_t seams, const Vec3& p) {
  constexpr double kOn_m = 1e-9;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& a = mesh.vertices[mesh.triangles[t][k]];
    const Vec3& b = mesh.vertices[mesh.triangles[t][(k + 1) % 3]];
    if ((seams >> k & 1) != 0 && (p - a).norm() < kOn_m) return true;
    const double side = (b - a).norm();
    if ((seams >> (3 + k) & 1) != 0 && (p - a).cross(b - a).norm() < kOn_m * side) return true;
  }
  return false;
}

}  // namespace

struct CoveredSurface::Maker {
  const MeshDistance& bone;
  const std::vector<MeshDistance>& layers;

  // Of the bone's surface.
  bool covered(const Vec3& p, const Vec3& n) const {
    for (const MeshDistance& layer : layers) {
      const double d = layer.closest(p).signed_distance;
      if (d < 0) return true;
      if (d > kGap_m) continue;
      for (const double up : {kTouch_m, 0.3 * kGap_m, kGap_m})
        if (layer.closest(p + up * n).signed_distance < 0) return true;
    }
    return false;
  }

  static bool faces(const MeshDistance& other, const Vec3& p, const Vec3& n) {
    const ClosestPoint found = other.closest(p);
    if (found.signed_distance < 0) return true;
    return found.signed_distance <= kGap_m && face_normal(other, found.triangle).dot(n) < kFacing;
  }

  // Of a layer's surface.
  bool hidden(const Vec3& p, const Vec3& n, std::size_t own) const {
    if (faces(bone, p, n)) return true;
    for (std::size_t i = 0; i < layers.size(); ++i)
      if (i != own && faces(layers[i], p, n)) return true;
    return false;
  }

  TriMesh touched() const {
    TriMesh out;
    std::vector<Aabb> boxes;
    for (const MeshDistance& layer : layers) boxes.push_back(bounds(layer.mesh()));
    const auto far_from_layers = [&](const Vec3& p, double side) {
      const double reach = side + 2 * kGap_m;
      for (std::size_t i = 0; i < layers.size(); ++i) {
        const Vec3 out_of = (boxes[i].lo - p).cwiseMax(p - boxes[i].hi);
        if (out_of.maxCoeff() <= reach && layers[i].closest(p).signed_distance <= reach)
          return false;
      }
      return true;
    };
    append_touchable(
        bone.mesh(), far_from_layers, [&](const Vec3& p, const Vec3& n) { return covered(p, n); },
        out);
    const auto never = [](const Vec3&, double) { return false; };
    for (std::size_t i = 0; i < layers.size(); ++i)
      append_touchable(
          layers[i].mesh(), never, [&](const Vec3& p, const Vec3& n) { return hidden(p, n, i); },
          out);
    return without_loose_vertices(out);
  }
};

Result<CoveredSurface> CoveredSurface::make(const TriMesh& bone,
                                            const std::vector<TriMesh>& layers) {
  if (auto sound = check_closed(bone, "the bone"); !sound) return tl::unexpected(sound.error());
  std::vector<MeshDistance> made;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (auto sound = check_closed(layers[i], "layer " + std::to_string(i + 1)); !sound)
      return tl::unexpected(sound.error());
    made.emplace_back(layers[i]);
  }
  MeshDistance distance(bone);
  MeshDistance touched(Maker{distance, made}.touched());
  return CoveredSurface(std::move(distance), std::move(made), std::move(touched));
}

CoveredSurface::CoveredSurface(MeshDistance bone, std::vector<MeshDistance> layers,
                               MeshDistance touched)
    : bone_(std::move(bone)),
      layers_(std::move(layers)),
      touched_(std::move(touched)),
      seams_(seams_of(touched_.mesh())) {}

// Between two that nearly touch, they lie on opposite sides of the point.
bool CoveredSurface::inside(const Vec3& p) const {
  std::vector<Vec3> beside;
  const auto holds = [&](const MeshDistance& solid) {
    const ClosestPoint found = solid.closest(p);
    if (found.signed_distance < 0) return true;
    if (found.signed_distance > kGap_m) return false;
    const Vec3 way = found.point - p;
    for (const Vec3& other : beside)
      if (way.dot(other) <= -0.5 * way.norm() * other.norm()) return true;
    beside.push_back(way);
    return false;
  };
  return holds(bone_) || std::any_of(layers_.begin(), layers_.end(), holds);
}

ClosestPoint CoveredSurface::closest(const Vec3& p, std::uint32_t guess) const {
  ClosestPoint found = touched_.closest(p, guess);
  const std::uint8_t seams = found.triangle < seams_.size() ? seams_[found.triangle] : 0;
  if (seams == 0) return found;
  // A piece beside a rim may reach under the layer by kFine_m: near it the normal is no witness.
  const double distance = std::abs(found.signed_distance);
  if (distance > 3 * kFine_m && !lies_at_seam(touched(), found.triangle, seams, found.point))
    return found;
  found.signed_distance = inside(p) ? -distance : distance;
  return found;
}

ClosestPoint CoveredSurface::closest(const Vec3& p) const { return closest(p, 0xffffffffu); }

}  // namespace osteon
