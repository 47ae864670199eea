#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "osteon/physics/soft_shape.h"
#include "runs/pictures/carved_picture.h"
#include "runs/pictures/loose_softs.h"

namespace osteon {

/// How soft parts look from a picture of a film on: what differs from the picture before.
struct SoftLooks {
  std::vector<SoftShapes::Changed> surfaces;
  std::vector<CarvedPicture::Piece> pieces;  ///< that were cut off
};

/// Works out how soft parts look under what a recorded session did to them. Knows no picture.
class FilmSofts {
 public:
  /// `setup` null: nothing is soft.
  FilmSofts(const Case& the_case, std::shared_ptr<const SoftSetup> setup)
      : shapes_(the_case, std::move(setup)) {}

  /// Since it was last asked; at first all are at rest.
  SoftLooks looks(const SoftPushes& pushes) {
    return {shapes_.changes(pushes), loose_.new_pieces(pushes)};
  }

 private:
  SoftShapes shapes_;
  LooseSofts loose_;
};

}  // namespace osteon
