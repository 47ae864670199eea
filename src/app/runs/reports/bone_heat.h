#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "osteon/carve/heat.h"
#include "osteon/carve/thrust.h"
#include "osteon/physics/carving.h"

namespace osteon {

/// Whether an instrument lets out heat in that step.
bool makes_heat(const CarvingReadout& readout);

/// The heat about the place where a bone is cut first: 45 mm along the drill, 6 mm about it, in
/// cells of 0.5 mm, without irrigation.
class BoneHeat {
 public:
  /// `first`: of the step that begins to cut.
  BoneHeat(const DrillTable& table, const CarvingReadout& first);
  /// What cuts another bone warms nothing here.
  void warm(const CarvingReadout& readout, double step_s);
  /// Time goes on. True: the heat was conducted, temperatures are new.
  bool pass(double step_s);

  std::uint32_t bone() const { return bone_; }
  /// None: the place is too large.
  const std::optional<HeatGrid>& grid() const { return heat_; }
  double hottest_c() const { return heat_ ? heat_->hottest_c() : material_.body_c; }
  double necrosis_m3(std::size_t rule) const { return heat_ ? heat_->necrosis_m3(rule) : 0; }
  /// In Bone: outside nothing is followed.
  const Aabb& box_B() const { return box_B_; }

 private:
  std::optional<HeatGrid> heat_;
  HeatMaterial material_;
  double chips_share_, rubbing_share_, outrun_m_per_s_;
  std::uint32_t bone_;
  Aabb box_B_;
  std::optional<Vec3> tip_, opened_;  ///< what lies between is gone
  double radius_m_ = 0, since_s_ = 0;
};

}  // namespace osteon
