#pragma once

#include <cstdint>
#include <optional>

#include "osteon/hull/decompose.h"
#include "osteon/scene/piece_cache.h"

namespace osteon {

/// Key of a mesh cut with these options; changes with the algorithm's version.
std::uint64_t piece_key(const TriMesh& mesh, const DecomposeOptions& options = {});

/// Corners of the pieces; none when the mesh has no hull.
std::optional<PieceCorners> cut_into_pieces(const TriMesh& mesh,
                                            const DecomposeOptions& options = {});

}  // namespace osteon
