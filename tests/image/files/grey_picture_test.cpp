#include "files/grey_picture.h"

#include <fstream>
#include <sstream>

#include "../slice_files.h"
#include "../temp_folder.h"

namespace osteon {
namespace {

TestSlice uneven_slice(int columns, int rows) {
  TestSlice slice(columns, rows, 0);
  for (std::size_t k = 0; k < slice.values.size(); ++k)
    slice.values[k] = static_cast<std::uint16_t>(k * 40503u);
  return slice;
}

std::string bytes_of_slice(const std::filesystem::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

void expect_values(const Result<GreyPicture>& got, const TestSlice& wanted, bool is_signed) {
  ASSERT_TRUE(got) << got.error().message();
  ASSERT_EQ(got->width, wanted.width);
  ASSERT_EQ(got->height, wanted.height);
  EXPECT_EQ(got->is_signed, is_signed);
  EXPECT_TRUE(std::equal(wanted.values.begin(), wanted.values.end(), got->values.get()));
}

class GreyPictures : public TempFolder {};

TEST_F(GreyPictures, PngPlainAndInterlaced) {
  const TestSlice slice = uneven_slice(37, 21);
  for (const int interlace : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7}) {
    write_png_slice(slice, file("a.png"), interlace);
    expect_values(decode_png(bytes_of_slice(file("a.png")), "a.png"), slice, false);
  }
}

TEST_F(GreyPictures, TiffInStripsAndTilesPackedAndSignedOfBothByteOrders) {
  const TestSlice slice = uneven_slice(37, 21);
  for (const int packed :
       {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE, COMPRESSION_PACKBITS})
    for (const std::uint32_t tile : {0u, 16u})
      for (const char* mode : {"wl", "wb"})
        for (const int format : {SAMPLEFORMAT_UINT, SAMPLEFORMAT_INT}) {
          write_tiff_slice(
              slice, file("a.tif"),
              {static_cast<std::uint16_t>(packed), static_cast<std::uint16_t>(format), tile, mode});
          expect_values(decode_tiff(bytes_of_slice(file("a.tif")), "a.tif"), slice,
                        format == SAMPLEFORMAT_INT);
        }
}

// Wherever the file ends: refused with its name, or whole where only what follows it is missing.
TEST_F(GreyPictures, CutShortAnywhereIsRefused) {
  const TestSlice slice = uneven_slice(9, 7);
  write_png_slice(slice, file("a.png"));
  const std::string png = bytes_of_slice(file("a.png"));
  for (std::size_t length = 0; length < png.size(); ++length) {
    const auto got = decode_png(std::string_view(png).substr(0, length), "a.png");
    ASSERT_FALSE(got) << length;
    EXPECT_EQ(got.error().where, "a.png");
  }
  write_tiff_slice(slice, file("a.tif"), {COMPRESSION_LZW});
  const std::string tiff = bytes_of_slice(file("a.tif"));
  for (std::size_t length = 0; length < tiff.size(); ++length) {
    const auto got = decode_tiff(std::string_view(tiff).substr(0, length), "a.tif");
    if (got)
      expect_values(got, slice, false);
    else
      EXPECT_EQ(got.error().where, "a.tif");
  }
}

TEST_F(GreyPictures, FewerBitsAreRefused) {
  write_png_slice(TestSlice(4, 3, 7, 8), file("a.png"));
  write_tiff_slice(TestSlice(4, 3, 7, 8), file("a.tif"));
  for (const auto& got : {decode_png(bytes_of_slice(file("a.png")), "a").error(),
                          decode_tiff(bytes_of_slice(file("a.tif")), "a").error()})
    EXPECT_NE(got.message().find("16 bits"), std::string::npos) << got.message();
}

}  // namespace
}  // namespace osteon
