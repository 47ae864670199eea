#pragma once

#include <string_view>

namespace osteon {

/// The instrument that finds the way of a portal: it goes through skin, and makes none.
inline constexpr std::string_view kSpinalNeedle = "spinal_needle";

}  // namespace osteon
