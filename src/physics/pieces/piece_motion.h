#pragma once

#include <cstdint>

#include "osteon/base/types.h"
#include "osteon/physics/fallen_pieces.h"
#include "pieces/piece_surroundings.h"

namespace osteon {

inline constexpr std::uint32_t kRestAfterSteps = 50;

/// What a step did to a piece.
struct PieceStep {
  bool touches = false, slow = false;
};

/// Moves a free piece by one step.
PieceStep move_piece(FallenPiece& piece, const PieceSurroundings& around, double step_s);
/// From a place to the nearest of the piece's points, m.
double nearest_point_m(const FallenPiece& piece, const Vec3& p_W);

}  // namespace osteon
