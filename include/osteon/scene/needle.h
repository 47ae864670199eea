#pragma once

#include <string_view>

namespace osteon {

/// The instrument that finds the way of a portal: it goes through skin, and makes none.
inline constexpr std::string_view kSpinalNeedle = "spinal_needle";

/// A blunt instrument that goes through skin without a cut: a needle, or a trocar, which makes a
/// portal.
inline constexpr bool pierces_skin(std::string_view instrument) {
  return instrument == kSpinalNeedle || instrument.starts_with("trocar");
}

}  // namespace osteon
