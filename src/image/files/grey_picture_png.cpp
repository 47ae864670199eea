#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstddef>
#include <cstring>
#include <vector>

#include "files/grey_picture.h"
#include "files/picture_header.h"

namespace osteon {
namespace {

/// The bytes that libpng still reads.
struct PngSource {
  const char* next = nullptr;
  std::size_t left = 0;
};

void take_png_bytes(png_structp png, png_bytep out, std::size_t count) {
  PngSource& source = *static_cast<PngSource*>(png_get_io_ptr(png));
  if (count > source.left) png_error(png, "ends early");
  std::memcpy(out, source.next, count);
  source.next += count;
  source.left -= count;
}

[[noreturn]] void leave_png(png_structp png, png_const_charp) { png_longjmp(png, 1); }
void say_nothing(png_structp, png_const_charp) {}

/// One reading of a file; frees what libpng took.
struct PngReading {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, leave_png, say_nothing);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  PngReading() = default;
  PngReading(const PngReading&) = delete;
  PngReading& operator=(const PngReading&) = delete;
  ~PngReading() { png_destroy_read_struct(&png, &info, nullptr); }
};

// libpng leaves by longjmp. So both functions below hold nothing that has a destructor.

bool read_png_head(const PngReading& reading, PngSource& source) {
  if (setjmp(png_jmpbuf(reading.png))) return false;
  png_set_read_fn(reading.png, &source, take_png_bytes);
  png_read_info(reading.png, reading.info);
  return true;
}

bool read_png_rows(const PngReading& reading, png_bytepp rows) {
  if (setjmp(png_jmpbuf(reading.png))) return false;
  if constexpr (std::endian::native == std::endian::little) png_set_swap(reading.png);
  png_read_image(reading.png, rows);
  png_read_end(reading.png, nullptr);
  return true;
}

std::vector<png_bytep> rows_of(GreyPicture& picture) {
  std::vector<png_bytep> rows;
  const auto width = static_cast<std::size_t>(picture.width);
  for (std::size_t k = 0; k < picture.count(); k += width)
    rows.push_back(reinterpret_cast<png_bytep>(picture.values.get() + k));
  return rows;
}

}  // namespace

Result<GreyPicture> decode_png(std::string_view bytes, const std::string& where) {
  const PngReading reading;
  PngSource source{bytes.data(), bytes.size()};
  if (!reading.info || !read_png_head(reading, source)) return damaged_picture(where);
  if (png_get_color_type(reading.png, reading.info) != PNG_COLOR_TYPE_GRAY ||
      png_get_bit_depth(reading.png, reading.info) != 16)
    return not_grey_16_bits(where);
  const std::uint32_t width = png_get_image_width(reading.png, reading.info);
  const std::uint32_t height = png_get_image_height(reading.png, reading.info);
  // The header was read by another reader: it may have taken another chunk for this one.
  if (width == 0 || height == 0 || width > kWidestPicture || height > kWidestPicture)
    return damaged_picture(where);
  GreyPicture picture(width, height, false);
  std::vector<png_bytep> rows = rows_of(picture);
  if (!read_png_rows(reading, rows.data())) return damaged_picture(where);
  return picture;
}

}  // namespace osteon
