// PNG: https://www.w3.org/TR/png-3 (the first chunk holds the size). TIFF 6.0: a directory of
// entries of twelve bytes, tag, type, count and value.
#include "files/picture_header.h"

#include <cstddef>

namespace osteon {
namespace {

constexpr std::uint64_t kTiffWidth = 256, kTiffHeight = 257, kTiffSamples = 277;
constexpr std::uint64_t kTiffShort = 3;
constexpr std::uint64_t kMostSamples = 4;

struct StoredSize {
  std::uint64_t width = 0, height = 0, samples = 1;
};

/// Numbers of a file by their places; beyond its end they are 0.
class Bytes {
 public:
  Bytes(std::string_view bytes, bool big) : bytes_(bytes), big_(big) {}
  std::uint64_t number(std::uint64_t at, std::uint64_t length) const {
    std::uint64_t value = 0;
    for (std::uint64_t n = 0; n < length; ++n) {
      const std::uint64_t from = at + (big_ ? n : length - 1 - n);
      const auto byte = from < bytes_.size() ? static_cast<unsigned char>(bytes_[from]) : 0u;
      value = value << 8 | byte;
    }
    return value;
  }

 private:
  std::string_view bytes_;
  bool big_;
};

StoredSize tiff_size(std::string_view file, bool big) {
  const Bytes bytes(file, big);
  const std::uint64_t directory = bytes.number(4, 4);
  const std::uint64_t entries = bytes.number(directory, 2);
  StoredSize size;
  for (std::uint64_t n = 0; n < entries; ++n) {
    const std::uint64_t at = directory + 2 + 12 * n;
    const std::uint64_t value = bytes.number(at + 8, bytes.number(at + 2, 2) == kTiffShort ? 2 : 4);
    switch (bytes.number(at, 2)) {
      case kTiffWidth:
        size.width = value;
        break;
      case kTiffHeight:
        size.height = value;
        break;
      case kTiffSamples:
        size.samples = value;
        break;
      default:
        break;
    }
  }
  return size;
}

StoredSize size_of_picture(std::string_view bytes) {
  using namespace std::string_view_literals;
  if (bytes.starts_with("\x89PNG\r\n\x1a\n"sv)) {
    const Bytes png(bytes, true);
    return {png.number(16, 4), png.number(20, 4), 1};
  }
  if (bytes.starts_with("II\x2a\0"sv)) return tiff_size(bytes, false);
  if (bytes.starts_with("MM\0\x2a"sv)) return tiff_size(bytes, true);
  return {};
}

}  // namespace

Result<void> check_picture_header(std::string_view bytes, const std::string& where) {
  const StoredSize size = size_of_picture(bytes);
  if (size.width == 0 || size.height == 0)
    return fail("is damaged or not a PNG or TIFF picture", where, "Export the slices again");
  if (size.width > kWidestPicture || size.height > kWidestPicture || size.samples > kMostSamples)
    return fail("is " + std::to_string(size.width) + " x " + std::to_string(size.height) +
                    " pixels large, too large for a slice",
                where, "Crop the slices to the joint");
  return {};
}

}  // namespace osteon
