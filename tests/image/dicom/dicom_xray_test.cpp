#include "osteon/image/dicom_xray.h"

#include <gdcmImageReader.h>
#include <gdcmStringFilter.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <limits>

#include "osteon/base/file.h"
#include "osteon/image/dicom.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

class DicomXray : public ::testing::Test {
 protected:
  void SetUp() override {
    dir_ = fs::temp_directory_path() / ("osteon_xa_" + std::to_string(::getpid()));
    fs::create_directories(dir_);
    film_.width = 3;
    film_.height = 2;
    film_.grey = {0, 1, 0.5f, 2, -1, std::numeric_limits<float>::quiet_NaN()};
    film_.orbit_rad = 0.5;
    film_.mas = 0.05;
    film_.kerma_area_mgy_cm2 = 12;
  }
  void TearDown() override { fs::remove_all(dir_); }
  fs::path dir_;
  XrayFilm film_;
};

TEST_F(DicomXray, AnEmptyOrMismatchedPictureIsRefused) {
  EXPECT_FALSE(write_dicom_xray({}, dir_ / "a.dcm"));
  film_.grey.pop_back();
  EXPECT_FALSE(write_dicom_xray(film_, dir_ / "a.dcm"));
  EXPECT_FALSE(fs::exists(dir_ / "a.dcm"));
}

TEST_F(DicomXray, AFolderThatIsNotThereIsAnError) {
  EXPECT_FALSE(write_dicom_xray(film_, dir_ / "none" / "a.dcm"));
}

TEST_F(DicomXray, AReaderFindsPixelsGeometryAndNobody) {
  const fs::path file = dir_ / "a.dcm";
  ASSERT_TRUE(write_dicom_xray(film_, file));
  EXPECT_TRUE(is_dicom_file(file));
  gdcm::ImageReader reader;
  reader.SetFileName(file.string().c_str());
  ASSERT_TRUE(reader.Read());
  EXPECT_EQ(reader.GetImage().GetDimension(0), 3u);
  EXPECT_EQ(reader.GetImage().GetDimension(1), 2u);
  std::uint16_t words[6];
  ASSERT_EQ(reader.GetImage().GetBufferLength(), sizeof words);
  ASSERT_TRUE(reader.GetImage().GetBuffer(reinterpret_cast<char*>(words)));
  const std::uint16_t want[6] = {0, 4095, 2048, 4095, 0, 0};
  EXPECT_EQ(std::memcmp(words, want, sizeof want), 0);
  gdcm::StringFilter text;
  text.SetFile(reader.GetFile());
  EXPECT_EQ(text.ToString(gdcm::Tag(0x0008, 0x0016)), "1.2.840.10008.5.1.4.1.1.12.1");
  EXPECT_EQ(text.ToString(gdcm::Tag(0x0008, 0x0060)), "XA");
  EXPECT_EQ(text.ToString(gdcm::Tag(0x0010, 0x0010)), "VIRTUAL ");
  EXPECT_EQ(std::stod(text.ToString(gdcm::Tag(0x0018, 0x1110))), 1000);
  EXPECT_NEAR(std::stod(text.ToString(gdcm::Tag(0x0018, 0x1510))), 28.6479, 1e-3);
  EXPECT_NEAR(std::stod(text.ToString(gdcm::Tag(0x0018, 0x115e))), 0.12, 1e-9);
  EXPECT_EQ(std::stoi(text.ToString(gdcm::Tag(0x0018, 0x1153))), 50);
}

TEST_F(DicomXray, TheSameFilmGivesTheSameBytes) {
  ASSERT_TRUE(write_dicom_xray(film_, dir_ / "a.dcm"));
  ASSERT_TRUE(write_dicom_xray(film_, dir_ / "b.dcm"));
  EXPECT_EQ(read_file(dir_ / "a.dcm").value(), read_file(dir_ / "b.dcm").value());
}

}  // namespace
}  // namespace osteon
