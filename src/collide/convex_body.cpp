#include "osteon/collide/convex_body.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "block_scan.h"
#include "osteon/base/hash.h"
#include "simplex.h"

namespace osteon {
namespace {

constexpr std::size_t kBlock = ConvexBody::kBlock;

// By plain numbers and each distance once: every case that is opened comes here thousands of times.
Vec3 farthest_from(const Vec3& center, const std::vector<Vec3>& points) {
  const double cx = center.x(), cy = center.y(), cz = center.z();
  double most = -1;
  const double* farthest = points.front().data();
  for (const Vec3& p : points) {
    const double* at = p.data();
    const double x = at[0] - cx, y = at[1] - cy, z = at[2] - cz;
    const double distance2 = x * x + y * y + z * z;
    if (!(distance2 > most)) continue;
    most = distance2;
    farthest = at;
  }
  return Vec3(farthest[0], farthest[1], farthest[2]);
}

// Badoiu and Clarkson 2003: step towards the farthest point by 1 / (i + 1). The centre is a mean of
// vertices, hence inside the body.
void bound_by_sphere(ConvexBody& body, const std::vector<Vec3>& points) {
  constexpr int kSteps = 300;
  Vec3 center = points.front();
  for (int i = 1; i <= kSteps; ++i) center += (farthest_from(center, points) - center) / (i + 1);
  body.center = center;
  body.radius = (farthest_from(center, points) - center).norm() * (1 + 1e-12);
}

using Key = std::array<double, 6>;

// Splits [first, last) of `order` across its widest key until runs remain: at a multiple of kGroup,
// then of kBlock.
void order_into_runs(const std::vector<Key>& keys, std::vector<std::uint32_t>& order,
                     std::size_t first, std::size_t last) {
  if (last - first <= kBlock) return;
  std::size_t axis = 0;
  double widest = -1;
  for (std::size_t j = 0; j < Key{}.size(); ++j) {
    double lo = keys[order[first]][j], hi = lo;
    for (std::size_t i = first; i < last; ++i) {
      lo = std::min(lo, keys[order[i]][j]);
      hi = std::max(hi, keys[order[i]][j]);
    }
    if (hi - lo > widest) {
      widest = hi - lo;
      axis = j;
    }
  }
  const auto begin = order.begin();
  std::sort(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(last),
            [&](std::uint32_t a, std::uint32_t b) {
              return keys[a][axis] != keys[b][axis] ? keys[a][axis] < keys[b][axis] : a < b;
            });
  const std::size_t step = last - first > ConvexBody::kGroup ? ConvexBody::kGroup : kBlock;
  const std::size_t half = ((last - first) / 2 + step - 1) / step * step;
  order_into_runs(keys, order, first, first + half);
  order_into_runs(keys, order, first + half, last);
}

std::vector<std::uint32_t> run_order(const std::vector<Key>& keys) {
  std::vector<std::uint32_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0u);
  order_into_runs(keys, order, 0, order.size());
  return order;
}

std::size_t padded(std::size_t count) { return (count + kBlock - 1) / kBlock * kBlock; }

// A point on each plane's facet: the mean of its triangles' corners.
std::vector<Vec3> facet_points(const Hull& hull) {
  std::vector<Vec3> sum(hull.planes.size(), Vec3::Zero());
  std::vector<double> corners(hull.planes.size(), 0.0);
  for (std::size_t i = 0; i < hull.triangles.size() && i < hull.plane_of.size(); ++i) {
    for (const std::uint32_t v : hull.triangles[i]) sum[hull.plane_of[i]] += hull.vertices[v];
    corners[hull.plane_of[i]] += 3;
  }
  for (std::size_t i = 0; i < sum.size(); ++i)
    sum[i] = corners[i] > 0 ? Vec3(sum[i] / corners[i]) : Vec3(hull.planes[i].n * hull.planes[i].d);
  return sum;
}

void add_vertices(ConvexBody& body, const Hull& hull) {
  std::vector<Key> keys;
  for (const Vec3& v : hull.vertices) keys.push_back({v.x(), v.y(), v.z(), 0, 0, 0});
  body.vertex_source = run_order(keys);
  body.vertex_count = static_cast<std::uint32_t>(hull.vertices.size());
  for (std::size_t i = 0; i < padded(keys.size()); ++i) {
    const Vec3& v = hull.vertices[body.vertex_source[std::min(i, keys.size() - 1)]];
    body.vx.push_back(v.x());
    body.vy.push_back(v.y());
    body.vz.push_back(v.z());
  }
  for (const Vec3& v : hull.vertices) body.box.include(v);
}

// Planes whose facets lie near and look alike share a run.
std::vector<Vec3> add_planes(ConvexBody& body, const Hull& hull) {
  const std::vector<Vec3> points = facet_points(hull);
  std::vector<Key> keys;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = (points[i] - body.center) / body.radius;
    const Vec3& n = hull.planes[i].n;
    keys.push_back({p.x(), p.y(), p.z(), n.x(), n.y(), n.z()});
  }
  body.plane_source = run_order(keys);
  body.plane_count = static_cast<std::uint32_t>(keys.size());
  std::vector<Vec3> ordered;
  for (const std::uint32_t i : body.plane_source) ordered.push_back(points[i]);
  for (std::size_t i = 0; i < padded(keys.size()); ++i) {
    const Plane& plane = hull.planes[body.plane_source[std::min(i, keys.size() - 1)]];
    body.nx.push_back(plane.n.x());
    body.ny.push_back(plane.n.y());
    body.nz.push_back(plane.n.z());
    body.d.push_back(plane.d);
    body.offset.push_back(plane.d - plane.n.dot(body.center));
  }
  return ordered;
}

// One body's planes and a few far ones, from which a first basis is surely feasible. Far planes
// cannot stay: no point of the body reaches them.
class BodyRows {
 public:
  BodyRows(const ConvexBody& body, std::span<const Vec3> far_normals)
      : body_(body), far_normals_(far_normals) {}

  double scale() const { return body_.radius; }
  Row row(std::uint32_t id) const {
    if (id < body_.plane_count) return {body_.normal(id), body_.offset[id]};
    return {far_normals_[id - body_.plane_count], 4 * body_.radius};
  }
  template <std::size_t N>
  Excess most_exceeded(const Vec3& x, double floor, const std::array<std::uint32_t, N>&) const {
    return beyond_far(x, osteon::most_exceeded(body_, x, floor));
  }
  Excess first_exceeded(const Vec3& x, double floor) const {
    const Excess found = osteon::first_exceeded(body_, x, floor);
    return found.plane == Excess::kNone ? beyond_far(x, found) : found;
  }

 private:
  Excess beyond_far(const Vec3& x, Excess best) const {
    for (std::uint32_t k = 0; k < far_normals_.size(); ++k) {
      const double value = far_normals_[k].dot(x) - 4 * body_.radius;
      if (value > best.value) best = {value, body_.plane_count + k};
    }
    return best;
  }

  const ConvexBody& body_;
  std::span<const Vec3> far_normals_;
};

template <class Basis>
std::array<std::uint32_t, Basis::kRows> first_basis(const ConvexBody& body,
                                                    std::span<const Vec3> far_normals) {
  const BodyRows rows(body, far_normals);
  std::array<std::uint32_t, Basis::kRows> ids;
  std::iota(ids.begin(), ids.end(), body.plane_count);
  Basis basis;
  const bool loaded = load_basis(basis, rows, ids);
  assert(loaded && dual_feasible(basis));
  if (!loaded) return ids;  // never: the far planes part their corners
  basis.solve();
  [[maybe_unused]] const SimplexEnd end = run_simplex(basis, rows, 0, 4000);
  assert(end.status == LpStatus::kOptimal);
  return basis.ids;
}

std::uint64_t stamp_of(const ConvexBody& body) {
  Hasher h;
  for (const auto* numbers :
       {&body.nx, &body.ny, &body.nz, &body.offset, &body.vx, &body.vy, &body.vz})
    h.bytes(numbers->data(), numbers->size() * sizeof(double));
  return h.value() | 1;
}

}  // namespace

ConvexBody make_convex_body(const Hull& hull) {
  assert(hull.vertices.size() >= 4 && hull.planes.size() >= 4);
  ConvexBody body;
  bound_by_sphere(body, hull.vertices);
  add_vertices(body, hull);
  make_blocks(body, add_planes(body, hull));
  body.stamp = stamp_of(body);
  const double s = std::sqrt(1.0 / 3.0);
  const std::array<Vec3, 4> tetrahedron = {Vec3(s, s, s), Vec3(s, -s, -s), Vec3(-s, s, -s),
                                           Vec3(-s, -s, s)};
  const std::array<Vec3, 3> axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  body.basis = first_basis<DepthBasis>(body, tetrahedron);
  body.corner = first_basis<CornerBasis>(body, axes);
  return body;
}

}  // namespace osteon
