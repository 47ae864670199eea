#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// So many crossings are listed where nobody asks for another number.
constexpr std::size_t kListedCrossings = 1000;

/// Pairs of triangles of one mesh that pass through each other, each with the lower index first, in
/// order; at most `most` of them. Triangles that share a corner count when they meet elsewhere too;
/// two on one edge count when they are folded flat onto each other. Touching is not crossing.
/// Decided in double precision: a crossing shallower than about 1e-12 of the triangles' size may
/// be missed.
std::vector<std::pair<std::uint32_t, std::uint32_t>> self_crossings(
    const TriMesh& mesh, std::size_t most = kListedCrossings);

/// The same, of the pairs of which one at least is marked: what moving those can have made.
std::vector<std::pair<std::uint32_t, std::uint32_t>> self_crossings(
    const TriMesh& mesh, const std::vector<bool>& marked, std::size_t most = kListedCrossings);

/// A pair of triangles that pass through each other and belong to parts that no edge or corner
/// joins, the lower index first: such parts overlap, so the mesh bounds no single solid. None only
/// where no such pair is: how often parts cross themselves does not matter.
std::optional<std::pair<std::uint32_t, std::uint32_t>> crossing_parts(const TriMesh& mesh);

}  // namespace osteon
