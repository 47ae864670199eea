#pragma once

#include <cstdint>
#include <optional>

#include "osteon/hull/decompose.h"
#include "osteon/scene/piece_cache.h"

namespace osteon {

/// Key of a mesh cut with these options; changes with the algorithm's version.
std::uint64_t piece_key(const TriMesh& mesh, const DecomposeOptions& options = {});

/// Corners of the pieces; none when the mesh has no hull. A bone longer than 250 mm is searched on
/// cells of a 300th of its length where those are the larger, and no bone on more than 32 million
/// cells.
std::optional<PieceCorners> cut_into_pieces(const TriMesh& mesh,
                                            const DecomposeOptions& options = {});

}  // namespace osteon
