#include "osteon/mesh/stuffing.h"

#include <algorithm>
#include <array>
#include <string>
#include <unordered_map>

#include "tet/bcc_lattice.h"
#include "tet/lattice_cuts.h"

namespace osteon {
namespace {

using LatticeTet = std::array<std::uint32_t, 4>;

/// A corner of an element: a lattice point, or a crossing between an inside and an outside one.
struct Corner {
  std::uint32_t inside = 0;
  std::uint32_t outside = 0;  ///< the same as `inside`: the point itself
  std::uint64_t key() const { return std::uint64_t{inside} << 32 | outside; }
};

class Stuffer {
 public:
  Stuffer(const BccLattice& lattice, const LatticeCuts& cuts) : lattice_(lattice), cuts_(cuts) {}
  bool run(std::size_t most_tets);
  TetMesh mesh;

 private:
  void stuff(LatticeTet tet);
  void one_inside(const LatticeTet& tet);
  void two_inside(const LatticeTet& tet);
  void pyramid(const LatticeTet& tet);
  void three_inside(const LatticeTet& tet);
  void wedge(const std::array<Corner, 3>& low, const std::array<Corner, 3>& high,
             std::array<std::size_t, 3> order);

  Vec3 place(const Corner& c) const {
    return c.inside == c.outside ? cuts_.place(c.inside) : cuts_.place(c.inside, c.outside);
  }
  double distance2(const Corner& a, const Corner& b) const {
    return (place(a) - place(b)).squaredNorm();
  }
  bool diagonal_from_first(std::uint32_t a, std::uint32_t b, std::uint32_t outside) const;
  void emit(const Corner& a, const Corner& b, const Corner& c, const Corner& d);
  std::uint32_t vertex(const Corner& corner);

  const BccLattice& lattice_;
  const LatticeCuts& cuts_;
  std::unordered_map<std::uint64_t, std::uint32_t> vertex_at_;  ///< looked up, never walked
};

Corner point(std::uint32_t p) { return {p, p}; }

std::uint32_t Stuffer::vertex(const Corner& corner) {
  const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto [at, is_new] = vertex_at_.try_emplace(corner.key(), next);
  if (is_new) mesh.vertices.push_back(place(corner));
  return at->second;
}

void Stuffer::emit(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
  Tetrahedron tet{};
  const std::array<Corner, 4> corners{a, b, c, d};
  for (std::size_t k = 0; k < 4; ++k) tet[k] = vertex(corners[k]);
  mesh.tets.push_back(tet);
}

/// How the quadrilateral between two inside points and their crossings towards the same outside
/// point is split; known from the face alone, so that both its tetrahedra agree: from the point
/// whose crossed edge is short, else along the shorter diagonal.
bool Stuffer::diagonal_from_first(std::uint32_t a, std::uint32_t b, std::uint32_t outside) const {
  const bool a_long = lattice_.same_kind(a, outside);
  const bool b_long = lattice_.same_kind(b, outside);
  if (a_long != b_long) return b_long;
  const double from_a = distance2(point(a), {b, outside});
  const double from_b = distance2(point(b), {a, outside});
  return from_a != from_b ? from_a < from_b : a < b;
}

/// A prism in three tetrahedra. `low` runs counter-clockwise seen from `high`. The diagonal between
/// two of its sides starts low at the one that comes first in `order`.
void Stuffer::wedge(const std::array<Corner, 3>& low, const std::array<Corner, 3>& high,
                    std::array<std::size_t, 3> order) {
  const auto [p, q, r] = order;
  const bool even = (p + 1) % 3 == q;
  const auto add = [&](const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
    even ? emit(a, b, c, d) : emit(a, b, d, c);
  };
  add(low[p], low[q], low[r], high[r]);
  add(low[p], low[q], high[r], high[q]);
  add(low[p], high[p], high[q], high[r]);
}

void Stuffer::one_inside(const LatticeTet& tet) {
  std::array<Corner, 4> corners;
  for (std::size_t k = 0; k < 4; ++k)
    corners[k] =
        lattice_.side(tet[k]) == LatticeSide::kOutside ? Corner{tet[0], tet[k]} : point(tet[k]);
  emit(corners[0], corners[1], corners[2], corners[3]);
}

void Stuffer::pyramid(const LatticeTet& tet) {
  const auto [a, b, out, on] = tet;
  const Corner ca{a, out}, cb{b, out};
  if (diagonal_from_first(a, b, out)) {
    emit(point(a), point(b), cb, point(on));
    emit(point(a), cb, ca, point(on));
  } else {
    emit(point(a), point(b), ca, point(on));
    emit(point(b), cb, ca, point(on));
  }
}

void Stuffer::two_inside(const LatticeTet& tet) {
  const auto [a, b, c, d] = tet;
  const std::array<Corner, 3> low{point(a), Corner{a, c}, Corner{a, d}};
  const std::array<Corner, 3> high{point(b), Corner{b, c}, Corner{b, d}};
  const bool before_c = diagonal_from_first(a, b, c);
  const bool before_d = diagonal_from_first(a, b, d);
  if (before_c && !before_d) return wedge(low, high, {2, 0, 1});
  if (!before_c && before_d) return wedge(low, high, {1, 0, 2});
  const bool c_first = distance2(low[1], high[2]) <= distance2(low[2], high[1]);
  if (before_c)
    return wedge(
        low, high,
        c_first ? std::array<std::size_t, 3>{0, 1, 2} : std::array<std::size_t, 3>{0, 2, 1});
  wedge(low, high,
        c_first ? std::array<std::size_t, 3>{1, 2, 0} : std::array<std::size_t, 3>{2, 1, 0});
}

void Stuffer::three_inside(const LatticeTet& tet) {
  std::array<Corner, 3> low, high;
  std::array<std::size_t, 3> order{0, 1, 2};
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = point(tet[k]);
    high[k] = {tet[k], tet[3]};
  }
  // No circle of diagonals: those of the two faces with one long crossed edge end at that crossing.
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return i != j && diagonal_from_first(tet[i], tet[j], tet[3]);
  });
  wedge(low, high, order);
}

/// Sorts the corners inside, outside, on the surface by an even permutation, then cuts.
void Stuffer::stuff(LatticeTet tet) {
  const auto rank = [this](std::uint32_t p) {
    const LatticeSide side = lattice_.side(p);
    return side == LatticeSide::kInside ? 0 : side == LatticeSide::kOutside ? 1 : 2;
  };
  std::array<int, 3> count{};
  for (const std::uint32_t p : tet) ++count[static_cast<std::size_t>(rank(p))];
  if (count[0] == 0) return;
  bool odd = false;
  for (std::size_t end = 4; end > 1; --end)
    for (std::size_t k = 0; k + 1 < end; ++k)
      if (rank(tet[k]) > rank(tet[k + 1])) {
        std::swap(tet[k], tet[k + 1]);
        odd = !odd;
      }
  // Two corners of one rank may change places: four corners of three ranks have such a pair.
  for (std::size_t k = 0; odd && k < 3; ++k)
    if (rank(tet[k]) == rank(tet[k + 1])) {
      std::swap(tet[k], tet[k + 1]);
      odd = false;
    }
  if (count[1] == 0) return emit(point(tet[0]), point(tet[1]), point(tet[2]), point(tet[3]));
  if (count[0] == 1) return one_inside(tet);
  if (count[0] == 3) return three_inside(tet);
  return count[1] == 2 ? two_inside(tet) : pyramid(tet);
}

/// Each pair of cubes that share a face gives four tetrahedra around the line of their centres, one
/// an edge of the face. False when there are more than `most_tets`.
bool Stuffer::run(std::size_t most_tets) {
  const BccLattice& grid = lattice_;
  for (int z = 0; z + 1 < grid.size(2); ++z)
    for (int y = 0; y + 1 < grid.size(1); ++y)
      for (int x = 0; x + 1 < grid.size(0); ++x) {
        const std::uint32_t c = grid.center(x, y, z);
        const std::array<std::uint32_t, 3> next{grid.center(x + 1, y, z), grid.center(x, y + 1, z),
                                                grid.center(x, y, z + 1)};
        const std::uint32_t far = grid.corner(x + 1, y + 1, z + 1);
        const std::uint32_t px = grid.corner(x + 1, y, z), py = grid.corner(x, y + 1, z),
                            pz = grid.corner(x, y, z + 1);
        const std::uint32_t pxy = grid.corner(x + 1, y + 1, z), pyz = grid.corner(x, y + 1, z + 1),
                            pzx = grid.corner(x + 1, y, z + 1);
        // Around +x, +y and +z, counter-clockwise seen from there.
        const std::array<std::array<std::uint32_t, 4>, 3> rings{
            {{px, pxy, far, pzx}, {py, pyz, far, pxy}, {pz, pzx, far, pyz}}};
        for (std::size_t axis = 0; axis < 3; ++axis)
          for (std::size_t k = 0; k < 4; ++k)
            stuff({c, next[axis], rings[axis][k], rings[axis][(k + 1) % 4]});
        if (mesh.tets.size() > most_tets) return false;
      }
  return true;
}

}  // namespace

Result<TetMesh> stuff_isosurface(const ScalarField& field, const Aabb& box,
                                 const StuffingOptions& options) {
  auto lattice = BccLattice::sample(field, box, options);
  if (!lattice) return tl::unexpected(lattice.error());
  const LatticeCuts cuts(*lattice, field);
  Stuffer stuffer(*lattice, cuts);
  if (!stuffer.run(options.most_tets))
    return fail("more than " + std::to_string(options.most_tets) + " tetrahedra would be made",
                "tetrahedra", "Choose a larger cell");
  if (stuffer.mesh.tets.empty())
    return fail(
        "nothing remains after fitting the lattice to the surface: the part is thinner than a cell",
        "tetrahedra", "Choose a smaller cell");
  return std::move(stuffer.mesh);
}

}  // namespace osteon
