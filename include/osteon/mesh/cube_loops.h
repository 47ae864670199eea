#pragma once

#include <array>
#include <cstdint>
#include <utility>

namespace osteon {

// The cube of dual marching cubes. Corner c lies at (c & 1, c >> 1 & 1, c >> 2). Edge e runs along
// axis e / 4 at offset (e & 1) along the next axis and (e >> 1 & 1) along the one after. Face f is
// the lower (f even) or upper (f odd) one across axis f / 2.

/// The closed loops in which the surface crosses a cube's edges.
struct CubeLoops {
  std::array<std::int8_t, 12> of_edge;  ///< loop of each edge, -1 where the surface does not cross
  int count = 0;
};

/// Loops of a cube whose corners in the bit set `inside` are inside. On a face with two inside
/// corners at opposite ends the surface parts them, or joins them where bit f of `joined_faces` is
/// set.
CubeLoops cube_loops(std::uint8_t inside, std::uint8_t joined_faces);

bool face_is_ambiguous(std::uint8_t inside, int face);

/// Whether all crossed edges of an ambiguous face belong to one loop.
bool one_loop_takes_face(const CubeLoops& loops, int face);

std::pair<int, int> cube_edge_corners(int edge);

}  // namespace osteon
