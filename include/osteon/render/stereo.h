#pragma once

#include <string_view>

#include "osteon/base/result.h"
#include "osteon/render/camera.h"
#include "osteon/render/renderer.h"

namespace osteon {

/// How the pictures of two eyes share one.
enum class StereoLayout {
  kSideBySide,  ///< the left eye's in the left half, both at half their width
  kOverUnder,   ///< the left eye's in the upper half, both at half their height
  kInterlaced,  ///< the left eye's in the rows 0, 2, 4 ... from the top
  kAnaglyph     ///< the left eye's red with the right eye's green and blue
};
/// "side-by-side", "over-under", "interlaced", "anaglyph".
Result<StereoLayout> parse_stereo_layout(std::string_view text);

/// Two eyes before one screen.
struct StereoEyes {
  double distance_m = 0.006;    ///< between them
  double screen_depth_m = 0.1;  ///< from the eyes to where both pictures coincide
};
/// Fails on a distance below 0 or a depth of 0 or less, on numbers that are none, and on a camera
/// in parallel projection, for which depth does not show.
Result<void> check(const StereoEyes& eyes, const Camera& camera);

/// The camera of one eye: beside the middle one, looking the same way, through the same window at
/// the screen's depth (off-axis frusta; the pictures need no turning towards each other). A point
/// at the depth z stands farther to the right for the left eye than for the right one by
/// distance (screen_depth / z - 1), measured on the screen.
Camera left_eye(const Camera& middle, const StereoEyes& eyes);
Camera right_eye(const Camera& middle, const StereoEyes& eyes);

/// Two pictures of one size in one of that size. Halves are means of two pixels.
Image join(const Image& left, const Image& right, StereoLayout layout);

}  // namespace osteon
