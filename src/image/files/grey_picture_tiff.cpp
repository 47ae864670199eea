#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstddef>
#include <cstring>
#include <memory>
#include <vector>

#include "files/grey_picture.h"
#include "files/picture_header.h"

namespace osteon {
namespace {

/// The file in memory that libtiff reads.
struct TiffSource {
  std::string_view bytes;
  std::uint64_t at = 0;
};

TiffSource& tiff_source(thandle_t handle) { return *static_cast<TiffSource*>(handle); }

tmsize_t read_tiff_bytes(thandle_t handle, void* out, tmsize_t count) {
  TiffSource& source = tiff_source(handle);
  if (count <= 0 || source.at >= source.bytes.size()) return 0;
  const std::size_t taken = std::min<std::size_t>(
      static_cast<std::size_t>(count), source.bytes.size() - static_cast<std::size_t>(source.at));
  std::memcpy(out, source.bytes.data() + source.at, taken);
  source.at += taken;
  return static_cast<tmsize_t>(taken);
}

tmsize_t write_no_tiff(thandle_t, void*, tmsize_t) { return 0; }

toff_t seek_tiff(thandle_t handle, toff_t by, int from) {
  TiffSource& source = tiff_source(handle);
  const std::uint64_t base = from == SEEK_CUR   ? source.at
                             : from == SEEK_END ? source.bytes.size()
                                                : 0;
  source.at = base + by;
  return source.at;
}

int close_no_tiff(thandle_t) { return 0; }
toff_t tiff_length(thandle_t handle) { return tiff_source(handle).bytes.size(); }
int say_nothing_of_tiff(TIFF*, void*, const char*, const char*, va_list) { return 1; }

struct CloseTiff {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using OpenTiff = std::unique_ptr<TIFF, CloseTiff>;

/// "m": no map of the file; "r": to read.
OpenTiff open_tiff(TiffSource& source) {
  TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
  TIFFOpenOptionsSetErrorHandlerExtR(options, say_nothing_of_tiff, nullptr);
  TIFFOpenOptionsSetWarningHandlerExtR(options, say_nothing_of_tiff, nullptr);
  OpenTiff tiff(TIFFClientOpenExt("slice", "rm", &source, read_tiff_bytes, write_no_tiff, seek_tiff,
                                  close_no_tiff, tiff_length, nullptr, nullptr, options));
  TIFFOpenOptionsFree(options);
  return tiff;
}

std::uint16_t tiff_number(TIFF* tiff, std::uint32_t tag) {
  std::uint16_t value = 0;
  TIFFGetFieldDefaulted(tiff, tag, &value);
  return value;
}

bool read_tiff_rows(TIFF* tiff, GreyPicture& picture) {
  const auto width = static_cast<std::size_t>(picture.width);
  if (TIFFScanlineSize64(tiff) != 2 * width) return false;
  for (std::size_t row = 0; row < static_cast<std::size_t>(picture.height); ++row)
    if (TIFFReadScanline(tiff, picture.values.get() + row * width, static_cast<std::uint32_t>(row),
                         0) != 1)
      return false;
  return true;
}

/// Copies the part of a tile that lies inside the picture.
void place_tile(const std::vector<std::uint16_t>& tile, std::size_t tile_width, std::size_t column,
                std::size_t row, GreyPicture& picture) {
  const auto width = static_cast<std::size_t>(picture.width);
  const std::size_t columns = std::min(tile_width, width - column);
  const std::size_t rows =
      std::min(tile.size() / tile_width, static_cast<std::size_t>(picture.height) - row);
  for (std::size_t k = 0; k < rows; ++k)
    std::copy_n(tile.data() + k * tile_width, columns,
                picture.values.get() + (row + k) * width + column);
}

/// Wide tiles are refused: room for one is taken before a byte of it is read.
bool read_tiff_tiles(TIFF* tiff, GreyPicture& picture) {
  constexpr std::uint32_t kWidestTile = 4096;
  std::uint32_t width = 0, height = 0;
  if (!TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &width) ||
      !TIFFGetField(tiff, TIFFTAG_TILELENGTH, &height) || width == 0 || height == 0 ||
      width > kWidestTile || height > kWidestTile)
    return false;
  std::vector<std::uint16_t> tile(std::size_t{width} * height);
  if (TIFFTileSize64(tiff) != 2 * tile.size()) return false;
  for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(picture.height); row += height)
    for (std::uint32_t column = 0; column < static_cast<std::uint32_t>(picture.width);
         column += width) {
      if (TIFFReadTile(tiff, tile.data(), column, row, 0, 0) < 0) return false;
      place_tile(tile, width, column, row, picture);
    }
  return true;
}

}  // namespace

Result<GreyPicture> decode_tiff(std::string_view bytes, const std::string& where) {
  TiffSource source{bytes};
  const OpenTiff tiff = open_tiff(source);
  std::uint32_t width = 0, height = 0;
  if (!tiff || !TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &width) ||
      !TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &height))
    return damaged_picture(where);
  const std::uint16_t format = tiff_number(tiff.get(), TIFFTAG_SAMPLEFORMAT);
  const bool whole_numbers = format == SAMPLEFORMAT_UINT || format == SAMPLEFORMAT_INT;
  if (tiff_number(tiff.get(), TIFFTAG_SAMPLESPERPIXEL) != 1 ||
      tiff_number(tiff.get(), TIFFTAG_BITSPERSAMPLE) != 16 || !whole_numbers)
    return not_grey_16_bits(where);
  // The header was read by another reader; of two widths it may have taken the other.
  if (width == 0 || height == 0 || width > kWidestPicture || height > kWidestPicture)
    return damaged_picture(where);
  GreyPicture picture(width, height, format == SAMPLEFORMAT_INT);
  const bool read = TIFFIsTiled(tiff.get()) ? read_tiff_tiles(tiff.get(), picture)
                                            : read_tiff_rows(tiff.get(), picture);
  if (!read) return damaged_picture(where);
  return picture;
}

}  // namespace osteon
