#include "surface/surface.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

namespace osteon {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

/// Points by where they are.
class PointTable {
 public:
  PointTable(const std::vector<Vec3>& points, std::size_t most) : points_(points) {
    std::size_t size = 16;
    while (size < 2 * most) size *= 2;
    slots_.assign(size, kNone);
  }
  /// The index of the one at `p`; kNone: `p` is taken for the next that `points` gets.
  std::uint32_t find_or_add(const Vec3& p) {
    // A table is never more than half full, so there is an empty slot to stop at.
    for (std::size_t slot = hash(p);; ++slot) {
      std::uint32_t& here = slots_[slot & (slots_.size() - 1)];
      if (here == kNone) {
        here = static_cast<std::uint32_t>(points_.size());
        return kNone;
      }
      if (points_[here] == p) return here;
    }
  }

 private:
  static std::size_t hash(const Vec3& p) {
    std::uint64_t mixed = 0;
    for (const double value : {p.x(), p.y(), p.z()}) {
      mixed ^= std::bit_cast<std::uint64_t>(value + 0.0);  // -0 and 0 are one place
      mixed *= 0x9e3779b97f4a7c15u;
      mixed ^= mixed >> 32;
    }
    return static_cast<std::size_t>(mixed);
  }
  const std::vector<Vec3>& points_;
  std::vector<std::uint32_t> slots_;
};

/// Index of each vertex among the distinct finite ones (in the order of their first use); kNone for
/// a vertex that is not finite.
std::vector<std::uint32_t> weld(const std::vector<Vec3>& vertices, std::vector<Vec3>& points) {
  std::vector<std::uint32_t> index(vertices.size(), kNone);
  points.reserve(vertices.size());
  PointTable table(points, vertices.size());
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    if (!is_finite(vertices[k])) continue;
    index[k] = table.find_or_add(vertices[k]);
    if (index[k] != kNone) continue;
    index[k] = static_cast<std::uint32_t>(points.size());
    points.push_back(vertices[k]);
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

// A triangle has one edge into each of its points and one out of it, so as many run in as out. The
// edges are put by their point, where few stand: what one sort of all would find, in linear time.
bool encloses_volume(const Surface& s) {
  std::vector<std::uint32_t> first(s.points.size() + 1, 0);
  double six_volumes = 0;
  for (const Triangle& t : s.triangles) {
    six_volumes += s.points[t[0]].dot(s.points[t[1]].cross(s.points[t[2]]));
    for (const std::uint32_t v : t) ++first[v + 1];
  }
  if (!(six_volumes > 0)) return false;
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::uint32_t> to(first.back()), from(first.back());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (const Triangle& t : s.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t at = next[t[k]]++;
      to[at] = t[(k + 1) % 3];
      from[at] = t[(k + 2) % 3];
    }
  for (std::size_t v = 0; v < s.points.size(); ++v) {
    const auto out_begin = to.begin() + first[v], out_end = to.begin() + first[v + 1];
    const auto in_begin = from.begin() + first[v], in_end = from.begin() + first[v + 1];
    std::sort(out_begin, out_end);
    std::sort(in_begin, in_end);
    if (std::adjacent_find(out_begin, out_end) != out_end) return false;
    if (!std::equal(out_begin, out_end, in_begin)) return false;
  }
  return true;
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
