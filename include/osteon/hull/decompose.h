#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "osteon/hull/hull.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

struct DecomposeOptions {
  double concavity_m = 0.00025;   ///< wanted: no piece stands higher over the mesh
  std::size_t max_pieces = 64;    ///< at least 1
  double search_cell_m = 0.0005;  ///< detail at which cuts are looked for; pieces are always exact
  /// Bounds the time for any mesh, in questions for a height (about 50 ns each): when it is spent,
  /// what has been cut is the result. Bones of a hand take a thirtieth of it.
  std::uint64_t most_work = 2'000'000'000;
  /// Asked between cuts; true stops with what has been cut. May be empty.
  std::function<bool()> stop = {};
};

struct Decomposition {
  /// Their union holds the mesh's inside and surface. Each is build_hull of its own vertices.
  std::vector<Hull> pieces;
  /// How far the pieces stand over the mesh at most, m. Below the wanted concavity only known not
  /// to be above it; else good to 0.02 mm or a twentieth.
  double concavity_m = 0;
  bool coarser = false;  ///< the work was spent before the wanted concavity or count was reached
};

/// Whether a mesh has an inside that can be cut into pieces: it is closed.
bool can_decompose(const TriMesh& mesh);

/// Convex pieces whose union follows a closed, outward mesh: approximate convex decomposition by
/// planes through the deepest concave place, the worst piece first, and merging of what needs no
/// cut. After Lien and Amato, "Approximate convex decomposition of polyhedra" (2007) for the cut at
/// the deepest notch, and Wei et al., "CoACD" (SIGGRAPH 2022) for concavity measured from the
/// hull's boundary and for the merge. More is cut than is allowed and merged back. The ends of a
/// long bone (JointEnds), where its joints are, come first: while pieces are short, its shaft may
/// stand four times as high over the mesh. Pieces are exact hulls of the mesh's surface clipped by
/// the planes: neighbours share the points of their cut. Deterministic: the same mesh and options
/// give the same bytes on every compiler. Empty when the mesh has no hull (see build_hull). A mesh
/// that is not closed gives one piece, its hull, with a concavity of zero, since it has no inside
/// to measure from.
std::optional<Decomposition> decompose(const TriMesh& mesh, const DecomposeOptions& options = {});

}  // namespace osteon
