#include <exception>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/file.h"
#include "osteon/render/renderer.h"

namespace osteon {
namespace {

/// OpenCV's order of channels.
cv::Mat to_bgr(const Image& image) {
  cv::Mat bgr(image.height, image.width, CV_8UC3);
  const std::uint8_t* source = image.rgb.data();
  for (int row = 0; row < image.height; ++row) {
    std::uint8_t* target = bgr.ptr<std::uint8_t>(row);
    for (int k = 0; k < image.width; ++k, source += 3, target += 3) {
      target[0] = source[2];
      target[1] = source[1];
      target[2] = source[0];
    }
  }
  return bgr;
}

}  // namespace

Result<void> save_png(const Image& image, const std::filesystem::path& file) {
  const bool positive = image.width > 0 && image.height > 0;
  if (!positive || image.rgb.size() != 3u * static_cast<std::size_t>(image.width) *
                                           static_cast<std::size_t>(image.height))
    return fail("the picture is empty", file.string(),
                "give it a width and a height of at least one pixel");
  std::vector<std::uint8_t> png;
  try {
    if (!cv::imencode(".png", to_bgr(image), png))
      return fail("the picture cannot be encoded as PNG", file.string(),
                  "check that OpenCV was built with PNG");
  } catch (const std::exception& e) {
    return fail(std::string("the picture cannot be encoded as PNG: ") + e.what(), file.string(),
                "try a smaller picture");
  }
  return write_file_atomic(file,
                           std::string_view(reinterpret_cast<const char*>(png.data()), png.size()));
}

}  // namespace osteon
