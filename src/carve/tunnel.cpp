#include "osteon/carve/tunnel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "osteon/mesh/distance.h"
#include "osteon/mesh/measure.h"
#include "tunnel_cut.h"
#include "tunnel_patch.h"
#include "tunnel_prism.h"

namespace osteon {

namespace tunnel {

/// The part of the bone about the line, in the drill's frame.
struct Site {
  Site(TriMesh mesh, const TunnelLine& line)
      : bone(std::move(mesh)), frame(line.from, line.to - line.from) {}

  bool in_bone(const Vec3& p_A) const {
    return bone.closest(frame.from_A(p_A)).signed_distance < 0;
  }

  MeshDistance bone;
  Frame frame;
  Patch patch;
  std::vector<std::uint32_t> source;  ///< the bone's vertex of each point of the patch
  double reach = 0;                   ///< largest depth that the patch is good for, m
  Placing placing;
};

}  // namespace tunnel

namespace {

using tunnel::Facet;
using tunnel::Site;

/// Facets this close to the drill are looked at: the shifts of its placing are smaller.
constexpr double kMargin_m = 10e-6;
/// Meetings of the axis with the surface that are nearer than this are one.
constexpr double kSamePlace_m = 1e-9;

Result<void> check_line(const TriMesh& bone, const TunnelLine& line) {
  if (!is_finite(line.from) || !is_finite(line.to) || !std::isfinite(line.diameter_m))
    return fail("has a number that is not finite", "the tunnel's line", "Give finite numbers");
  if (!(line.diameter_m > 0))
    return fail("has no diameter", "the tunnel", "Give a diameter above zero");
  if (line.diameter_m < 10e-6)
    return fail("is thinner than 0.01 mm", "the tunnel", "Give its diameter in the right unit");
  if (!((line.to - line.from).norm() > kMargin_m))
    return fail("has no length", "the tunnel's line", "Give two different points");
  if (bone.triangles.empty()) return fail("has no triangles", "the bone", "Give a closed surface");
  for (const Vec3& v : bone.vertices)
    if (!is_finite(v))
      return fail("has a vertex that is not finite", "the bone", "Export it again");
  const Topology shape = topology(bone);
  if (!shape.closed())
    return fail("is not closed: " + std::to_string(shape.boundary_edges) + " open edges, " +
                    std::to_string(shape.non_manifold_edges) + " edges of three triangles or more",
                "the bone", "Repair it first (osteon import mesh)");
  return {};
}

std::vector<Vec3> all_in_frame(const TriMesh& mesh, const tunnel::Frame& frame) {
  std::vector<Vec3> points;
  points.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) points.push_back(frame.to_A(v));
  return points;
}

bool is_near(const Triangle& t, const std::vector<Vec3>& points_A, double radius) {
  Aabb box;
  for (const std::uint32_t v : t) box.include(points_A[v]);
  return box.lo.x() <= radius && box.hi.x() >= -radius && box.lo.y() <= radius &&
         box.hi.y() >= -radius && box.hi.z() >= -kMargin_m;
}

/// Sets apart what a drill of this radius can change however deep it goes: the near triangles and
/// those on an edge with one.
void fill_patch(Site& site, double radius, std::vector<std::uint32_t>& touched) {
  const TriMesh& mesh = site.bone.mesh();
  const std::vector<Vec3> points_A = all_in_frame(mesh, site.frame);
  std::vector<std::uint8_t> near(mesh.triangles.size(), 0), on_near(points_A.size(), 0);
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (!is_near(mesh.triangles[i], points_A, radius + kMargin_m)) continue;
    near[i] = 1;
    for (const std::uint32_t v : mesh.triangles[i]) on_near[v] = 1;
  }
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> local(points_A.size(), kNone);
  for (std::size_t i = 0; i < near.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    // Two corners at least on near ones: a little more than those on an edge with one.
    if (!near[i] && on_near[t[0]] + on_near[t[1]] + on_near[t[2]] < 2) continue;
    Facet f;
    f.near = near[i] != 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (local[t[k]] == kNone) {
        local[t[k]] = static_cast<std::uint32_t>(site.source.size());
        site.source.push_back(t[k]);
        site.patch.points_A.push_back(points_A[t[k]]);
      }
      f.v[k] = local[t[k]];
    }
    site.patch.facets.push_back(f);
    touched.push_back(static_cast<std::uint32_t>(i));
  }
  for (const Vec3& p : points_A) site.reach = std::max(site.reach, p.z());
}

/// Where the axis may meet the surface: every facet that it meets or brushes.
std::vector<double> axis_meetings(const Site& site) {
  std::vector<double> found;
  for (const Facet& f : site.patch.facets) {
    const std::array<Vec3, 3> p{site.patch.points_A[f.v[0]], site.patch.points_A[f.v[1]],
                                site.patch.points_A[f.v[2]]};
    std::array<double, 3> w{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
      w[k] = a.x() * b.y() - a.y() * b.x();
    }
    const double sum = w[0] + w[1] + w[2];
    const double slack = 1e-12 * (std::abs(w[0]) + std::abs(w[1]) + std::abs(w[2]));
    const bool front = w[0] >= -slack && w[1] >= -slack && w[2] >= -slack;
    const bool back = w[0] <= slack && w[1] <= slack && w[2] <= slack;
    if (!front && !back) continue;
    if (std::abs(sum) > slack && sum != 0)
      found.push_back((w[0] * p[0].z() + w[1] * p[1].z() + w[2] * p[2].z()) / sum);
    else
      for (const Vec3& corner : p) found.push_back(corner.z());
  }
  return found;
}

/// Stretches of the axis in bone, from `from` on: between two meetings its middle tells.
std::vector<TunnelPass> find_passes(const Site& site, double length) {
  std::vector<double> stops = axis_meetings(site);
  std::erase_if(stops, [&](double z) { return !(z > 0 && z < length); });
  stops.push_back(0);
  stops.push_back(length);
  std::sort(stops.begin(), stops.end());
  std::vector<TunnelPass> passes;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    if (stops[i + 1] - stops[i] < kSamePlace_m) continue;
    if (!site.in_bone(Vec3(0, 0, 0.5 * (stops[i] + stops[i + 1])))) continue;
    if (!passes.empty() && stops[i] - passes.back().exit_m < kSamePlace_m)
      passes.back().exit_m = stops[i + 1];
    else
      passes.push_back({stops[i], stops[i + 1]});
  }
  return passes;
}

/// Six times the volume between the triangles and a point.
double six_volumes(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                   const Vec3& from) {
  double sum = 0;
  for (const Triangle& t : triangles)
    sum += (points[t[0]] - from).dot((points[t[1]] - from).cross(points[t[2]] - from));
  return sum;
}

double removed_volume(const Site& site, const tunnel::CutPatch& cut, double depth) {
  std::vector<Triangle> before;
  for (const Facet& f : site.patch.facets) before.push_back(f.v);
  const Vec3 middle(0, 0, 0.5 * depth);
  return (six_volumes(cut.points_A, before, middle) -
          six_volumes(cut.points_A, cut.triangles, middle)) /
         6;
}

}  // namespace

Result<TunnelPlan> plan_tunnel(TriMesh bone, const TunnelLine& line) {
  if (const auto good = check_line(bone, line); !good) return tl::unexpected(good.error());
  TunnelPlan plan;
  plan.line = line;
  plan.length_m = (line.to - line.from).norm();
  auto site = std::make_shared<Site>(std::move(bone), line);
  fill_patch(*site, 0.5 * line.diameter_m, plan.touched);
  plan.bone = std::shared_ptr<const TriMesh>(site, &site->bone.mesh());
  plan.passes = find_passes(*site, std::max(plan.length_m, site->reach + kMargin_m));
  plan.site = site;
  const auto whole = advance(plan, plan.length_m);
  if (!whole) return tl::unexpected(whole.error());
  plan.rims = whole->rims;
  return plan;
}

Result<TunnelCut> advance(const TunnelPlan& plan, double depth_m) {
  if (!std::isfinite(depth_m))
    return fail("is not finite", "the tunnel's depth", "Give a finite number");
  const Site& site = *plan.site;
  TunnelCut out;
  const double radius = 0.5 * plan.line.diameter_m;
  const double depth = std::max(depth_m, 0.0);
  tunnel::CutPatch cut;
  if (depth > 0) {
    cut = tunnel::cut_patch(site.patch, {radius, 0, depth}, site.placing,
                            [&site](const Vec3& p_A) { return site.in_bone(p_A); });
    if (cut.clearance == 0)
      return fail("intersects itself in the tunnel's path", "the bone's surface",
                  "Repair it first (osteon mesh quality shows where)");
  } else {
    cut.points_A = site.patch.points_A;
    for (const Facet& f : site.patch.facets) cut.triangles.push_back(f.v);
  }
  out.removed_m3 = removed_volume(site, cut, depth);
  const std::size_t old = site.patch.points_A.size();
  const auto first = static_cast<std::uint32_t>(plan.bone->vertices.size());
  for (std::size_t i = old; i < cut.points_A.size(); ++i)
    out.vertices.push_back(site.frame.from_A(cut.points_A[i]));
  for (Triangle t : cut.triangles) {
    for (std::uint32_t& v : t)
      v = v < old ? site.source[v] : first + (v - static_cast<std::uint32_t>(old));
    out.triangles.push_back(t);
  }
  for (const auto& rim : cut.rims) {
    out.rims.emplace_back();
    for (const std::uint32_t p : rim) out.rims.back().push_back(site.frame.from_A(cut.points_A[p]));
  }
  out.bottom_m2 = cut.bottom_m2;
  out.sides = cut.sides;
  out.radius_shift_m = cut.placing.radius_shift;
  return out;
}

TriMesh drilled_bone(const TunnelPlan& plan, const TunnelCut& cut) {
  const TriMesh& bone = *plan.bone;
  TriMesh out;
  std::vector<Triangle> triangles;
  triangles.reserve(bone.triangles.size() + cut.triangles.size());
  auto next = plan.touched.begin();
  for (std::size_t i = 0; i < bone.triangles.size(); ++i) {
    if (next != plan.touched.end() && *next == i)
      ++next;
    else
      triangles.push_back(bone.triangles[i]);
  }
  triangles.insert(triangles.end(), cut.triangles.begin(), cut.triangles.end());
  std::vector<std::uint32_t> place(bone.vertices.size() + cut.vertices.size(), 0);
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) place[v] = 1;
  for (std::size_t v = 0; v < place.size(); ++v) {
    if (place[v] == 0) continue;
    place[v] = static_cast<std::uint32_t>(out.vertices.size());
    out.vertices.push_back(v < bone.vertices.size() ? bone.vertices[v]
                                                    : cut.vertices[v - bone.vertices.size()]);
  }
  for (Triangle& t : triangles)
    for (std::uint32_t& v : t) v = place[v];
  out.triangles = std::move(triangles);
  return out;
}

double drilled_length(const TunnelPlan& plan, double depth_m) {
  double sum = 0;
  for (const TunnelPass& pass : plan.passes)
    sum += std::max(0.0, std::min(pass.exit_m, depth_m) - pass.entry_m);
  return sum;
}

}  // namespace osteon
