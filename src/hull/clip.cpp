#include "clip.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace osteon::hull {
namespace {

constexpr std::uint32_t kNotCopied = 0xffffffffu;

struct Crossing {
  std::uint32_t low, high;  // ends of the edge, low < high
  bool operator<(const Crossing& o) const { return low != o.low ? low < o.low : high < o.high; }
  bool operator==(const Crossing&) const = default;
};

// A surface with its heights over the plane and the edges that cross it.
class Cut {
 public:
  Cut(const TriMesh& surface, const Plane& plane) : surface_(surface) {
    for (const Vec3& p : surface.vertices) height_.push_back(plane.signed_distance(p));
    for (const Triangle& t : surface.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        if (crosses(a, b)) crossings_.push_back({std::min(a, b), std::max(a, b)});
      }
    std::sort(crossings_.begin(), crossings_.end());
    crossings_.erase(std::unique(crossings_.begin(), crossings_.end()), crossings_.end());
  }

  // The part on one side: `sign` -1 below, +1 above.
  TriMesh side(double sign) const {
    Part part{{},
              std::vector<std::uint32_t>(surface_.vertices.size(), kNotCopied),
              std::vector<std::uint32_t>(crossings_.size(), kNotCopied)};
    for (const Triangle& t : surface_.triangles) add(t, sign, part);
    return std::move(part.mesh);
  }

 private:
  struct Part {
    TriMesh mesh;
    std::vector<std::uint32_t> of_vertex;
    std::vector<std::uint32_t> of_crossing;
  };

  bool crosses(std::uint32_t a, std::uint32_t b) const {
    return (height_[a] < 0 && height_[b] > 0) || (height_[a] > 0 && height_[b] < 0);
  }

  void add(const Triangle& t, double sign, Part& part) const {
    bool strictly = false;
    for (const std::uint32_t v : t) strictly |= sign * height_[v] > 0;
    if (!strictly) return;
    std::array<std::uint32_t, 4> corners{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (sign * height_[a] >= 0) corners[count++] = vertex(a, part);
      if (crosses(a, b)) corners[count++] = crossing(a, b, part);
    }
    for (std::size_t k = 2; k < count; ++k)
      part.mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
  }

  std::uint32_t vertex(std::uint32_t v, Part& part) const {
    return number(part.of_vertex[v], surface_.vertices[v], part);
  }

  std::uint32_t crossing(std::uint32_t a, std::uint32_t b, Part& part) const {
    const Crossing edge{std::min(a, b), std::max(a, b)};
    const auto at = std::lower_bound(crossings_.begin(), crossings_.end(), edge);
    const double low = height_[edge.low], high = height_[edge.high];
    const Vec3& p = surface_.vertices[edge.low];
    const Vec3& q = surface_.vertices[edge.high];
    return number(part.of_crossing[static_cast<std::size_t>(at - crossings_.begin())],
                  p + (low / (low - high)) * (q - p), part);
  }

  static std::uint32_t number(std::uint32_t& known, const Vec3& p, Part& part) {
    if (known != kNotCopied) return known;
    known = static_cast<std::uint32_t>(part.mesh.vertices.size());
    part.mesh.vertices.push_back(p);
    return known;
  }

  const TriMesh& surface_;
  std::vector<double> height_;
  std::vector<Crossing> crossings_;
};

}  // namespace

std::pair<TriMesh, TriMesh> clip(const TriMesh& surface, const Plane& plane) {
  const Cut cut(surface, plane);
  TriMesh below = cut.side(-1);
  TriMesh above = cut.side(1);
  return {std::move(below), std::move(above)};
}

}  // namespace osteon::hull
