#include "osteon/mesh/hollows.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "osteon/mesh/isosurface.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/repair.h"
#include "repair/clean.h"
#include "repair/edges.h"
#include "repair/weld.h"
#include "surface/ball_rooms.h"

namespace osteon {
namespace {

/// The solid with its hollows walled up, as a field: the height over the surface but in a hollow
/// and at its openings, where it is what a ball outside leaves between itself and the place.
class WalledUp {
 public:
  WalledUp(const MeshDistance& surface, const BallRooms& rooms) : surface_(surface), rooms_(rooms) {
    std::vector<Node> open;
    for (std::int64_t z = 0; z < rooms.size()[2]; ++z)
      for (std::int64_t y = 0; y < rooms.size()[1]; ++y)
        for (std::int64_t x = 0; x < rooms.size()[0]; ++x)
          if (rooms.room({x, y, z}) > BallRooms::kOutside) add({x, y, z}, -deepest(), open);
    while (!open.empty()) {
      const Node at = open.back();
      open.pop_back();
      look_beside(at, open);
    }
  }

  double at(const Vec3& p) const {
    const Node cell = rooms_.cell_of(p);
    bool known = false;
    for (int k = 0; k < 8 && !known; ++k) known = heights_.count(rooms_.index(corner(cell, k))) > 0;
    if (!known) return surface_.closest(p).signed_distance;
    const Vec3 f = (p - rooms_.place(cell)) / rooms_.cell();
    double sum = 0;
    for (int k = 0; k < 8; ++k)
      sum += (k & 1 ? f.x() : 1 - f.x()) * (k & 2 ? f.y() : 1 - f.y()) *
             (k & 4 ? f.z() : 1 - f.z()) * height(corner(cell, k));
    return sum;
  }

 private:
  using Node = BallRooms::Node;

  double deepest() const { return 2 * rooms_.cell(); }
  /// How far from a ball's middle its surface counts as reached: the lattice rounds the middle.
  double reach() const { return rooms_.radius() + rooms_.cell(); }
  static Node corner(const Node& cell, int k) {
    return {cell[0] + (k & 1), cell[1] + ((k >> 1) & 1), cell[2] + (k >> 2)};
  }

  double height(const Node& node) const {
    const auto known = heights_.find(rooms_.index(node));
    return known != heights_.end() ? known->second
                                   : surface_.closest(rooms_.place(node)).signed_distance;
  }

  void add(const Node& node, double height, std::vector<Node>& open) {
    if (heights_.emplace(rooms_.index(node), height).second && height < 0) open.push_back(node);
  }

  /// What is open to a hollow's node and out of the ball's reach is of the hollow too.
  void look_beside(const Node& at, std::vector<Node>& open) {
    for (std::size_t k = 0; k < 3; ++k)
      for (const std::int64_t step : {-1, 1}) {
        Node next = at;
        next[k] += step;
        if (!rooms_.holds(next) || heights_.count(rooms_.index(next)) > 0) continue;
        const double over = surface_.closest(rooms_.place(next)).signed_distance;
        if (over <= 0) continue;
        const double left = reach() - rooms_.to_outside(next, reach() + deepest());
        add(next, std::clamp(left, -deepest(), over), open);
      }
  }

  const MeshDistance& surface_;
  const BallRooms& rooms_;
  std::map<std::size_t, double> heights_;  // by the node's index
};

/// Drops the parts that bound room inside others: of a solid they are cavities. Returns how many
/// there were. Where `of_one_solid`, it drops none beside several solids: one of them may lie in a
/// cavity of another.
std::size_t drop_cavities(TriMesh& mesh, bool of_one_solid) {
  const auto part_of = triangle_components(mesh.triangles, edge_uses(mesh.triangles));
  std::vector<double> volume(mesh.triangles.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& v = mesh.triangles[t];
    volume[part_of[t]] += mesh.vertices[v[0]].dot(mesh.vertices[v[1]].cross(mesh.vertices[v[2]]));
  }
  const auto count = static_cast<std::size_t>(
      std::count_if(volume.begin(), volume.end(), [](double v) { return v < 0; }));
  const auto solids = std::count_if(volume.begin(), volume.end(), [](double v) { return v > 0; });
  if (count == 0 || (of_one_solid && solids > 1)) return 0;
  std::vector<char> cavity;
  for (const std::uint32_t part : part_of) cavity.push_back(volume[part] < 0);
  erase_marked(mesh, cavity);
  drop_unused_vertices(mesh);
  return count;
}

/// What a file keeps of it: vertices that lie on each other become one.
bool stays_closed_in_a_file(TriMesh mesh) {
  weld_vertices(mesh, RepairOptions{}.weld_distance_m);
  std::erase_if(mesh.triangles,
                [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  return topology(mesh).closed();
}

}  // namespace

std::size_t fill_hollows(TriMesh& mesh, double ball_radius_m) {
  if (mesh.triangles.empty() || !topology(mesh).closed()) return 0;
  const std::size_t cavities = drop_cavities(mesh, true);
  const MeshDistance surface(mesh);
  const BallRooms rooms(surface, ball_radius_m);
  if (rooms.hollows() == 0) return cavities;
  const WalledUp solid(surface, rooms);
  IsosurfaceOptions options;
  options.cell_m = rooms.cell();
  options.slack_m = rooms.radius() + 2 * rooms.cell();
  options.uncrossed = true;
  auto made = isosurface([&](const Vec3& p) { return solid.at(p); },
                         bounds(mesh).grown(3 * rooms.cell()), options);
  if (!made) return cavities;
  drop_cavities(*made, false);
  if (!stays_closed_in_a_file(*made)) return cavities;
  mesh = std::move(*made);
  return cavities + rooms.hollows();
}

}  // namespace osteon
