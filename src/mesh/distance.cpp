#include "osteon/mesh/distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "closest_on_triangle.h"
#include "edges.h"

namespace osteon {
namespace {

constexpr std::uint32_t kLeaf = 4;

double squared_distance(const Aabb& box, const Vec3& p) {
  return (box.lo - p).cwiseMax(p - box.hi).cwiseMax(0.0).squaredNorm();
}

Vec3 unit_or_zero(const Vec3& n) {
  const double length = n.norm();
  return length > 0 ? Vec3(n / length) : Vec3(Vec3::Zero());
}

// Angle at corner k of a triangle.
double angle_at(const TriMesh& mesh, const Triangle& t, std::size_t k) {
  const Vec3 a = mesh.vertices[t[(k + 1) % 3]] - mesh.vertices[t[k]];
  const Vec3 b = mesh.vertices[t[(k + 2) % 3]] - mesh.vertices[t[k]];
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

MeshDistance::MeshDistance(TriMesh mesh) : mesh_(std::move(mesh)) {
  compute_normals();
  const auto count = static_cast<std::uint32_t>(mesh_.triangles.size());
  if (count == 0) return;
  std::vector<Vec3> centers;
  centers.reserve(count);
  for (const Triangle& t : mesh_.triangles)
    centers.push_back((mesh_.vertices[t[0]] + mesh_.vertices[t[1]] + mesh_.vertices[t[2]]) / 3);
  order_.resize(count);
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(count);
  nodes_.emplace_back();
  build(0, 0, count, centers);
}

// Halves at the median of the triangles' centres along the longest side of their box.
void MeshDistance::build(std::uint32_t node, std::uint32_t first, std::uint32_t count,
                         const std::vector<Vec3>& centers) {
  Aabb box;
  Aabb center_box;
  for (std::uint32_t i = first; i < first + count; ++i) {
    for (const std::uint32_t v : mesh_.triangles[order_[i]]) box.include(mesh_.vertices[v]);
    center_box.include(centers[order_[i]]);
  }
  nodes_[node].box = box;
  if (count <= kLeaf) {
    nodes_[node].first = first;
    nodes_[node].count = count;
    return;
  }
  Vec3::Index axis = 0;
  center_box.extent().maxCoeff(&axis);
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count,
                   [&centers, axis](std::uint32_t a, std::uint32_t b) {
                     return std::pair(centers[a][axis], a) < std::pair(centers[b][axis], b);
                   });
  const auto left = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = left;
  nodes_.resize(nodes_.size() + 2);
  build(left, first, count / 2, centers);
  build(left + 1, first + count / 2, count - count / 2, centers);
}

void MeshDistance::compute_normals() {
  face_normals_.reserve(mesh_.triangles.size());
  vertex_normals_.assign(mesh_.vertices.size(), Vec3::Zero());
  for (const Triangle& t : mesh_.triangles) {
    const Vec3& a = mesh_.vertices[t[0]];
    const Vec3 n = unit_or_zero((mesh_.vertices[t[1]] - a).cross(mesh_.vertices[t[2]] - a));
    face_normals_.push_back(n);
    for (std::size_t k = 0; k < 3; ++k) vertex_normals_[t[k]] += angle_at(mesh_, t, k) * n;
  }
  edge_normals_.resize(mesh_.triangles.size());
  for_each_edge(edge_uses(mesh_.triangles), [this](auto first, auto last) {
    Vec3 sum = Vec3::Zero();
    for (auto use = first; use != last; ++use) sum += face_normals_[use->triangle];
    for (auto use = first; use != last; ++use) edge_normals_[use->triangle][use->corner] = sum;
  });
}

struct MeshDistance::Search {
  const MeshDistance& tree;
  const Vec3& p;
  double best = std::numeric_limits<double>::infinity();  ///< squared
  std::uint32_t triangle = 0;
  TrianglePoint at;

  void look_at(std::uint32_t t) {
    const Triangle& corner = tree.mesh_.triangles[t];
    const auto& vertices = tree.mesh_.vertices;
    const TrianglePoint found =
        closest_on_triangle(p, vertices[corner[0]], vertices[corner[1]], vertices[corner[2]]);
    const double squared = (found.point - p).squaredNorm();
    if (squared > best || (squared == best && t > triangle)) return;
    best = squared;
    triangle = t;
    at = found;
  }

  void run() {
    // A child waits for each level of a tree that halves at every node.
    constexpr std::size_t kDeepest = 64;
    std::array<std::pair<double, std::uint32_t>, kDeepest> open;
    open[0] = {0.0, 0u};
    for (std::size_t count = 1; count > 0;) {
      const auto [bound, index] = open[--count];
      const Node& node = tree.nodes_[index];
      if (bound > best) continue;
      if (node.count > 0) {
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
          look_at(tree.order_[i]);
        continue;
      }
      std::pair<double, std::uint32_t> near{squared_distance(tree.nodes_[node.first].box, p),
                                            node.first};
      std::pair<double, std::uint32_t> far{squared_distance(tree.nodes_[node.first + 1].box, p),
                                           node.first + 1};
      if (far.first < near.first) std::swap(near, far);
      open[count++] = far;
      open[count++] = near;
    }
  }

  const Vec3& pseudo_normal() const {
    const Triangle& t = tree.mesh_.triangles[triangle];
    switch (at.part) {
      case TrianglePart::kEdge0:
        return tree.edge_normals_[triangle][0];
      case TrianglePart::kEdge1:
        return tree.edge_normals_[triangle][1];
      case TrianglePart::kEdge2:
        return tree.edge_normals_[triangle][2];
      case TrianglePart::kCorner0:
        return tree.vertex_normals_[t[0]];
      case TrianglePart::kCorner1:
        return tree.vertex_normals_[t[1]];
      case TrianglePart::kCorner2:
        return tree.vertex_normals_[t[2]];
      case TrianglePart::kFace:
        break;
    }
    return tree.face_normals_[triangle];
  }
};

ClosestPoint MeshDistance::finish(Search& search) const {
  search.run();
  ClosestPoint result;
  result.point = search.at.point;
  result.triangle = search.triangle;
  const double distance = std::sqrt(search.best);
  const bool inside = search.pseudo_normal().dot(search.p - result.point) < 0;
  result.signed_distance = inside ? -distance : distance;
  return result;
}

ClosestPoint MeshDistance::closest(const Vec3& p) const {
  if (nodes_.empty()) return {};
  Search search{*this, p, std::numeric_limits<double>::infinity(), 0, {}};
  return finish(search);
}

ClosestPoint MeshDistance::closest(const Vec3& p, std::uint32_t guess) const {
  if (guess >= mesh_.triangles.size()) return closest(p);
  Search search{*this, p, std::numeric_limits<double>::infinity(), guess, {}};
  search.look_at(guess);
  return finish(search);
}

}  // namespace osteon
