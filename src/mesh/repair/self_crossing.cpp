#include "osteon/mesh/self_crossing.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "osteon/base/union_find.h"
#include "repair/triangle_cross.h"

namespace osteon {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;
constexpr std::size_t kLeaf = 8;

/// Boxes of triangles, halved at the median of the longest side; each node's triangles are a range
/// of `order`.
class BoxTree {
 public:
  explicit BoxTree(const TriMesh& mesh) : boxes_(mesh.triangles.size()), order_(boxes_.size()) {
    for (std::size_t t = 0; t < boxes_.size(); ++t)
      for (const std::uint32_t v : mesh.triangles[t]) boxes_[t].include(mesh.vertices[v]);
    std::iota(order_.begin(), order_.end(), 0u);
    if (!order_.empty()) build(0, order_.size());
  }

  template <class Visit>
  void overlapping(const Aabb& box, Visit visit) const {
    // One child waits for each level of a tree that halves at every node.
    constexpr std::size_t kMostOpen = 64;
    std::array<std::size_t, kMostOpen> open;
    open[0] = 0;
    for (std::size_t waiting = 1; waiting > 0;) {
      const std::size_t self = open[--waiting];
      const Node& node = nodes_[self];
      if (!node.box.overlaps(box)) continue;
      if (node.right == 0) {
        for (std::size_t i = node.first; i < node.last; ++i)
          if (boxes_[order_[i]].overlaps(box)) visit(order_[i]);
        continue;
      }
      open[waiting++] = node.right;
      open[waiting++] = self + 1;
    }
  }
  const Aabb& box(std::uint32_t triangle) const { return boxes_[triangle]; }

 private:
  struct Node {
    Aabb box;
    std::size_t first, last;
    std::size_t right = 0;  ///< 0: a leaf; the left child follows its parent
  };

  void build(std::size_t first, std::size_t last) {
    const std::size_t self = nodes_.size();
    nodes_.push_back({{}, first, last, 0});
    Aabb box;
    for (std::size_t i = first; i < last; ++i) {
      box.include(boxes_[order_[i]].lo);
      box.include(boxes_[order_[i]].hi);
    }
    nodes_[self].box = box;
    if (last - first <= kLeaf) return;
    Vec3::Index axis = 0;
    box.extent().maxCoeff(&axis);
    const auto begin = order_.begin();
    const auto at = [&](std::size_t i) { return begin + static_cast<std::ptrdiff_t>(i); };
    const std::size_t middle = (first + last) / 2;
    std::nth_element(at(first), at(middle), at(last), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(boxes_[a].center()[axis], a) < std::pair(boxes_[b].center()[axis], b);
    });
    build(first, middle);
    nodes_[self].right = nodes_.size();
    build(middle, last);
  }

  std::vector<Aabb> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

// The part of each vertex: what edges or corners join has one name.
std::vector<std::uint32_t> parts_of(const TriMesh& mesh) {
  UnionFind parts(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : {t[1], t[2]}) parts.join(t[0], v);
  return parts.names();
}

}  // namespace

std::vector<Pair> self_crossings(const TriMesh& mesh, const std::vector<bool>& marked,
                                 std::size_t most) {
  std::vector<Pair> found;
  if (mesh.triangles.empty()) return found;
  const BoxTree tree(mesh);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!marked[t]) continue;
    tree.overlapping(tree.box(t), [&](std::uint32_t other) {
      // A pair of marked ones is met twice.
      if (other == t || (marked[other] && other < t)) return;
      if (triangles_cross(mesh.vertices, mesh.triangles[t], mesh.triangles[other]))
        found.emplace_back(std::min(t, other), std::max(t, other));
    });
    if (found.size() >= most) break;
  }
  std::sort(found.begin(), found.end());
  found.resize(std::min(found.size(), most));
  return found;
}

std::vector<Pair> self_crossings(const TriMesh& mesh, std::size_t most) {
  return self_crossings(mesh, std::vector<bool>(mesh.triangles.size(), true), most);
}

std::optional<Pair> crossing_parts(const TriMesh& mesh) {
  if (mesh.triangles.empty()) return std::nullopt;
  const std::vector<std::uint32_t> part = parts_of(mesh);
  const auto of = [&](std::uint32_t t) { return part[mesh.triangles[t][0]]; };
  if (std::all_of(mesh.triangles.begin(), mesh.triangles.end(),
                  [&](const Triangle& t) { return part[t[0]] == of(0); }))
    return std::nullopt;
  const BoxTree tree(mesh);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    std::uint32_t least = t;
    tree.overlapping(tree.box(t), [&](std::uint32_t other) {
      if (other > t && (least == t || other < least) && of(other) != of(t) &&
          triangles_cross(mesh.vertices, mesh.triangles[t], mesh.triangles[other]))
        least = other;
    });
    if (least != t) return Pair{t, least};
  }
  return std::nullopt;
}

}  // namespace osteon
