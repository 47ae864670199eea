#pragma once

#include <string>

namespace osteon {

/// A name of the case as people read it: "metacarpal_1" -> "Metacarpal 1", "tfcc_disc" -> "TFCC
/// disc".
std::string label_of(const std::string& name);

}  // namespace osteon
