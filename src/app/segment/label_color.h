#pragma once

#include <array>
#include <cstdint>

namespace osteon {

/// Colour of a bone in the slices, the list and the 3D view: red in the lowest byte, opaque.
/// Neighbouring labels differ clearly.
std::uint32_t label_color(std::uint16_t label);
/// The same, sRGB 0..1.
std::array<float, 3> label_color_rgb(std::uint16_t label);

}  // namespace osteon
