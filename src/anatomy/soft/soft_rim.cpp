#include "soft/soft_rim.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

#include "osteon/mesh/taubin.h"

namespace osteon {
namespace {

constexpr int kPasses = 3;         // after each, vertices are laid on the surface
constexpr int kRoundsPerPass = 8;  // in its tangent planes
// Taubin's steps: waves as short as five edges of the rim go, those of ten and more stay.
constexpr double kIn = 0.5, kOut = -0.53;
constexpr double kReach = 0.6;  // of an edge, from the first place
constexpr int kNormalRounds = 4;
constexpr int kRings = 3;  // beside the rim, that follow it

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// The vertices before and after each vertex of the rim, kNone for all others and for those where
/// the rim touches itself.
class RimCurves {
 public:
  explicit RimCurves(const CoveredPatch& patch) : beside_(patch.vertices.size(), {kNone, kNone}) {
    std::map<Edge, int> uses;
    for (const Triangle& t : patch.triangles)
      for (std::size_t k = 0; k < 3; ++k) ++uses[std::minmax(t[k], t[(k + 1) % 3])];
    std::vector<int> count(patch.vertices.size(), 0);
    for (const auto& [edge, used] : uses) {
      if (used != 1) continue;
      for (const auto& [a, b] : {edge, Edge{edge.second, edge.first}})
        if (++count[a] <= 2) beside_[a][static_cast<std::size_t>(count[a] - 1)] = b;
      length_ += (patch.vertices[edge.first].p - patch.vertices[edge.second].p).norm();
      ++edges_;
    }
    for (std::size_t v = 0; v < count.size(); ++v) {
      on_rim_.push_back(count[v] > 0);
      if (count[v] != 2) beside_[v] = {kNone, kNone};
    }
  }
  bool holds(std::size_t v) const { return on_rim_[v]; }
  bool smooth_at(std::size_t v) const { return beside_[v][1] != kNone; }
  const std::array<std::uint32_t, 2>& beside(std::size_t v) const { return beside_[v]; }
  double mean_edge() const { return edges_ > 0 ? length_ / edges_ : 0; }

 private:
  std::vector<std::array<std::uint32_t, 2>> beside_;
  std::vector<bool> on_rim_;
  double length_ = 0;
  int edges_ = 0;
};

VertexRings rings_of(const CoveredPatch& patch) {
  TriMesh mesh;
  for (const CoveredVertex& v : patch.vertices) mesh.vertices.push_back(v.p);
  mesh.triangles = patch.triangles;
  return vertex_rings(mesh);
}

class RimEvener {
 public:
  RimEvener(const MeshDistance& surface, const CoveredPatch& whole,
            const std::function<bool(const Vec3&)>& stays, CoveredPatch& patch)
      : surface_(surface),
        whole_(whole),
        patch_(patch),
        rim_(patch),
        rings_(rings_of(patch)),
        on_(patch.vertices.size(), 0) {
    for (const CoveredVertex& v : patch.vertices) home_.push_back(v.p);
    find_near();
    for (const std::uint32_t v : near_) {
      if (!rim_.holds(v))
        followers_.push_back(v);
      else if (rim_.smooth_at(v) && !stays(home_[v]))
        curve_.push_back(v);
    }
  }

  void run() {
    for (int pass = 0; pass < kPasses; ++pass) {
      for (int round = 0; round < kRoundsPerPass; ++round) {
        move_curve(kIn);
        move_curve(kOut);
        follow();
      }
      for (const std::uint32_t v : near_) lay_down(v);
    }
    undo_turned();
    even_normals();
  }

 private:
  /// The rim's vertices and those of the rings beside it.
  void find_near() {
    std::vector<bool> seen(home_.size(), false);
    const auto take = [&](std::uint32_t v) {
      if (!seen[v]) near_.push_back(v);
      seen[v] = true;
    };
    for (std::uint32_t v = 0; v < home_.size(); ++v)
      if (rim_.holds(v)) take(v);
    std::size_t first = 0;
    for (int ring = 0; ring < kRings; ++ring)
      for (const std::size_t last = near_.size(); first < last; ++first) {
        const std::uint32_t at = near_[first];
        for (std::uint32_t k = rings_.first[at]; k < rings_.first[at + 1]; ++k)
          take(rings_.neighbour[k]);
      }
  }

  /// By `share` of the way to `goal`, along the surface.
  Vec3 moved(std::uint32_t v, const Vec3& goal, double share) const {
    const CoveredVertex& from = patch_.vertices[v];
    const Vec3 way = share * (goal - from.p);
    const Vec3 off = from.p + way - way.dot(from.normal) * from.normal - home_[v];
    const double far = off.norm(), most = kReach * rim_.mean_edge();
    return home_[v] + off * (far > most ? most / far : 1.0);
  }

  void move_curve(double share) {
    std::vector<Vec3> to;
    for (const std::uint32_t v : curve_) {
      const auto& [a, b] = rim_.beside(v);
      to.push_back(moved(v, 0.5 * (patch_.vertices[a].p + patch_.vertices[b].p), share));
    }
    for (std::size_t i = 0; i < to.size(); ++i) patch_.vertices[curve_[i]].p = to[i];
  }

  void follow() {
    for (const std::uint32_t v : followers_) {
      Vec3 sum = Vec3::Zero();
      for (std::uint32_t k = rings_.first[v]; k < rings_.first[v + 1]; ++k)
        sum += patch_.vertices[rings_.neighbour[k]].p;
      patch_.vertices[v].p = moved(v, sum / (rings_.first[v + 1] - rings_.first[v]), 0.3);
    }
  }

  void lay_down(std::uint32_t v) {
    CoveredVertex& laid = patch_.vertices[v];
    const ClosestPoint at = surface_.closest(laid.p, on_[v]);
    on_[v] = at.triangle;
    laid.p = at.point;
    read(laid, at.triangle);
  }

  /// Normal and `inside` of the surface at a vertex that lies in this triangle.
  void read(CoveredVertex& laid, std::uint32_t triangle) const {
    const Triangle& t = whole_.triangles[triangle];
    const auto corner = [&](std::size_t k) -> const CoveredVertex& {
      return whole_.vertices[t[k]];
    };
    const Vec3 u = corner(1).p - corner(0).p, v = corner(2).p - corner(0).p;
    const Vec3 n = u.cross(v), w = laid.p - corner(0).p;
    const double n2 = n.squaredNorm();
    if (n2 <= 0) return;
    const double b = w.cross(v).dot(n) / n2, c = u.cross(w).dot(n) / n2;
    laid.inside = (1 - b - c) * corner(0).inside + b * corner(1).inside + c * corner(2).inside;
    laid.normal =
        ((1 - b - c) * corner(0).normal + b * corner(1).normal + c * corner(2).normal).normalized();
  }

  /// Where a triangle has turned over, its corners go back; in the end all may have.
  void undo_turned() {
    std::vector<std::uint32_t> undone;
    for (bool again = true; again;) {
      again = false;
      for (const Triangle& t : patch_.triangles) {
        if (!has_turned(t)) continue;
        for (const std::uint32_t v : t) {
          if (patch_.vertices[v].p == home_[v]) continue;
          patch_.vertices[v].p = home_[v];
          undone.push_back(v);
          again = true;
        }
      }
    }
    for (const std::uint32_t v : undone) lay_down(v);
  }

  bool has_turned(const Triangle& t) const {
    const auto& v = patch_.vertices;
    const Vec3 across = (v[t[1]].p - v[t[0]].p).cross(v[t[2]].p - v[t[0]].p);
    return across.dot(v[t[0]].normal + v[t[1]].normal + v[t[2]].normal) <= 0;
  }

  /// Where the rim runs along a crest of the bone they swing to and fro.
  void even_normals() {
    std::vector<Vec3> evened;
    for (int round = 0; round < kNormalRounds; ++round) {
      evened.clear();
      for (const std::uint32_t v : curve_) evened.push_back(normals_beside(v));
      for (const std::uint32_t v : followers_) evened.push_back(normals_around(v));
      std::size_t next = 0;
      for (const auto* moving : {&curve_, &followers_})
        for (const std::uint32_t v : *moving) {
          const Vec3 sum = patch_.vertices[v].normal + evened[next++];
          if (sum.norm() > 0.1) patch_.vertices[v].normal = sum.normalized();
        }
    }
  }

  Vec3 normals_beside(std::uint32_t v) const {
    const auto& [a, b] = rim_.beside(v);
    return 0.5 * (patch_.vertices[a].normal + patch_.vertices[b].normal);
  }

  Vec3 normals_around(std::uint32_t v) const {
    Vec3 sum = Vec3::Zero();
    for (std::uint32_t k = rings_.first[v]; k < rings_.first[v + 1]; ++k)
      sum += patch_.vertices[rings_.neighbour[k]].normal;
    return sum / (rings_.first[v + 1] - rings_.first[v]);
  }

  const MeshDistance& surface_;
  const CoveredPatch& whole_;
  CoveredPatch& patch_;
  RimCurves rim_;
  VertexRings rings_;
  std::vector<Vec3> home_;
  std::vector<std::uint32_t> near_, curve_, followers_;
  std::vector<std::uint32_t> on_;  ///< triangle of the surface, of the last query
};

}  // namespace

void even_rim(const MeshDistance& surface, const CoveredPatch& whole,
              const std::function<bool(const Vec3&)>& stays, CoveredPatch& patch) {
  RimEvener(surface, whole, stays, patch).run();
}

}  // namespace osteon
