#pragma once

namespace osteon {

/// Of the jaws' way, 0 shut to 1 open: above and below these they count as open and as shut.
constexpr double kJawsOpen = 0.5, kJawsShut = 0.15;

}  // namespace osteon
