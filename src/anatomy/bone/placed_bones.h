#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "osteon/anatomy/generate.h"
#include "osteon/mesh/distance.h"

namespace osteon {

/// Surfaces of grown bones in World, as the bones stand: made once, for all that asks for them.
class PlacedBones {
 public:
  PlacedBones() = default;  ///< none
  PlacedBones(const GeneratedAnatomy& grown, const GenerateOptions& options);

  std::size_t size() const { return surfaces_W_.size(); }
  /// Of a bone that was not taken.
  const MeshDistance& surface_W(std::size_t bone) const { return *surfaces_W_[bone]; }
  /// Gives a bone's surface away; none where it is not there or the bone stands otherwise.
  std::optional<MeshDistance> take(std::size_t bone, const Pose& X_WB);

 private:
  std::vector<Pose> poses_WB_;
  std::vector<std::optional<MeshDistance>> surfaces_W_;
};

}  // namespace osteon
