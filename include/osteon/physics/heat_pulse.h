#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "osteon/carve/bone_heat.h"
#include "osteon/physics/carving.h"
#include "osteon/physics/joint_fluid.h"
#include "osteon/scene/command.h"
#include "osteon/scene/state.h"

namespace osteon {

/// What warmed and cooled the bones of a session for a moment. Nothing of it is felt: it follows
/// from the steps, so a replay gives the same pulses.
struct HeatPulse {
  struct Source {
    std::uint32_t bone = CarvingHand::kNoBone;  ///< kNoBone: this hand warms nothing
    HeatSource heat;
  };
  enum class Kind : std::uint8_t {
    kPasses,  ///< time goes on by `dt_s`
    kKeep,    ///< the restore point `mark` was set
    kGoBack   ///< the bones are as at that restore point
  };
  Kind kind = Kind::kPasses;
  std::uint32_t mark = 0;
  double dt_s = 0;
  double flow_m3_s = 0;  ///< of water over the bones
  std::array<Source, kMaxHands> sources;
};

/// Gathers pulses from a session that carves, step by step.
class HeatPulses {
 public:
  static constexpr double kEvery_s = 0.05;

  /// `joint`: of the case, where it is filled with water.
  explicit HeatPulses(const CarvingSetup& setup, std::optional<FluidJoint> joint = {});

  /// After a step of physics; `command` is that of the step.
  void add(const Carving& carving, const BoneSnapshot& bones, const Command& command,
           double step_s);
  /// The next pulse that is due; null: none is. It stays until pop: who has no room for it asks
  /// again, and heat gathers meanwhile.
  const HeatPulse* due() const;
  void pop();

 private:
  void gather(std::size_t hand, const CarvingReadout& readout, double step_s);

  double chips_share_, rubbing_share_, outrun_m_per_s_;
  std::optional<FluidJoint> joint_;
  bool warmed_ = false;             ///< nothing was warm before
  std::array<HeatPulse, 2> waits_;  ///< of a restore point, and of what passed
  std::array<bool, 2> is_due_{};
};

/// Temperatures of the bones of a session. A value.
class HeatOfBones {
 public:
  /// The bone's field as it is now; null: it is not carved.
  using FieldOf = std::function<const CarvedField*(std::uint32_t bone)>;

  HeatOfBones(const HeatMaterial& material, const Irrigation& water)
      : material_(material), water_(water), hottest_c_(material.body_c) {}

  void take(const HeatPulse& pulse, const FieldOf& field_of);
  /// Null: nothing has warmed it.
  const BoneHeat* bone(std::uint32_t index) const;
  std::size_t bones() const { return now_.size(); }
  /// Anywhere since the begin, whatever restore point the bones went back to.
  double hottest_c() const { return hottest_c_; }
  double necrosis_m3(std::size_t rule) const;  ///< of all bones as they are

 private:
  using All = std::vector<std::optional<BoneHeat>>;
  HeatMaterial material_;
  Irrigation water_;
  All now_;
  std::array<std::optional<All>, kMaxMarks> kept_;
  double hottest_c_;
};

/// Water over the bones: what the setup says, and what the pump of a filled joint lets in.
double irrigation_m3_s(const CarvingSetup& setup, const std::optional<FluidJoint>& joint,
                       const BoneSnapshot& bones);

}  // namespace osteon
