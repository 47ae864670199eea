#include "case/union_surface.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "osteon/mesh/longest_edge.h"

namespace osteon {
namespace {

using Corners = std::array<Vec3, 3>;

// Triangles are judged a little over themselves, so that two faces against each other both vanish.
constexpr double kLift = 2e-6;

enum class Place { kApart, kInside, kAcross };

Place place_of(const Corners& t, const Hull& piece) {
  bool inside = true;
  for (const Plane& plane : piece.planes) {
    bool all_beyond = true;
    for (const Vec3& p : t) {
      const bool beyond = plane.signed_distance(p) >= 0;
      all_beyond &= beyond;
      inside &= !beyond;
    }
    if (all_beyond) return Place::kApart;
  }
  return inside ? Place::kInside : Place::kAcross;
}

bool holds(const Hull& piece, const Vec3& p) {
  return std::all_of(piece.planes.begin(), piece.planes.end(),
                     [&](const Plane& plane) { return plane.signed_distance(p) < 0; });
}

class Peeler {
 public:
  Peeler(std::span<const Hull> pieces, double seam_m) : pieces_(pieces), seam2_(seam_m * seam_m) {
    for (const Hull& piece : pieces) {
      Aabb box;
      for (const Vec3& v : piece.vertices) box.include(v);
      boxes_.push_back(box);
    }
  }

  TriMesh run() {
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      for (std::size_t k = 0; k < pieces_[i].triangles.size(); ++k) {
        const Triangle& t = pieces_[i].triangles[k];
        lift_ = kLift * pieces_[i].planes[pieces_[i].plane_of[k]].n;
        const auto& v = pieces_[i].vertices;
        const Corners corners{v[t[0]], v[t[1]], v[t[2]]};
        peel(corners, neighbours(i, corners));
      }
    return std::move(out_);
  }

 private:
  std::vector<std::size_t> neighbours(std::size_t own, const Corners& t) const {
    Aabb box;
    for (const Vec3& p : t) box.include(p);
    const Aabb near = box.grown(2 * kLift);
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      if (i != own && boxes_[i].overlaps(near)) out.push_back(i);
    return out;
  }

  void peel(const Corners& t, const std::vector<std::size_t>& candidates) {
    const Corners lifted{t[0] + lift_, t[1] + lift_, t[2] + lift_};
    std::vector<std::size_t> across;
    for (const std::size_t i : candidates) {
      const Place place = place_of(lifted, pieces_[i]);
      if (place == Place::kInside) return;
      if (place == Place::kAcross) across.push_back(i);
    }
    if (across.empty()) return keep(t);
    const auto [longest, length2] = longest_edge(t);
    if (length2 <= seam2_) {
      const Vec3 middle = (lifted[0] + lifted[1] + lifted[2]) / 3;
      const bool hidden = std::any_of(across.begin(), across.end(),
                                      [&](std::size_t i) { return holds(pieces_[i], middle); });
      return hidden ? void() : keep(t);
    }
    const Vec3& a = t[longest];
    const Vec3& b = t[(longest + 1) % 3];
    const Vec3& c = t[(longest + 2) % 3];
    const Vec3 middle = 0.5 * (a + b);
    peel({a, middle, c}, across);
    peel({middle, b, c}, across);
  }

  void keep(const Corners& t) {
    const auto first = static_cast<std::uint32_t>(out_.vertices.size());
    out_.vertices.insert(out_.vertices.end(), t.begin(), t.end());
    out_.triangles.push_back({first, first + 1, first + 2});
  }

  std::span<const Hull> pieces_;
  double seam2_;
  std::vector<Aabb> boxes_;
  Vec3 lift_ = Vec3::Zero();
  TriMesh out_;
};

}  // namespace

TriMesh union_surface(std::span<const Hull> pieces, double seam_m) {
  return Peeler(pieces, seam_m).run();
}

}  // namespace osteon
