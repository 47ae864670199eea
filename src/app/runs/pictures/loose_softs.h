#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "osteon/scene/soft_pushes.h"
#include "runs/pictures/carved_picture.h"

namespace osteon {

/// Pieces of soft parts that were cut off, for who draws them. Knows no picture.
class LooseSofts {
 public:
  /// Those that lie loose now and were not given before; for Renderer::set_loose and its like.
  std::vector<CarvedPicture::Piece> new_pieces(const SoftPushes& pushes);

 private:
  std::set<std::uint64_t> given_;  ///< by hash
};

}  // namespace osteon
