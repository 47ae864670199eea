#pragma once

// Grey slices written as files by libpng and libtiff, in the shapes that scanners' programs write.
#include <gtest/gtest.h>
#include <png.h>
#include <tiffio.h>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace osteon {

struct TestSlice {
  int width = 0, height = 0, bits = 16;
  std::vector<std::uint16_t> values;  ///< of 8 bits: the low bytes
  TestSlice(int columns, int rows, std::uint16_t value, int depth = 16)
      : width(columns),
        height(rows),
        bits(depth),
        values(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), value) {}
  std::uint16_t& at(int row, int column) {
    return values[static_cast<std::size_t>(row * width + column)];
  }
  /// As a file has them: 8 or 16 bits each, the native byte order.
  std::vector<std::uint8_t> row_bytes(int row) const {
    std::vector<std::uint8_t> bytes;
    for (int k = row * width; k < (row + 1) * width; ++k) {
      const std::uint16_t value = values[static_cast<std::size_t>(k)];
      bytes.push_back(static_cast<std::uint8_t>(value & 255));
      if (bits == 16) bytes.push_back(static_cast<std::uint8_t>(value >> 8));
    }
    return bytes;
  }
};

inline void write_png_slice(const TestSlice& slice, const std::filesystem::path& file,
                            int interlace = PNG_INTERLACE_NONE) {
  std::FILE* out = std::fopen(file.c_str(), "wb");
  ASSERT_TRUE(out);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, out);
  png_set_IHDR(png, info, static_cast<png_uint_32>(slice.width),
               static_cast<png_uint_32>(slice.height), slice.bits, PNG_COLOR_TYPE_GRAY, interlace,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  if (slice.bits == 16) png_set_swap(png);
  std::vector<std::vector<std::uint8_t>> bytes;
  for (int row = 0; row < slice.height; ++row) bytes.push_back(slice.row_bytes(row));
  std::vector<png_bytep> rows;
  for (auto& row : bytes) rows.push_back(row.data());
  png_write_image(png, rows.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  ASSERT_EQ(std::fclose(out), 0);
}

struct TiffShape {
  std::uint16_t compression = COMPRESSION_NONE, sample_format = SAMPLEFORMAT_UINT;
  std::uint32_t tile = 0;  ///< 0: strips; else the edge of square tiles, a multiple of 16
  const char* mode = "w";  ///< "wb": big-endian
};

inline void write_tiff_slice(TestSlice slice, const std::filesystem::path& file,
                             const TiffShape& shape = {}) {
  TIFF* tiff = TIFFOpen(file.c_str(), shape.mode);
  ASSERT_TRUE(tiff);
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, slice.width);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, slice.height);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, slice.bits);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, shape.sample_format);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, shape.compression);
  if (shape.tile == 0) {
    TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 3);
    for (int row = 0; row < slice.height; ++row)
      ASSERT_EQ(
          TIFFWriteScanline(tiff, slice.row_bytes(row).data(), static_cast<std::uint32_t>(row), 0),
          1);
  } else {
    TIFFSetField(tiff, TIFFTAG_TILEWIDTH, shape.tile);
    TIFFSetField(tiff, TIFFTAG_TILELENGTH, shape.tile);
    const int edge = static_cast<int>(shape.tile);
    for (int row = 0; row < slice.height; row += edge)
      for (int column = 0; column < slice.width; column += edge) {
        TestSlice tile(edge, edge, 0xdead);
        for (int i = 0; i < edge && row + i < slice.height; ++i)
          for (int j = 0; j < edge && column + j < slice.width; ++j)
            tile.at(i, j) = slice.at(row + i, column + j);
        ASSERT_GT(TIFFWriteTile(tiff, tile.values.data(), static_cast<std::uint32_t>(column),
                                static_cast<std::uint32_t>(row), 0, 0),
                  0);
      }
  }
  TIFFClose(tiff);
}

}  // namespace osteon
