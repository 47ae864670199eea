// Series that the project's own writer makes, then spoils.
#include "osteon/image/dicom.h"

#include <gdcmImageChangeTransferSyntax.h>
#include <gdcmImageReader.h>
#include <gdcmImageWriter.h>
#include <gdcmReader.h>
#include <gdcmWriter.h>

#include <fstream>
#include <functional>
#include <sstream>
#include <vector>

#include "osteon/image/load_volume.h"
#include "temp_folder.h"
#include "volumes.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

class Dicom : public TempFolder {
 protected:
  Volume make(const GridFrame& frame = small_frame(), std::uint64_t seed = 1) {
    Volume volume = noise_volume(frame, seed);
    EXPECT_TRUE(write_dicom(volume, dir_, {}));
    return volume;
  }
  Result<Volume> read(const std::string& series = {}) {
    const auto all = list_dicom_series(dir_);
    if (!all) return tl::unexpected(all.error());
    const auto chosen = choose_series(*all, series, dir_.string());
    if (!chosen) return tl::unexpected(chosen.error());
    return read_dicom(*chosen);
  }
  /// Each slice in another compression, the last one in none.
  void compress() {
    const gdcm::TransferSyntax::TSType kinds[] = {
        gdcm::TransferSyntax::JPEGLosslessProcess14_1, gdcm::TransferSyntax::JPEG2000Lossless,
        gdcm::TransferSyntax::RLELossless, gdcm::TransferSyntax::JPEGLSLossless,
        gdcm::TransferSyntax::ImplicitVRLittleEndian};
    for (int k = 0; k < 5; ++k) {
      const std::string name = file("000" + std::to_string(k + 1) + ".dcm").string();
      gdcm::ImageReader reader;
      reader.SetFileName(name.c_str());
      ASSERT_TRUE(reader.Read());
      gdcm::ImageChangeTransferSyntax change;
      change.SetTransferSyntax(kinds[k]);
      change.SetInput(reader.GetImage());
      ASSERT_TRUE(change.Change()) << k;
      gdcm::ImageWriter writer;
      writer.SetFile(reader.GetFile());
      writer.SetImage(change.GetOutput());
      writer.SetFileName(name.c_str());
      ASSERT_TRUE(writer.Write()) << k;
    }
  }
  /// Replaces one text entry of a slice.
  void edit(const std::string& name, gdcm::Tag tag, const std::string& text) {
    gdcm::Reader reader;
    reader.SetFileName(file(name).c_str());
    ASSERT_TRUE(reader.Read());
    gdcm::DataSet& data = reader.GetFile().GetDataSet();
    gdcm::DataElement entry(tag);
    const std::string even = text.size() % 2 ? text + " " : text;
    entry.SetVR(data.GetDataElement(tag).GetVR());
    entry.SetByteValue(even.data(), static_cast<std::uint32_t>(even.size()));
    data.Remove(tag);
    if (!text.empty()) data.Insert(entry);
    gdcm::Writer writer;
    writer.SetFile(reader.GetFile());
    writer.CheckFileMetaInformationOff();
    writer.SetFileName(file(name).c_str());
    ASSERT_TRUE(writer.Write());
  }
  std::string bytes_of(const std::string& name) {
    std::ostringstream bytes;
    bytes << std::ifstream(file(name), std::ios::binary).rdbuf();
    return bytes.str();
  }
  void edit_all(gdcm::Tag tag, const std::string& text) {
    for (int k = 1; k <= 5; ++k) edit("000" + std::to_string(k) + ".dcm", tag, text);
  }
  void expect_refused(const std::string& says, const std::string& names = {}) {
    const auto volume = read();
    ASSERT_FALSE(volume);
    EXPECT_NE(volume.error().message().find(says), std::string::npos) << volume.error().message();
    EXPECT_NE(volume.error().message().find(names), std::string::npos) << volume.error().message();
    EXPECT_FALSE(volume.error().todo.empty());
  }
};

const gdcm::Tag kPosition(0x0020, 0x0032), kSpacing(0x0028, 0x0030), kModality(0x0008, 0x0060),
    kSeries(0x0020, 0x000e), kNumber(0x0020, 0x0011), kOrientation(0x0020, 0x0037),
    kSlope(0x0028, 0x1053), kIntercept(0x0028, 0x1052);

void expect_same_frame(const GridFrame& a, const GridFrame& b) {
  EXPECT_EQ(a.size, b.size);
  EXPECT_LT((a.spacing_m - b.spacing_m).norm(), 1e-8);
  EXPECT_LT((a.origin_P - b.origin_P).norm(), 1e-8);
  EXPECT_LT((a.axes_P - b.axes_P).norm(), 1e-7);
}

TEST_F(Dicom, WhatIsWrittenReadsBack) {
  GridFrame frame = small_frame();
  frame.axes_P = turned();
  const Volume written = make(frame);
  const auto volume = read();
  ASSERT_TRUE(volume) << volume.error().message();
  EXPECT_EQ(volume->values, written.values);
  expect_same_frame(volume->frame, frame);
  EXPECT_EQ(dicom_frame((*list_dicom_series(dir_))[0])->size, frame.size);
}

TEST_F(Dicom, TheSameVolumeGivesTheSameBytes) {
  make();
  const std::string first = bytes_of("0003.dcm");
  make();
  EXPECT_GT(first.size(), 500u);
  EXPECT_EQ(first, bytes_of("0003.dcm"));
}

TEST_F(Dicom, SlicesAreSortedByPositionNotByName) {
  const Volume written = make();
  fs::rename(file("0001.dcm"), file("z.dcm"));
  fs::rename(file("0004.dcm"), file("a.dcm"));
  const auto volume = read();
  ASSERT_TRUE(volume) << volume.error().message();
  EXPECT_EQ(volume->values, written.values);
}

TEST_F(Dicom, SlopeAndInterceptApply) {
  const Volume written = make();
  edit_all(kSlope, "2");
  edit_all(kIntercept, "-100");
  const auto volume = read();
  ASSERT_TRUE(volume) << volume.error().message();
  for (std::size_t n = 0; n < written.values.size(); ++n)
    ASSERT_EQ(volume->values[n], 2 * (written.values[n] + 1024) - 100);
}

TEST_F(Dicom, CompressedSlicesAreUnpacked) {
  GridFrame frame = small_frame();
  frame.size = {64, 48, 5};
  const Volume written = make(frame);
  compress();
  const auto volume = read();
  ASSERT_TRUE(volume) << volume.error().message();
  EXPECT_EQ(volume->values, written.values);
}

// A ramp along j is kept in place when each slice was taken further along j than the last.
TEST_F(Dicom, ATiltedGantryIsSetUpright) {
  GridFrame frame = small_frame();
  frame.size = {6, 24, 5};
  frame.origin_P = Vec3::Zero();
  Volume volume{frame, std::vector<std::int16_t>(frame.count())};
  const double shift_m = 0.0003;
  for (int k = 0; k < 5; ++k)
    for (int j = 0; j < 24; ++j)
      for (int i = 0; i < 6; ++i) {
        const double y_mm = (j * frame.spacing_m.y() + k * shift_m) * 1000;
        volume.at(i, j, k) = static_cast<std::int16_t>(std::lround(100 * y_mm));
      }
  ASSERT_TRUE(write_dicom(volume, dir_, {}));
  for (int k = 0; k < 5; ++k)
    edit("000" + std::to_string(k + 1) + ".dcm", kPosition,
         "0\\" + std::to_string(k * 0.3) + "\\" + std::to_string(k * 1.1));
  const auto read_back = read();
  ASSERT_TRUE(read_back) << read_back.error().message();
  EXPECT_EQ(read_back->frame.size, (std::array<int, 3>{6, 26, 5}));
  for (int k = 0; k < 5; ++k)
    for (int j = 2; j < 24; ++j)
      EXPECT_NEAR(read_back->at(3, j, k), 100 * j * 0.6, 1.5) << j << " " << k;
}

TEST_F(Dicom, ScoutsAreNoSlices) {
  make();
  edit("0001.dcm", gdcm::Tag(0x0008, 0x0008), "ORIGINAL\\PRIMARY\\LOCALIZER");
  const auto volume = read();
  ASSERT_TRUE(volume) << volume.error().message();
  EXPECT_EQ(volume->frame.size[2], 4);
}

TEST_F(Dicom, SeveralSeriesAreListedAndChosenFrom) {
  make();
  fs::create_directories(file("other"));
  ASSERT_TRUE(write_dicom(noise_volume(small_frame(), 2), file("other"), {}));
  for (int k = 1; k <= 5; ++k) {
    const std::string name = "000" + std::to_string(k) + ".dcm";
    edit(name, kNumber, "7");
    fs::rename(file("other/" + name), file("other_" + name));
  }
  expect_refused("several series", "7 (CT, 5 files");
  const auto volume = read("7");
  ASSERT_TRUE(volume) << volume.error().message();
  EXPECT_EQ(volume->values, noise_volume(small_frame(), 1).values);
  const auto one = list_dicom_series(file("other_0002.dcm"));
  ASSERT_TRUE(one);
  ASSERT_EQ(one->size(), 1u);
  EXPECT_EQ(read_dicom(one->front())->values, noise_volume(small_frame(), 2).values);
  EXPECT_FALSE(read("9"));
}

// GDCM crashes on some of these: nothing of them may reach it.
TEST_F(Dicom, CompressedPixelsThatDoNotFitTheHeaderAreRefused) {
  GridFrame frame = small_frame();
  frame.size = {64, 48, 5};
  make(frame);
  compress();
  struct Spoil {
    const char* name;
    std::string mark;  ///< what stands before the byte
    std::size_t at;
    char to;
  };
  const Spoil spoils[] = {
      {"0001.dcm", "\xff\xc3", 4, '\x90'},                               // 144 bits a pixel
      {"0001.dcm", "\xff\xc3", 8, '\x41'},                               // 65 columns
      {"0001.dcm", "\xff\xc3", 9, '\x03'},                               // three colours
      {"0002.dcm", "\xff\x4f\xff\x51", 15, '\x31'},                      // 49 rows
      {"0002.dcm", "\xff\x4f\xff\x51", 41, '\x02'},                      // two components
      {"0002.dcm", "\xff\x52", 2, '\x7f'},                               // a segment beyond the end
      {"0002.dcm", "\xff\x52", 3, '\x0b'},                               // half a coding style
      {"0002.dcm", "\xff\x5c", 2, '\x7f'},                               // another beyond the end
      {"0002.dcm", "\xff\x52", 1, '\x64'},                               // no coding style
      {"0003.dcm", std::string("\x02\0\0\0\x40\0\0\0", 8), 4, '\x3f'},   // within the table
      {"0003.dcm", std::string("\x02\0\0\0\x40\0\0\0", 8), 11, '\x7f'},  // beyond the end
      {"0004.dcm", "\xff\xf7", 6, '\x2f'},                               // 47 rows
  };
  for (const Spoil& spoil : spoils) {
    std::string bytes = bytes_of(spoil.name);
    ASSERT_TRUE(load_volume_from_memory(bytes, "dcm", spoil.name)) << spoil.name;
    const std::size_t from = bytes.find(spoil.mark, bytes.rfind("\xe0\x7f\x10"));
    ASSERT_NE(from, std::string::npos) << spoil.name;
    bytes[from + spoil.at] = spoil.to;
    const auto slice = load_volume_from_memory(bytes, "dcm", spoil.name);
    ASSERT_FALSE(slice) << spoil.name << " " << spoil.at;
    EXPECT_NE(slice.error().message().find("do not fit"), std::string::npos)
        << slice.error().message();
  }
}

// GDCM aborts on an open length where there may be none.
TEST_F(Dicom, OnlySequencesAndPixelsMayHaveAnOpenLength) {
  GridFrame frame = small_frame();
  frame.size = {64, 48, 5};
  make(frame);
  compress();
  std::string bytes = bytes_of("0001.dcm");
  const std::size_t pixels = bytes.rfind("\xe0\x7f\x10");
  ASSERT_EQ(bytes.substr(pixels + 4, 2), "OB");
  bytes.replace(pixels + 4, 2, "OF");
  EXPECT_FALSE(load_volume_from_memory(bytes, "dcm", "0001.dcm"));
}

// Debian's GDCM asserts on some of these: it sees none of the file's own header.
TEST_F(Dicom, NoDamageToAHeaderEndsTheProgram) {
  make();
  const std::string whole = bytes_of("0002.dcm");
  const auto sound = load_volume_from_memory(whole, "dcm", "whole");
  ASSERT_TRUE(sound) << sound.error().message();
  std::size_t refused = 0;
  for (std::size_t at = 128; at < whole.rfind("\xe0\x7f\x10"); ++at) {
    for (const char to : {'\0', '\x01', '\x7f', '\xff'}) {
      std::string bytes = whole;
      bytes[at] = to;
      const auto slice = load_volume_from_memory(bytes, "dcm", "damaged");
      refused += slice ? 0 : 1;
      if (slice) {
        ASSERT_EQ(slice->values.size(), slice->frame.count()) << at;
      }
    }
  }
  EXPECT_GT(refused, 100u);
}

TEST_F(Dicom, PixelsInTheOtherOrderOfBytesAreTheSame) {
  const Volume written = make();
  for (const char* name : {"0002.dcm", "0004.dcm"}) {
    gdcm::ImageReader reader;
    reader.SetFileName(file(name).c_str());
    ASSERT_TRUE(reader.Read());
    gdcm::ImageChangeTransferSyntax change;
    change.SetTransferSyntax(gdcm::TransferSyntax::ExplicitVRBigEndian);
    change.SetInput(reader.GetImage());
    ASSERT_TRUE(change.Change());
    gdcm::ImageWriter writer;
    writer.SetFile(reader.GetFile());
    writer.SetImage(change.GetOutput());
    writer.SetFileName(file(name).c_str());
    ASSERT_TRUE(writer.Write());
  }
  const auto volume = read();
  ASSERT_TRUE(volume) << volume.error().message();
  EXPECT_EQ(volume->values, written.values);
}

// Cut short in the file's own words: the element is whole, but holds less than the picture.
TEST_F(Dicom, FewerPixelsThanTheSizeSaysAreRefused) {
  make();
  std::string bytes = bytes_of("0002.dcm");
  const std::size_t pixels = bytes.rfind("\xe0\x7f\x10");
  bytes.resize(bytes.size() - 2);
  bytes[pixels + 8] = static_cast<char>(bytes[pixels + 8] - 2);
  const auto slice = load_volume_from_memory(bytes, "dcm", "short.dcm");
  ASSERT_FALSE(slice);
  EXPECT_NE(slice.error().message().find("fewer pixels"), std::string::npos)
      << slice.error().message();
}

TEST_F(Dicom, ColoursAreRefused) {
  make();
  edit_all(gdcm::Tag(0x0028, 0x0004), "PALETTE COLOR");
  expect_refused("colour", "0001.dcm");
}

// A report of the dose lies in the folder of most scans.
TEST_F(Dicom, FilesWithoutAPictureArePassedOver) {
  const Volume written = make();
  gdcm::Reader reader;
  reader.SetFileName(file("0003.dcm").c_str());
  ASSERT_TRUE(reader.Read());
  reader.GetFile().GetDataSet().Remove(gdcm::Tag(0x7fe0, 0x0010));
  gdcm::Writer writer;
  writer.SetFile(reader.GetFile());
  writer.SetFileName(file("report.dcm").c_str());
  ASSERT_TRUE(writer.Write());
  expect_refused("pixels are missing", "report.dcm");  // of a CT slice
  edit("report.dcm", kModality, "SR");
  edit("report.dcm", kSeries, "1.2.3");
  const auto volume = read();
  ASSERT_TRUE(volume) << volume.error().message();
  EXPECT_EQ(volume->values, written.values);
}

TEST_F(Dicom, OneSliceFromMemoryIsTheSameAsFromItsSeries) {
  const Volume written = make();
  const std::string bytes = bytes_of("0002.dcm");
  const auto slice = load_volume_from_memory(bytes, "dcm", "0002.dcm");
  ASSERT_TRUE(slice) << slice.error().message();
  const auto first = written.values.begin() + 9 * 7;
  EXPECT_EQ(slice->values, std::vector<std::int16_t>(first, first + 9 * 7));
  EXPECT_LT((slice->frame.origin_P - written.frame.point_P(Vec3(0, 0, 1))).norm(), 1e-8);
  EXPECT_FALSE(load_volume_from_memory(bytes.substr(0, 600), "dcm", "0002.dcm"));
}

TEST_F(Dicom, AMissingSliceIsNamed) {
  make();
  fs::remove(file("0003.dcm"));
  expect_refused("missing between 0002.dcm and 0004.dcm");
}

TEST_F(Dicom, DoubledSlicesAreRefused) {
  make();
  fs::copy_file(file("0003.dcm"), file("copy.dcm"));
  expect_refused("same position");
}

TEST_F(Dicom, UnevenSpacingIsRefused) {
  make();
  edit("0005.dcm", kPosition, "-12\\34\\104.8");
  expect_refused("unevenly");
}

TEST_F(Dicom, OtherModalitiesAreRefused) {
  make();
  edit("0002.dcm", kModality, "MR");
  expect_refused("'MR'", "0002.dcm");
  edit_all(kModality, "MR");
  expect_refused("no CT series", "MR");
}

TEST_F(Dicom, MixedSlicesAreRefused) {
  make();
  edit("0002.dcm", kOrientation, "0\\1\\0\\0\\0\\1");
  expect_refused("rotated", "0002.dcm");
  edit("0002.dcm", kOrientation, "1\\0\\0\\0\\1\\0");
  edit("0002.dcm", kSpacing, "0.9\\0.9");
  expect_refused("a different pixel spacing", "0002.dcm");
}

TEST_F(Dicom, MissingEntriesAreNamed) {
  const std::pair<gdcm::Tag, std::string> entries[] = {
      {kPosition, "slice position"}, {kSpacing, "pixel spacing"}, {kSlope, "rescale"}};
  for (const auto& [tag, says] : entries) {
    make();
    edit("0004.dcm", tag, "");
    expect_refused(says, "0004.dcm");
  }
  make();
  edit_all(kSpacing, "0\\0");
  expect_refused("pixel spacing");
}

TEST_F(Dicom, TruncatedFilesAreNamedWhereverTheyEnd) {
  make();
  const auto whole = fs::file_size(file("0002.dcm"));
  for (const std::uintmax_t left : {whole - 2, whole - 60, whole / 2, std::uintmax_t{200}}) {
    make();
    fs::resize_file(file("0002.dcm"), left);
    expect_refused("damaged", "0002.dcm");
  }
}

TEST_F(Dicom, AFolderWithoutDicomIsRefused) {
  write(file("notes.txt"), "nothing");
  expect_refused("no DICOM file");
  EXPECT_FALSE(list_dicom_series(file("no_such_folder")));
}

TEST_F(Dicom, ASingleSliceIsRefused) {
  make();
  for (int k = 2; k <= 5; ++k) fs::remove(file("000" + std::to_string(k) + ".dcm"));
  expect_refused("single slice");
}

}  // namespace
}  // namespace osteon
