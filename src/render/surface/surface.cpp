#include "surface/surface.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace osteon {
namespace {

bool comes_before(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

constexpr std::uint32_t kNone = 0xffffffffu;

/// Index of each vertex among the distinct finite ones (in the order of their first use); kNone for
/// a vertex that is not finite.
std::vector<std::uint32_t> weld(const std::vector<Vec3>& vertices, std::vector<Vec3>& points) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t k = 0; k < vertices.size(); ++k)
    if (is_finite(vertices[k])) order.push_back(k);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (comes_before(vertices[a], vertices[b])) return true;
    if (comes_before(vertices[b], vertices[a])) return false;
    return a < b;
  });
  std::vector<std::uint32_t> lead(vertices.size(), kNone);  // first vertex at the same place
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && vertices[order[k]] == vertices[order[k - 1]];
    lead[order[k]] = same ? lead[order[k - 1]] : order[k];
  }
  std::vector<std::uint32_t> index(vertices.size(), kNone);
  for (std::uint32_t k = 0; k < vertices.size(); ++k) {
    if (lead[k] == kNone) continue;
    if (lead[k] == k) {
      index[k] = static_cast<std::uint32_t>(points.size());
      points.push_back(vertices[k]);
    }
    index[k] = index[lead[k]];
  }
  return index;
}

double angle_between(const Vec3& u, const Vec3& v) {
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

std::vector<Vec3> angle_weighted_normals(const Surface& s) {
  std::vector<Vec3> normals(s.points.size(), Vec3::Zero());
  for (const Triangle& t : s.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Vec3& p = s.points[t[k]];
      const Vec3 u = s.points[t[(k + 1) % 3]] - p;
      const Vec3 v = s.points[t[(k + 2) % 3]] - p;
      const Vec3 n = u.cross(v);
      const double length = n.norm();
      if (length > 0) normals[t[k]] += n * (angle_between(u, v) / length);
    }
  }
  for (Vec3& n : normals) {
    const double length = n.norm();
    n = length > 0 ? Vec3(n / length) : Vec3::UnitZ();
  }
  return normals;
}

void link_neighbours(Surface& s) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> links;
  links.reserve(s.triangles.size() * 6);
  for (const Triangle& t : s.triangles) {
    for (int k = 0; k < 3; ++k) {
      links.emplace_back(t[k], t[(k + 1) % 3]);
      links.emplace_back(t[(k + 1) % 3], t[k]);
    }
  }
  std::sort(links.begin(), links.end());
  links.erase(std::unique(links.begin(), links.end()), links.end());
  s.first.assign(s.points.size() + 1, 0);
  s.neighbours.reserve(links.size());
  for (const auto& [from, to] : links) {
    ++s.first[from + 1];
    s.neighbours.push_back(to);
  }
  std::partial_sum(s.first.begin(), s.first.end(), s.first.begin());
}

}  // namespace

Surface welded(const TriMesh& mesh, std::vector<std::uint32_t>* place) {
  Surface s;
  const std::vector<std::uint32_t> index = weld(mesh.vertices, s.points);
  if (place) *place = index;
  for (const Triangle& t : mesh.triangles) {
    if (std::max({t[0], t[1], t[2]}) >= index.size()) continue;
    const Triangle w{index[t[0]], index[t[1]], index[t[2]]};
    if (w[0] == kNone || w[1] == kNone || w[2] == kNone) continue;
    if (w[0] == w[1] || w[1] == w[2] || w[2] == w[0]) continue;
    s.triangles.push_back(w);
  }
  return s;
}

Surface make_surface(const TriMesh& mesh, std::vector<std::uint32_t>* place) {
  Surface s = welded(mesh, place);
  s.normals = angle_weighted_normals(s);
  link_neighbours(s);
  return s;
}

void make_normals(Surface& surface) { surface.normals = angle_weighted_normals(surface); }

bool encloses_volume(const Surface& s) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> there, back;
  double six_volumes = 0;
  for (const Triangle& t : s.triangles) {
    six_volumes += s.points[t[0]].dot(s.points[t[1]].cross(s.points[t[2]]));
    for (std::size_t k = 0; k < 3; ++k) {
      there.emplace_back(t[k], t[(k + 1) % 3]);
      back.emplace_back(t[(k + 1) % 3], t[k]);
    }
  }
  std::sort(there.begin(), there.end());
  std::sort(back.begin(), back.end());
  const bool once = std::adjacent_find(there.begin(), there.end()) == there.end();
  return once && there == back && six_volumes > 0;
}

void smooth(const Surface& surface, int passes, std::vector<float>& values) {
  std::vector<float> next(values.size());
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      float sum = values[k];
      for (std::uint32_t e = surface.first[k]; e < surface.first[k + 1]; ++e)
        sum += values[surface.neighbours[e]];
      next[k] = sum / static_cast<float>(surface.first[k + 1] - surface.first[k] + 1);
    }
    values.swap(next);
  }
}

std::vector<float> mean_curvature(const Surface& s) {
  std::vector<float> out(s.points.size(), 0.0f);
  for (std::size_t k = 0; k < s.points.size(); ++k) {
    const std::uint32_t begin = s.first[k], end = s.first[k + 1];
    double sum = 0;
    for (std::uint32_t e = begin; e < end; ++e) {
      const Vec3 d = s.points[s.neighbours[e]] - s.points[k];
      sum -= 2 * s.normals[k].dot(d) / d.squaredNorm();
    }
    if (end > begin) out[k] = static_cast<float>(sum / (end - begin));
  }
  return out;
}

}  // namespace osteon
