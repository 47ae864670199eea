#include "osteon/scene/bone_pieces.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "case/mesh_hash.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

// Counts up with every change of the algorithm that changes its pieces.
constexpr std::uint32_t kPiecesVersion = 2;
constexpr double kLeastLength = 1e-6;  // m; below this nothing is a bone
// A long bone is searched on coarser cells: their count grows with the cube of its length.
constexpr double kLong = 0.25;  // m
constexpr double kCellsAlong = 300;

// Bounds the search's memory: a node takes 8 bytes.
constexpr double kMostCells = 3.2e7;

double length_of(const TriMesh& mesh) { return bounds(mesh).extent().maxCoeff(); }

DecomposeOptions search_for(const TriMesh& mesh, DecomposeOptions options) {
  const double length_m = length_of(mesh);
  if (length_m > kLong)
    options.search_cell_m = std::max(options.search_cell_m, length_m / kCellsAlong);
  const double room_m3 = bounds(mesh).extent().prod();
  options.search_cell_m = std::max(options.search_cell_m, std::cbrt(room_m3 / kMostCells));
  return options;
}

}  // namespace

std::uint64_t piece_key(const TriMesh& mesh, const DecomposeOptions& options) {
  Hasher hasher;
  hasher.add(kPiecesVersion);
  hasher.add(options.concavity_m);
  hasher.add(static_cast<std::uint64_t>(options.max_pieces));
  hasher.add(search_for(mesh, options).search_cell_m);
  add_mesh(hasher, mesh);
  return hasher.value();
}

std::optional<PieceCorners> cut_into_pieces(const TriMesh& mesh, const DecomposeOptions& options) {
  const double length_m = length_of(mesh);
  if (!(length_m > kLeastLength)) {
    // Too small for the search's grid to mean anything.
    HullOutcome outcome = build_hull(mesh.vertices);
    if (!outcome.hull) return std::nullopt;
    return PieceCorners{{std::move(outcome.hull->vertices)}, 0, false};
  }
  auto found = decompose(mesh, search_for(mesh, options));
  if (!found) return std::nullopt;
  PieceCorners corners;
  corners.concavity_m = found->concavity_m;
  corners.coarser = found->coarser;
  for (Hull& piece : found->pieces) corners.pieces.push_back(std::move(piece.vertices));
  return corners;
}

}  // namespace osteon
