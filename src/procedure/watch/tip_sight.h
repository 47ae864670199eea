#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "osteon/procedure/scope_watch.h"
#include "osteon/scene/case.h"
#include "osteon/scene/state.h"

namespace osteon {

/// Whether a scope of another hand, in a portal, has this hand's tip in its picture, 80 mm away at
/// most and not hidden by bone. `optics`: by hand; none: nobody looks through it.
bool is_tip_seen(const Case& the_case, std::span<const std::optional<ScopeOptics>> optics,
                 std::span<const ToolState* const> tools, std::size_t by_hand,
                 const BoneSnapshot& bones);

}  // namespace osteon
