#pragma once

#include <cstdint>
#include <vector>

namespace osteon {

/// How thick cloudy water is from place to place: a cube of `side`^3 values that fills space when
/// it is repeated, x fastest. 0 is none, 255 twice the mean; the mean is 1/2. The water hangs in
/// clouds and threads: two sizes of value noise, bent by a third. The same on every machine.
std::vector<std::uint8_t> water_clouds(int side);

/// Edge of that cube in a joint, m.
inline constexpr double kCloudTile_m = 0.047;

}  // namespace osteon
