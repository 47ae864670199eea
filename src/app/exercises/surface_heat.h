#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "exercises/damage_map.h"
#include "osteon/session/session.h"
#include "runs/reports/bone_heat.h"

namespace osteon {

/// How warm the surfaces of carved bones get, about the first place of each that is cut.
class SurfaceHeat {
 public:
  /// The case must outlive it.
  explicit SurfaceHeat(const Case& the_case) : case_(&the_case) {}
  /// After each tick of a session that carves.
  void see(const Session& session, DamageMaker& damage);

 private:
  struct Place {
    BoneHeat heat;
    std::vector<Vec3> points_B;  ///< of the surface, where the heat is followed
  };
  Place make_place(const Carving& carving, const CarvingReadout& first) const;

  const Case* case_;
  std::map<std::uint32_t, Place> places_;  ///< by bone
  std::uint64_t step_ = 0;
};

}  // namespace osteon
