#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "osteon/carve/carved_field.h"
#include "osteon/tissue/cut_cells.h"
#include "osteon/tissue/pressed_solid.h"

namespace osteon {

/// Which nodes of a carved field are left in each cell of a solid, and how they are connected: a
/// function of the cuts alone. A look at a block that changed costs its cells alone.
class SolidCells {
 public:
  SolidCells(const CarvedField& field, const PressedSolid& whole);
  /// As blocks that changed after step `since` have left it.
  void update(const CarvedField& field, std::uint64_t since);
  /// As if nothing was known.
  void update_all(const CarvedField& field);
  const std::vector<CutCell>& cells() const { return cells_; }

 private:
  struct Range {
    std::array<int, 3> lo{}, hi{};  ///< nodes; hi is beyond
  };
  std::size_t node(int x, int y, int z) const;
  void take(const CarvedField& field, std::uint32_t block);
  void label(std::size_t cell);
  void link(std::size_t cell, int axis);
  void look_again();

  BlockGrid grid_;
  std::array<int, 3> n_{};
  std::vector<std::uint8_t> inside_, label_;  ///< of each node; label 255: left, not looked at yet
  std::vector<Range> ranges_;
  std::vector<std::array<std::int32_t, 3>> after_;  ///< cells beyond x+, y+, z+
  std::vector<std::uint32_t> whole_;                ///< nodes of each cell
  std::vector<std::uint8_t> touched_;
  std::vector<std::uint32_t> stack_;
  std::vector<CutCell> cells_;
};

}  // namespace osteon
