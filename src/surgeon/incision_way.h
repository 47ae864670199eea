#pragma once

#include <string>

#include "hand_way.h"
#include "osteon/scene/case.h"

namespace osteon {

/// With a scalpel along the limb through the skin over the tendons' insertion, and off it. `X_WS`:
/// of the skin there, z out of it and y along the limb. `fault`: "incision_aside" or
/// "incision_deep" is made, another one is not. Nothing is done where the case has no skin.
void open_skin(const Case& the_case, const Pose& X_WS, const RoundJoint& knee,
               const std::string& fault, HandWay& way);

}  // namespace osteon
