#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/carve/uncut_field.h"
#include "osteon/collide/distance_field.h"
#include "osteon/scene/case.h"
#include "osteon/tissue/pressed_solid.h"

namespace osteon {

class FieldCache;

/// A meniscus, or the stump of a torn ligament, that is felt. All of it is in the frame of the bone
/// that it lies on.
struct SoftSolid {
  std::string name;        ///< of the soft part
  std::uint32_t soft = 0;  ///< in Case::softs
  BoneId bone;
  std::shared_ptr<const DistanceField> field;  ///< of its surface at rest
  std::shared_ptr<const PressedSolid> body;
  std::shared_ptr<const UncutField> uncut;      ///< of its surface, for what is cut out of it
  std::function<bool(const Vec3& p_B)> bleeds;  ///< whether it has vessels there; none: nowhere
  /// Whether it hangs on its bone there, whatever is cut; of a stump, whether what is there counts
  /// as remains that are to be cleared. None: the largest part stays, nothing is to go.
  std::function<bool(const Vec3&p_B)> hangs, to_clear;
  std::shared_ptr<const TriMesh> surface_B;  ///< of a stump; none: all of the soft part
  double cutting_n = 0;  ///< force of an edge that opens it; 0: as SoftSetup says
};
std::uint64_t hash_of(std::span<const SoftSolid> solids);

/// Whether a name of --soft means menisci: "menisci", or that of a soft part of this kind.
bool names_solids(const Case& the_case, const std::string& name);

/// Makes solids of the case's menisci. `names`: as names_solids has them. Each lies on its bone,
/// held along its lower outer edge, horns included. `stiffness_n_per_m`: what a hand meets where it
/// presses from above. `known`: fields that were made before, and where new ones are put; null:
/// all are made. Fails, and says what there is, where the case has no such part, or where the
/// part is open or belongs to no one bone.
Result<std::vector<SoftSolid>> make_soft_solids(const Case& the_case,
                                                std::span<const std::string> names,
                                                double stiffness_n_per_m,
                                                FieldCache* known = nullptr);

}  // namespace osteon
