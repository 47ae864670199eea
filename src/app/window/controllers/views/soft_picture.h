#pragma once

#include <memory>
#include <optional>

#include "osteon/physics/soft_shape.h"
#include "osteon/render/renderer.h"
#include "runs/pictures/loose_softs.h"

namespace osteon {

/// The window's renderer shows what gives way as it is pressed now. Needs the window's context.
class SoftPicture {
 public:
  /// Once a picture. `setup` may be null: nothing is soft. Parts of another setup, or of another
  /// case, that were pressed go back to rest. A processor that draws gets other shapes at most ten
  /// times a second, since each costs a whole picture.
  void show(const std::shared_ptr<const Case>& the_case,
            const std::shared_ptr<const SoftSetup>& setup, const SoftPushes& pushes, double now_s,
            Renderer& renderer);
  /// The renderer shows all parts at rest.
  void begin_again() {
    shapes_.reset();
    loose_ = {};
  }

 private:
  /// True: something has another shape.
  bool put(const SoftPushes& pushes, Renderer& renderer);

  std::shared_ptr<const Case> case_;
  std::shared_ptr<const SoftSetup> setup_;
  std::optional<SoftShapes> shapes_;
  LooseSofts loose_;
  double changed_s_ = -1;  ///< when a shape was last given
};

}  // namespace osteon
