#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "osteon/base/result.h"

namespace osteon {

/// A grey picture of 16 bits as its file has it, rows from the top.
struct GreyPicture {
  int width = 0, height = 0;
  /// The bits of each pixel are those of a signed number.
  bool is_signed = false;
  /// Not cleared first: a file of a few bytes may claim to be large, and is refused before these
  /// are looked at.
  std::unique_ptr<std::uint16_t[]> values;

  GreyPicture(std::uint32_t columns, std::uint32_t rows, bool has_sign)
      : width(static_cast<int>(columns)),
        height(static_cast<int>(rows)),
        is_signed(has_sign),
        values(std::make_unique_for_overwrite<std::uint16_t[]>(count())) {}
  std::size_t count() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
};

/// Decode the bytes of a PNG or TIFF file whose header has been checked (picture_header.h). Each
/// fails, naming `where`, on damaged bytes and on pictures that are not grey with 16 bits.
Result<GreyPicture> decode_png(std::string_view bytes, const std::string& where);
Result<GreyPicture> decode_tiff(std::string_view bytes, const std::string& where);

/// What both say.
inline tl::unexpected<Error> damaged_picture(const std::string& where) {
  return fail("is damaged or not a picture", where, "Export the slices again");
}
inline tl::unexpected<Error> not_grey_16_bits(const std::string& where) {
  return fail("is not a grey picture of 16 bits", where,
              "Export 16-bit slices: fewer bits cannot hold Hounsfield units");
}

}  // namespace osteon
