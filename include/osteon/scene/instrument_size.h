#pragma once

#include <string>

#include "osteon/scene/tool.h"

namespace osteon {

/// The size in use of an instrument in a tray, in mm, as its file measures it
/// (Instrument::size_of): "shaver:5.5" is of 5.5 mm, "shaver" of its usual size. What is no
/// instrument of Osteon's is as wide as its tip. Reads the instrument's file: not for a loop.
double size_in_use_mm(const std::string& tray_name, const Tool& tool);

}  // namespace osteon
