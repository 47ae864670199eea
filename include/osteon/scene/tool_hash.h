#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "osteon/scene/tool.h"

namespace osteon {

/// Over all that is felt of a tool; how it is drawn is not in it.
std::uint64_t felt_hash(const Tool& tool);
/// Over a tray, in its order.
std::uint64_t felt_hash(std::span<const std::shared_ptr<const Tool>> tray);

}  // namespace osteon
