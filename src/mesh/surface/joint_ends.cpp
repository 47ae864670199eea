#include "osteon/mesh/joint_ends.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

constexpr double kLong = 3;        // times as long as wide
constexpr double kQuarter = 0.25;  // of the length: where an end's width is looked for

// Middle of a triangle's surface and twice its area.
struct SurfacePart {
  Vec3 middle;
  double area;
};

std::vector<SurfacePart> patches(const TriMesh& mesh) {
  std::vector<SurfacePart> out;
  out.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    out.push_back({(a + b + c) / 3, (b - a).cross(c - a).norm()});
  }
  return out;
}

// Direction in which the surface spreads most, by the power method: for a long body a few steps.
Vec3 long_axis(const std::vector<SurfacePart>& surface) {
  Vec3 middle = Vec3::Zero();
  double area = 0;
  for (const SurfacePart& p : surface) {
    middle += p.area * p.middle;
    area += p.area;
  }
  if (!(area > 0)) return Vec3::UnitZ();
  middle /= area;
  Mat3 spread = Mat3::Zero();
  for (const SurfacePart& p : surface) {
    const Vec3 d = p.middle - middle;
    spread += p.area * d * d.transpose();
  }
  // Start: the column of most spread, which is not across the axis.
  Eigen::Index column = 0;
  for (Eigen::Index k = 1; k < 3; ++k)
    if (spread(k, k) > spread(column, column)) column = k;
  Vec3 axis = spread.col(column);
  constexpr int kSteps = 40;
  for (int i = 0; i < kSteps && axis.norm() > 0; ++i) axis = (spread * axis).normalized();
  return axis.norm() > 0 ? axis : Vec3(Vec3::UnitZ());
}

// Largest extent across the axis of the vertices between two heights.
double width(const TriMesh& mesh, const Vec3& axis, double from, double to) {
  const Vec3 any = std::abs(axis.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 e1 = axis.cross(any).normalized();
  const Vec3 e2 = axis.cross(e1);
  double widest = 0;
  for (const Vec3& n : {e1, e2, Vec3((e1 + e2).normalized()), Vec3((e1 - e2).normalized())}) {
    double lo = 1e300, hi = -1e300;
    for (const Vec3& v : mesh.vertices) {
      const double s = axis.dot(v);
      if (s < from || s > to) continue;
      lo = std::min(lo, n.dot(v));
      hi = std::max(hi, n.dot(v));
    }
    widest = std::max(widest, hi - lo);
  }
  return widest;
}

}  // namespace

JointEnds::JointEnds(const TriMesh& mesh) {
  if (mesh.vertices.empty()) return;
  axis_ = long_axis(patches(mesh));
  double lo = 1e300, hi = -1e300;
  for (const Vec3& v : mesh.vertices) {
    lo = std::min(lo, axis_.dot(v));
    hi = std::max(hi, axis_.dot(v));
  }
  const double quarter = kQuarter * (hi - lo);
  const double low_end = width(mesh, axis_, lo, lo + quarter);
  const double high_end = width(mesh, axis_, hi - quarter, hi);
  low_ = lo + low_end;
  high_ = hi - high_end;
  has_shaft_ = hi - lo > kLong * std::max(low_end, high_end);
}

}  // namespace osteon
