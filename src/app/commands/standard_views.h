#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"
#include "osteon/scene/case.h"

namespace osteon {

/// A view through a scope that a student meets in every joint of a kind.
struct StandardView {
  std::string name, title, scope;
  double flexion_deg = 0;
  Vec3 at_mm = Vec3::Zero(), toward_mm = Vec3::Zero(), up = Vec3::UnitX();  ///< in World
  double post_deg = 0;
};

/// Reads lines of a table of views after its header:
/// name,title,scope,flexion_deg,at_x,at_y,at_z,toward_x,toward_y,toward_z,post_deg,up_x,up_y,up_z.
/// Strict; the error names the line.
Result<std::vector<StandardView>> parse_standard_views(std::string_view text,
                                                       const std::string& where);

/// Those that Osteon ships for the joint of this case: a knee has a femur, a wrist a radius. Fails
/// on a case with neither.
Result<std::vector<StandardView>> standard_views(const Case& the_case);

}  // namespace osteon
