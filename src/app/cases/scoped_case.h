#pragma once

#include <filesystem>
#include <functional>
#include <utility>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/physics/joint_fluid.h"
#include "osteon/render/joint_roof.h"
#include "osteon/render/joint_room.h"
#include "osteon/render/scope_renderer.h"

namespace osteon {

/// A case at rest, drawn as scopes show it, in the OpenGL context that is current.
class ScopedCase {
 public:
  static Result<ScopedCase> create(Case the_case);

  const Case& the_case() const { return case_; }
  void set_water(const ScopeWater& water) { renderer_.set_water(water); }
  void set_white_balance(const WhiteBalance& white) { renderer_.set_white_balance(white); }
  /// What is in the water of each picture, by its camera and what closes the joint.
  using Strewn = std::function<std::vector<WaterBit>(const ScopeCamera&, const JointRoof&)>;
  void strew(Strewn strewn) { strewn_ = std::move(strewn); }
  /// Writes a PNG. Fails when the tip lies in bone.
  Result<void> draw(const ScopeDef& scope, const ScopePose& pose, int width, int height,
                    const std::filesystem::path& out);

 private:
  ScopedCase(Case the_case, ScopeRenderer renderer)
      : case_(std::move(the_case)), room_(case_), renderer_(std::move(renderer)) {}
  Case case_;
  JointRoom room_;
  ScopeRenderer renderer_;
  Strewn strewn_;
};

/// Which water a picture is taken through.
struct WaterOrder {
  FluidDrive drive;
  double after_s = 60;   ///< since pump and bleeding began
  double turbidity = 0;  ///< of pale debris, beside the blood; see osteon::turbidity
  double fog = 0;        ///< of the lens
  double flushed_s = 0;  ///< for so long water was then flushed over the lens
};
struct WaterNow {
  ScopeWater seen;
  FluidState state;
  FluidFlows flows;
  double turbidity = 0;  ///< of blood and debris together
};
/// Fails on numbers that are none, or out of range.
Result<WaterNow> water_after(const WaterOrder& order, const FluidJoint& joint);

/// The water of a wrist or a knee.
FluidJoint fluid_of(const Case& the_case);

}  // namespace osteon
