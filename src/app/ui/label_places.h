#pragma once

#include <span>
#include <vector>

#include "ui/ui_layout.h"

namespace osteon {

/// Where labels go so that none covers another: each at its wanted place if that is free, else
/// above or below it, as near as there is room. Those in front of others in `wanted` go first. One
/// that finds no room within ten of its heights stays where it was wanted. `gap`: least space
/// between two, pixels. `taken`: what else they keep off.
std::vector<UiRect> spread_labels(std::span<const UiRect> wanted, float gap,
                                  std::vector<UiRect> taken = {});

}  // namespace osteon
