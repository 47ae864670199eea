#include "osteon/tissue/skin_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "osteon/mesh/distance.h"

namespace osteon {
namespace {

constexpr double kFar_m = 0.03;  // along z: skin beyond is that of the body's other side

/// The skin's triangles over the sheet's box, in its frame, facing along z.
std::vector<std::array<Vec3, 3>> under(const TriMesh& skin_W, const Pose& X_WS, const Aabb& box) {
  const Pose X_SW = X_WS.inverse();
  std::vector<Vec3> p_S;
  p_S.reserve(skin_W.vertices.size());
  for (const Vec3& p : skin_W.vertices) p_S.push_back(X_SW * p);
  std::vector<std::array<Vec3, 3>> out;
  for (const Triangle& t : skin_W.triangles) {
    const std::array<Vec3, 3> p = {p_S[t[0]], p_S[t[1]], p_S[t[2]]};
    Aabb of;
    for (const Vec3& q : p) of.include(q);
    const bool over = of.lo.x() <= box.hi.x() && of.hi.x() >= box.lo.x() &&
                      of.lo.y() <= box.hi.y() && of.hi.y() >= box.lo.y();
    if (over && std::abs(of.lo.z()) < kFar_m && (p[1] - p[0]).cross(p[2] - p[0]).z() > 0)
      out.push_back(p);
  }
  return out;
}

// The highest skin over (x, y); the sheets of an edge share it.
std::optional<double> height_at(const std::vector<std::array<Vec3, 3>>& skin, const Vec3& p) {
  std::optional<double> best;
  for (const auto& [a, b, c] : skin) {
    const auto side = [&](const Vec3& from, const Vec3& to) {
      return (to.x() - from.x()) * (p.y() - from.y()) - (to.y() - from.y()) * (p.x() - from.x());
    };
    const double wc = side(a, b), wa = side(b, c), wb = side(c, a), sum = wa + wb + wc;
    if (!(wa >= 0 && wb >= 0 && wc >= 0 && sum > 0)) continue;
    const double z = (wa * a.z() + wb * b.z() + wc * c.z()) / sum;
    if (!best || z > *best) best = z;
  }
  return best;
}

// Cuts the rectangle of a sheet out of a skin. Each triangle is cut along the rectangle's four
// lines in turn: what lies beyond a line stays, the rest goes on to the next, and what is left
// after all four is under the sheet. A cut of an edge is computed from its ends in the order of
// their numbers and kept by its place, so that both triangles beside the edge get the same vertex.
class SheetHole {
 public:
  SheetHole(const TriMesh& skin_W, const Pose& X_WS, double width_m, double height_m)
      : half_(0.5 * width_m, 0.5 * height_m), X_WS_(X_WS), skin_(skin_W) {
    const Pose X_SW = X_WS.inverse();
    for (const Vec3& p : skin_W.vertices) p_S_.push_back(X_SW * p);
    out_.vertices = skin_W.vertices;
  }

  TriMesh cut() {
    for (const Triangle& t : skin_.triangles) {
      const bool far = std::any_of(
          t.begin(), t.end(), [&](std::uint32_t v) { return std::abs(p_S_[v].z()) >= kFar_m; });
      if (far)
        out_.triangles.push_back(t);
      else
        cut_triangle(t);
    }
    return std::move(out_);
  }

 private:
  using Polygon = std::vector<std::uint32_t>;

  // How far a vertex lies beyond the line: right, left, upper and lower side of the rectangle.
  double beyond(std::uint32_t v, int line) const {
    const int axis = line / 2;
    return (line % 2 == 0 ? 1 : -1) * p_S_[v][axis] - half_[axis];
  }

  void cut_triangle(const Triangle& t) {
    Polygon left(t.begin(), t.end());
    std::vector<Polygon> kept;
    for (int line = 0; line < 4 && !left.empty(); ++line) {
      Polygon outer, inner;
      for (std::size_t i = 0; i < left.size(); ++i) {
        const std::uint32_t a = left[i], b = left[(i + 1) % left.size()];
        const double at_a = beyond(a, line), at_b = beyond(b, line);
        if (at_a >= 0) outer.push_back(a);
        if (at_a <= 0) inner.push_back(a);
        if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0)) {
          const std::uint32_t c = between(a, b, line);
          outer.push_back(c);
          inner.push_back(c);
        }
      }
      if (outer.size() >= 3) kept.push_back(std::move(outer));
      left = inner.size() >= 3 ? std::move(inner) : Polygon();
    }
    // Whole where nothing of it lies under the sheet.
    if (left.empty()) return out_.triangles.push_back(t);
    for (const Polygon& p : kept)
      for (std::size_t i = 1; i + 1 < p.size(); ++i)
        out_.triangles.push_back({p[0], p[i], p[i + 1]});
  }

  std::uint32_t between(std::uint32_t a, std::uint32_t b, int line) {
    if (a > b) std::swap(a, b);
    const double at_a = beyond(a, line), at_b = beyond(b, line);
    const Vec3 p = p_S_[a] + at_a / (at_a - at_b) * (p_S_[b] - p_S_[a]);
    const auto [found, is_new] =
        at_.try_emplace({p.x(), p.y(), p.z()}, static_cast<std::uint32_t>(p_S_.size()));
    if (is_new) {
      p_S_.push_back(p);
      out_.vertices.push_back(X_WS_ * p);
    }
    return found->second;
  }

  Eigen::Vector2d half_;
  Pose X_WS_;
  const TriMesh& skin_;
  std::vector<Vec3> p_S_;
  TriMesh out_;
  std::map<std::array<double, 3>, std::uint32_t> at_;  // vertices that came about
};

}  // namespace

Result<Pose> sheet_frame(const TriMesh& skin_W, const Vec3& near_W, const Vec3& up_W,
                         double turn_rad, double reach_m) {
  if (skin_W.triangles.empty())
    return fail("the case has no skin", "skin scene", "Use another case");
  const Vec3 at = MeshDistance(skin_W).closest(near_W).point;
  Vec3 z = Vec3::Zero();
  for (const Triangle& t : skin_W.triangles) {
    const Vec3 &a = skin_W.vertices[t[0]], &b = skin_W.vertices[t[1]], &c = skin_W.vertices[t[2]];
    if (((a + b + c) / 3 - at).norm() < reach_m) z += (b - a).cross(c - a);
  }
  const Vec3 y = up_W - up_W.dot(z) / std::max(z.squaredNorm(), 1e-300) * z;
  if (!(z.norm() > 0) || !(y.norm() > 0.1 * up_W.norm()))
    return fail("the skin there has no side that looks along the limb", "skin scene",
                "Choose another place");
  Mat3 axes;
  axes.col(2) = z.normalized();
  axes.col(1) = y.normalized();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  return Pose{at, Quat(axes) * Quat(Eigen::AngleAxisd(turn_rad, Vec3::UnitZ()))};
}

Result<TriMesh> lay_on(const TriMesh& skin_W, const Pose& X_WS, const TriMesh& surface_S) {
  Aabb box;
  for (const Vec3& p : surface_S.vertices) box.include(p);
  const auto skin = under(skin_W, X_WS, box);
  TriMesh out;
  out.triangles = surface_S.triangles;
  for (const Vec3& p : surface_S.vertices) {
    const auto height = height_at(skin, p);
    if (!height)
      return fail("the sheet reaches beyond the case's skin", "skin scene",
                  "Make the sheet smaller, or choose a place where the skin is flatter");
    out.vertices.push_back(X_WS * Vec3(p.x(), p.y(), p.z() + *height));
  }
  return out;
}

TriMesh around(const TriMesh& skin_W, const Pose& X_WS, double width_m, double height_m) {
  return SheetHole(skin_W, X_WS, width_m, height_m).cut();
}

}  // namespace osteon
