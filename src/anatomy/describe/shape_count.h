#pragma once

#include <toml++/toml.h>

#include <vector>

#include "osteon/anatomy/shape_numbers.h"

namespace osteon {

/// Numbers that shape the bone of this table, which need not be sound.
std::vector<ShapeNumbers> count_shape_numbers(const toml::table& bone);

}  // namespace osteon
