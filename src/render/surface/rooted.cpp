#include "surface/rooted.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "osteon/mesh/distance.h"

namespace osteon {
namespace {

// All in edges of the surface, which are about as long as the cells that it was grown in.
constexpr double kReach = 2.2;     // from bone, of what changes
constexpr double kDeepest = 4;     // in bone; what is deeper is not seen
constexpr double kDrawnIn = 0.7;   // where it meets bone
constexpr double kWidened = 0.55;  // there
constexpr double kEdge = 0.15;     // off bone, less than that is buried
constexpr int kEvenings = 10;
constexpr double kOfBone = 0.75;  // of its normal, where both meet

bool grows_into_bone(const SoftPart& soft) {
  return soft.kind == "ligament" || soft.kind == "tendon" || soft.kind == "meniscus";
}

Aabb box_of(const std::vector<Vec3>& points) {
  Aabb box;
  for (const Vec3& p : points) box.include(p);
  return box;
}

double mean_edge(const Surface& s) {
  double sum = 0;
  for (const Triangle& t : s.triangles) sum += (s.points[t[1]] - s.points[t[0]]).norm();
  return s.triangles.empty() ? 0 : sum / static_cast<double>(s.triangles.size());
}

/// The bone's triangles in a box, in World.
TriMesh near_part(const Bone& bone, const Aabb& box) {
  TriMesh part;
  part.vertices.reserve(bone.mesh.vertices.size());
  for (const Vec3& v : bone.mesh.vertices) part.vertices.push_back(bone.X_WB * v);
  for (const Triangle& t : bone.mesh.triangles) {
    Aabb own;
    for (const std::uint32_t v : t)
      if (v < part.vertices.size()) own.include(part.vertices[v]);
    if (own.overlaps(box)) part.triangles.push_back(t);
  }
  return part;
}

struct OverBone {
  double height = std::numeric_limits<double>::infinity();
  Vec3 out = Vec3::UnitZ();  ///< of the bone
};

class NearBones {
 public:
  NearBones(const Case& the_case, const SoftPart& soft, const Aabb& box) {
    for (const BoneId bone : soft.bones) {
      if (bone.index >= the_case.bones.size()) continue;
      TriMesh part = near_part(the_case.bones[bone.index], box);
      if (!part.triangles.empty()) bones_.emplace_back(std::move(part));
    }
  }
  OverBone at(const Vec3& p) const {
    OverBone nearest;
    for (const MeshDistance& bone : bones_) {
      const ClosestPoint at = bone.closest(p);
      if (!(at.signed_distance < nearest.height)) continue;
      nearest.height = at.signed_distance;
      const Triangle& t = bone.mesh().triangles[at.triangle];
      const auto& v = bone.mesh().vertices;
      const Vec3 across = (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]);
      const Vec3 away = at.signed_distance < 0 ? at.point - p : p - at.point;
      const Vec3& out = away.norm() > 1e-5 ? away : across;
      if (out.norm() > 0) nearest.out = out.normalized();
    }
    return nearest;
  }

 private:
  std::vector<MeshDistance> bones_;
};

/// 1 where it meets bone and in it, 0 from the reach on.
double closeness(double height, double edge_m) {
  const double t = std::clamp(height / (kReach * edge_m), 0.0, 1.0);
  return 1 - t * t * (3 - 2 * t);
}

Vec3 mean_about(const Surface& s, const std::vector<Vec3>& values, std::uint32_t k) {
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t e = s.first[k]; e < s.first[k + 1]; ++e) sum += values[s.neighbours[e]];
  return sum / std::max<double>(s.first[k + 1] - s.first[k], 1);
}

/// Each value goes towards the mean of its neighbours', by its share, again and again.
void even_out(const Surface& s, const std::vector<std::uint32_t>& which,
              const std::vector<double>& shares, std::vector<Vec3>& values) {
  std::vector<Vec3> next(which.size());
  for (int round = 0; round < kEvenings; ++round) {
    for (std::size_t i = 0; i < which.size(); ++i)
      next[i] =
          values[which[i]] + 0.6 * shares[i] * (mean_about(s, values, which[i]) - values[which[i]]);
    for (std::size_t i = 0; i < which.size(); ++i) values[which[i]] = next[i];
  }
}

std::array<float, 3> floats(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

Vec3 doubles(const std::array<float, 3>& v) {
  return Eigen::Vector3f(v[0], v[1], v[2]).cast<double>();
}

}  // namespace

std::vector<ShadedMesh::Root> find_roots(const Case& the_case, const SoftPart& soft,
                                         const Surface& surface) {
  const double edge_m = mean_edge(surface);
  if (!grows_into_bone(soft) || !(edge_m > 0)) return {};
  const NearBones bones(the_case, soft, box_of(surface.points).grown(2 * kDeepest * edge_m));
  std::vector<std::uint32_t> which;
  std::vector<double> shares;
  std::vector<Vec3> outs;
  for (std::uint32_t k = 0; k < surface.points.size(); ++k) {
    const OverBone over = bones.at(surface.points[k]);
    if (over.height > kReach * edge_m || over.height < -kDeepest * edge_m) continue;
    which.push_back(k);
    shares.push_back(closeness(over.height, edge_m));
    outs.push_back(over.out);
  }
  std::vector<Vec3> points = surface.points, normals = surface.normals;
  even_out(surface, which, shares, points);
  even_out(surface, which, std::vector<double>(which.size(), 1), normals);
  std::vector<ShadedMesh::Root> roots;
  for (std::size_t i = 0; i < which.size(); ++i) {
    const std::uint32_t k = which[i];
    const Vec3 aside = normals[k] - normals[k].dot(outs[i]) * outs[i];
    const Vec3 to = points[k] + shares[i] * edge_m * (kWidened * aside - kDrawnIn * outs[i]);
    const OverBone over = bones.at(to);
    ShadedMesh::Root root;
    root.vertex = k;
    root.shift = floats(to - surface.points[k]);
    root.out = floats(over.out);
    root.share = static_cast<float>(kOfBone * closeness(over.height, 0.7 * edge_m));
    root.buried = over.height < kEdge * edge_m;
    roots.push_back(root);
  }
  return roots;
}

std::vector<double> heights_over_bones(const Case& the_case, const SoftPart& soft,
                                       const Surface& surface) {
  constexpr double kMargin_m = 0.005;  // more than cartilage is thick
  const NearBones bones(the_case, soft, box_of(surface.points).grown(kMargin_m));
  std::vector<double> heights;
  heights.reserve(surface.points.size());
  for (const Vec3& p : surface.points) heights.push_back(bones.at(p).height);
  return heights;
}

void draw_in(const std::vector<ShadedMesh::Root>& roots, Surface& surface) {
  if (roots.empty()) return;
  for (const ShadedMesh::Root& root : roots)
    if (root.vertex < surface.points.size()) surface.points[root.vertex] += doubles(root.shift);
  make_normals(surface);
  for (const ShadedMesh::Root& root : roots) {
    if (root.vertex >= surface.points.size()) continue;
    Vec3& n = surface.normals[root.vertex];
    const Vec3 mixed = n + root.share * (doubles(root.out) - n);
    if (mixed.norm() > 0.2) n = mixed.normalized();
  }
}

void fill_buried(const std::vector<ShadedMesh::Root>& roots, const Surface& surface,
                 std::vector<float>& values) {
  std::vector<std::uint32_t> left;
  std::vector<bool> known(values.size(), true);
  for (const ShadedMesh::Root& root : roots) {
    if (!root.buried || root.vertex >= values.size()) continue;
    left.push_back(root.vertex);
    known[root.vertex] = false;
  }
  constexpr int kRings = 4;  // what is farther in bone is not seen
  for (int ring = 0; ring < kRings; ++ring) {
    std::vector<std::pair<std::uint32_t, float>> found;
    for (const std::uint32_t k : left) {
      float sum = 0;
      int count = 0;
      for (std::uint32_t e = surface.first[k]; e < surface.first[k + 1]; ++e)
        if (known[surface.neighbours[e]]) {
          sum += values[surface.neighbours[e]];
          ++count;
        }
      if (count > 0) found.emplace_back(k, sum / static_cast<float>(count));
    }
    for (const auto& [k, value] : found) {
      values[k] = value;
      known[k] = true;
    }
    std::erase_if(left, [&](std::uint32_t k) { return known[k]; });
  }
}

}  // namespace osteon
