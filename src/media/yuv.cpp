#include "yuv.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace osteon {
namespace {

/// Weights of R, G, B times 65536.
using Weights = std::array<int, 3>;
constexpr Weights kY{11966, 40254, 4064};
constexpr Weights kCb{-6596, -22189, 28784};
constexpr Weights kCr{28784, -26145, -2639};

std::uint8_t weighed(const Weights& w, int r, int g, int b, int samples, int offset) {
  const int half = 32768 * samples;
  const int sum = w[0] * r + w[1] * g + w[2] * b + half + 65536 * samples * offset;
  return static_cast<std::uint8_t>(std::clamp(sum / (65536 * samples), 0, 255));
}

struct Pixels {
  const std::uint8_t* rgb;
  int width, height;

  const std::uint8_t* at(int x, int y) const {
    const auto index =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    return rgb + 3 * index;
  }
};

std::uint8_t* place(BytePlane plane, int x, int y) {
  return plane.bytes + static_cast<std::ptrdiff_t>(y) * plane.stride + x;
}

}  // namespace

void to_yuv420(std::span<const std::uint8_t> rgb, int width, int height, BytePlane y, BytePlane cb,
               BytePlane cr) {
  const Pixels pixels{rgb.data(), width, height};
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const std::uint8_t* p = pixels.at(column, row);
      *place(y, column, row) = weighed(kY, p[0], p[1], p[2], 1, 16);
    }
  for (int row = 0; row < height; row += 2)
    for (int column = 0; column < width; column += 2) {
      int r = 0, g = 0, b = 0, samples = 0;
      for (int v = row; v < std::min(row + 2, height); ++v)
        for (int u = column; u < std::min(column + 2, width); ++u) {
          const std::uint8_t* p = pixels.at(u, v);
          r += p[0];
          g += p[1];
          b += p[2];
          ++samples;
        }
      *place(cb, column / 2, row / 2) = weighed(kCb, r, g, b, samples, 128);
      *place(cr, column / 2, row / 2) = weighed(kCr, r, g, b, samples, 128);
    }
}

}  // namespace osteon
