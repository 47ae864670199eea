#include "osteon/render/stereo.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace osteon {
namespace {

/// Looks through the window at the screen's depth, wherever the camera's own target stands.
Camera through_screen(const Camera& middle, const StereoEyes& eyes, double to_the_right_m) {
  Camera eye = middle;
  eye.target_W = middle.eye_W() - middle.q_WC * Vec3(0, 0, eyes.screen_depth_m);
  eye.distance_m = eyes.screen_depth_m;
  eye.eye_right_m = to_the_right_m;
  return eye;
}

std::uint8_t channel(const Image& image, int x, int y, int c) {
  const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                     static_cast<std::size_t>(x);
  return image.rgb[3 * pixel + static_cast<std::size_t>(c)];
}

std::uint8_t mean(std::uint8_t a, std::uint8_t b) {
  return static_cast<std::uint8_t>((a + b + 1) / 2);
}

/// Of a picture squeezed to half its width or height.
std::uint8_t squeezed(const Image& image, int x, int y, int c, bool across) {
  const int x2 = across ? 1 : 0, y2 = across ? 0 : 1;
  const int other_x = std::min(x + x2, image.width - 1),
            other_y = std::min(y + y2, image.height - 1);
  return mean(channel(image, x, y, c), channel(image, other_x, other_y, c));
}

std::uint8_t joined(const Image& left, const Image& right, StereoLayout layout, int x, int y,
                    int c) {
  const int half_x = (left.width + 1) / 2, half_y = (left.height + 1) / 2;
  switch (layout) {
    case StereoLayout::kSideBySide:
      return x < half_x ? squeezed(left, 2 * x, y, c, true)
                        : squeezed(right, 2 * (x - half_x), y, c, true);
    case StereoLayout::kOverUnder:
      return y < half_y ? squeezed(left, x, 2 * y, c, false)
                        : squeezed(right, x, 2 * (y - half_y), c, false);
    case StereoLayout::kInterlaced:
      return channel(y % 2 == 0 ? left : right, x, y, c);
    case StereoLayout::kAnaglyph:
      return channel(c == 0 ? left : right, x, y, c);
  }
  return 0;
}

}  // namespace

Result<StereoLayout> parse_stereo_layout(std::string_view text) {
  for (const auto& [name, layout] : {std::pair{"side-by-side", StereoLayout::kSideBySide},
                                     {"over-under", StereoLayout::kOverUnder},
                                     {"interlaced", StereoLayout::kInterlaced},
                                     {"anaglyph", StereoLayout::kAnaglyph}})
    if (text == name) return layout;
  return fail("\"" + std::string(text) + "\" is not a stereo format", "--stereo",
              "Choose side-by-side, over-under, interlaced or anaglyph");
}

Result<void> check(const StereoEyes& eyes, const Camera& camera) {
  if (!std::isfinite(eyes.distance_m) || eyes.distance_m < 0)
    return fail("must be 0 or more", "the distance between the eyes");
  if (!std::isfinite(eyes.screen_depth_m) || eyes.screen_depth_m <= 0)
    return fail("must be above 0", "the depth of the screen");
  if (camera.orthographic)
    return fail("is a parallel projection, in which both eyes see the same", "the view",
                "Choose one in perspective");
  return {};
}

Camera left_eye(const Camera& middle, const StereoEyes& eyes) {
  return through_screen(middle, eyes, -0.5 * eyes.distance_m);
}
Camera right_eye(const Camera& middle, const StereoEyes& eyes) {
  return through_screen(middle, eyes, 0.5 * eyes.distance_m);
}

Image join(const Image& left, const Image& right, StereoLayout layout) {
  if (left.rgb.empty() || left.rgb.size() != right.rgb.size() || left.width != right.width)
    return {};
  Image out{left.width, left.height, {}};
  out.rgb.reserve(left.rgb.size());
  for (int y = 0; y < left.height; ++y)
    for (int x = 0; x < left.width; ++x)
      for (int c = 0; c < 3; ++c) out.rgb.push_back(joined(left, right, layout, x, y, c));
  return out;
}

}  // namespace osteon
