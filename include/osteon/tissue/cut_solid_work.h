#pragma once

#include <memory>
#include <vector>

#include "osteon/tissue/cut_cells.h"
#include "osteon/tissue/pressed_solid.h"

namespace osteon {

/// Makes the solid that cuts have left of a whole one, a little in each step, so that a physics
/// step can pay for it: a function of the whole solid and the cells alone, whatever the steps.
/// Parts of cells that do not hang together get corners of their own (virtual nodes; Molino, Bao,
/// Fedkiw 2004, ACM TOG 23:385), so a slit parts what it runs through, however thin it is. What
/// hangs on nothing is held by a weak ground: it has no use and gives no bad numbers.
class CutSolidWork {
 public:
  /// `cells`: as many as the whole solid has.
  CutSolidWork(std::shared_ptr<const PressedSolid> whole, const std::vector<CutCell>& cells);
  ~CutSolidWork();
  /// Less than about a millisecond of work. True: all is done, and take() has it.
  bool step();
  std::shared_ptr<const PressedSolid> take();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace osteon
