#include "osteon/mesh/distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "repair/edges.h"
#include "surface/closest_on_triangle.h"

namespace osteon {
namespace {

constexpr std::size_t kWide = 4;

Vec3 unit_or_zero(const Vec3& n) {
  const double length = n.norm();
  return length > 0 ? Vec3(n / length) : Vec3(Vec3::Zero());
}

// True when a corner lies so near the opposite side that rounding may turn the normal.
bool is_sliver(const TriMesh& mesh, const Triangle& t) {
  constexpr double kThinnest = 1e-3;
  const Vec3& a = mesh.vertices[t[0]];
  const Vec3 ab = mesh.vertices[t[1]] - a, ac = mesh.vertices[t[2]] - a;
  const double longest2 = std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
  return !(ab.cross(ac).norm() > kThinnest * longest2);
}

// Angle at corner k of a triangle.
double angle_at(const TriMesh& mesh, const Triangle& t, std::size_t k) {
  const Vec3 a = mesh.vertices[t[(k + 1) % 3]] - mesh.vertices[t[k]];
  const Vec3 b = mesh.vertices[t[(k + 2) % 3]] - mesh.vertices[t[k]];
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

/// Halves at the median of the triangles' centres along the longest side of their box, twice a
/// node; all leaves but the last are full.
struct MeshDistance::Builder {
  struct Item {
    Vec3 center;
    std::uint32_t triangle;
  };
  using Items = std::span<Item>;

  const TriMesh& mesh;
  std::vector<Node>& nodes;

  static std::pair<Items, Items> halves(Items items) {
    Aabb box;
    for (const Item& item : items) box.include(item.center);
    Vec3::Index axis = 0;
    box.extent().maxCoeff(&axis);
    const std::size_t half = (items.size() / 2 + kWide - 1) / kWide * kWide;
    std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                     [axis](const Item& a, const Item& b) {
                       return std::pair(a.center[axis], a.triangle) <
                              std::pair(b.center[axis], b.triangle);
                     });
    return {items.first(half), items.subspan(half)};
  }

  /// Makes the node of the items at `at`; returns their box.
  Aabb build(std::uint32_t at, Items items) {
    if (items.size() <= kWide) return build_leaf(at, items);
    std::array<Items, kWide> parts;
    std::uint32_t count = 0;
    const auto [left, right] = halves(items);
    for (const Items half : {left, right}) {
      if (half.size() <= kWide) {
        parts[count++] = half;
        continue;
      }
      const auto [first, second] = halves(half);
      parts[count++] = first;
      parts[count++] = second;
    }
    const auto first = static_cast<std::uint32_t>(nodes.size());
    nodes.resize(nodes.size() + count);
    Aabb all;
    for (std::uint32_t k = 0; k < count; ++k) {
      const Aabb box = build(first + k, parts[k]);
      add(at, first + k, box);
      all.include(box.lo);
      all.include(box.hi);
    }
    return all;
  }

  Aabb build_leaf(std::uint32_t at, Items items) {
    nodes[at].leaf = true;
    Aabb all;
    for (const Item& item : items) {
      Aabb box;
      for (const std::uint32_t v : mesh.triangles[item.triangle]) box.include(mesh.vertices[v]);
      add(at, item.triangle, box);
      all.include(box.lo);
      all.include(box.hi);
    }
    return all;
  }

  void add(std::uint32_t at, std::uint32_t child, const Aabb& box) {
    Node& node = nodes[at];
    const std::uint32_t k = node.count++;
    node.child[k] = child;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      node.lo[axis][k] = box.lo[static_cast<Eigen::Index>(axis)];
      node.hi[axis][k] = box.hi[static_cast<Eigen::Index>(axis)];
    }
  }
};

MeshDistance::MeshDistance(TriMesh mesh) : mesh_(std::move(mesh)) {
  compute_normals();
  const auto count = static_cast<std::uint32_t>(mesh_.triangles.size());
  if (count == 0) return;
  std::vector<Builder::Item> items;
  items.reserve(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    const auto& [a, b, c] = mesh_.triangles[t];
    items.push_back({(mesh_.vertices[a] + mesh_.vertices[b] + mesh_.vertices[c]) / 3, t});
    for (const std::uint32_t v : mesh_.triangles[t])
      scale_ = std::max(scale_, mesh_.vertices[v].cwiseAbs().maxCoeff());
  }
  nodes_.reserve(count / 2 + 1);
  nodes_.emplace_back();
  Builder{mesh_, nodes_}.build(0, items);
}

void MeshDistance::compute_normals() {
  face_normals_.reserve(mesh_.triangles.size());
  sure_normals_.reserve(mesh_.triangles.size());
  vertex_normals_.assign(mesh_.vertices.size(), Vec3::Zero());
  for (const Triangle& t : mesh_.triangles) {
    const Vec3& a = mesh_.vertices[t[0]];
    const Vec3 n = unit_or_zero((mesh_.vertices[t[1]] - a).cross(mesh_.vertices[t[2]] - a));
    face_normals_.push_back(n);
    sure_normals_.push_back(is_sliver(mesh_, t) ? Vec3(Vec3::Zero()) : n);
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

  /// Above the rounding of a distance to a plane.
  double rounding() const {
    constexpr double kRounding = 1e-12;
    return kRounding * (tree.scale_ + p.cwiseAbs().maxCoeff());
  }

  /// True when the triangle's plane alone is farther than what is known.
  bool plane_is_farther(std::uint32_t t, double rounding) const {
    const Vec3& a = tree.mesh_.vertices[tree.mesh_.triangles[t][0]];
    const double least = std::abs(tree.sure_normals_[t].dot(p - a)) - rounding;
    return least > 0 && least * least > best;
  }

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

  struct Open {
    double bound;  ///< squared distance to the box
    std::uint32_t child;
  };

  /// The node's children that may hold something nearer, the nearest first; returns their count.
  std::size_t nearest_first(const Node& node, std::array<Open, kWide>& sorted) const {
    const auto beside = [&](std::size_t axis) -> Eigen::Array4d {
      const double x = p[static_cast<Eigen::Index>(axis)];
      return (node.lo[axis] - x).max(x - node.hi[axis]).max(0.0);
    };
    const Eigen::Array4d bound = beside(0).square() + beside(1).square() + beside(2).square();
    std::size_t count = 0;
    for (std::uint32_t k = 0; k < node.count; ++k) {
      if (bound[k] > best) continue;
      std::size_t place = count++;
      for (; place > 0 && sorted[place - 1].bound > bound[k]; --place)
        sorted[place] = sorted[place - 1];
      sorted[place] = {bound[k], node.child[k]};
    }
    return count;
  }

  void run() {
    // Three children wait for each level of a tree that quarters at every node.
    constexpr std::size_t kMostOpen = 64;
    std::array<Open, kMostOpen> open;
    std::array<Open, kWide> sorted;
    const double slack = rounding();
    open[0] = {0.0, 0u};
    for (std::size_t waiting = 1; waiting > 0;) {
      const auto [bound, index] = open[--waiting];
      if (bound > best) continue;
      const Node& node = tree.nodes_[index];
      std::size_t count = nearest_first(node, sorted);
      if (!node.leaf) {
        while (count > 0) open[waiting++] = sorted[--count];
        continue;
      }
      for (std::size_t k = 0; k < count; ++k)
        if (sorted[k].bound <= best && !plane_is_farther(sorted[k].child, slack))
          look_at(sorted[k].child);
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

double MeshDistance::distance_to(const Vec3& p, std::uint32_t triangle) const {
  const auto& [a, b, c] = mesh_.triangles[triangle];
  const auto& v = mesh_.vertices;
  return std::sqrt((closest_on_triangle(p, v[a], v[b], v[c]).point - p).squaredNorm());
}

}  // namespace osteon
