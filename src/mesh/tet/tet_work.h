#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "osteon/mesh/tet_mesh.h"

namespace osteon {

/// Least sine of the dihedral angles: 0.94 of a regular element, at most 0 of an inverted one.
double least_sine(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// A tetrahedral mesh while it is changed: which elements stand around each vertex, how good each
/// is, and which vertices lie on the boundary.
class TetWork {
 public:
  explicit TetWork(TetMesh mesh);
  /// Without the removed elements and the vertices that none names.
  TetMesh take();

  const Vec3& place(std::uint32_t v) const { return mesh_.vertices[v]; }
  const Tetrahedron& tet(std::uint32_t t) const { return mesh_.tets[t]; }
  bool alive(std::uint32_t t) const { return alive_[t] != 0; }
  double worth(std::uint32_t t) const { return worth_[t]; }
  bool on_boundary(std::uint32_t v) const { return on_boundary_[v] != 0; }
  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(on_boundary_.size()); }
  std::uint32_t tet_count() const { return static_cast<std::uint32_t>(alive_.size()); }
  /// The live elements around a vertex.
  const std::vector<std::uint32_t>& around(std::uint32_t v) const { return around_[v]; }
  double least_worth_around(std::uint32_t v) const;
  /// The same, were the vertex at `p`; stops early, at some value not above it, at or below
  /// `floor`.
  double least_worth_around(std::uint32_t v, const Vec3& p, double floor) const;
  double worth_of(const Tetrahedron& tet) const;

  void move(std::uint32_t v, const Vec3& p);
  void remove(std::uint32_t t);
  void add(const Tetrahedron& tet);
  /// The live elements that hold both vertices.
  std::vector<std::uint32_t> around_edge(std::uint32_t a, std::uint32_t b) const;
  /// The other element on a face, or kNone.
  std::uint32_t across(std::uint32_t t, std::size_t face) const;

  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

 private:
  TetMesh mesh_;
  std::vector<double> worth_;
  std::vector<std::uint8_t> alive_;
  std::vector<std::uint8_t> on_boundary_;
  std::vector<std::vector<std::uint32_t>> around_;
};

/// True when the element names the vertex.
bool names(const Tetrahedron& tet, std::uint32_t vertex);

}  // namespace osteon
