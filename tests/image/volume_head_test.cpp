// What is said of a scan before its voxels are read: from files that end where the voxels begin.
#include <gtest/gtest.h>

#include <optional>

#include "osteon/image/dicom.h"
#include "osteon/image/load_volume.h"
#include "slice_files.h"
#include "temp_folder.h"
#include "volume_bytes.h"

namespace osteon {
namespace {

class VolumeHeads : public TempFolder {
 protected:
  struct Told {
    std::optional<VolumeHead> head;
    Result<Volume> volume;
  };
  Told load(const std::filesystem::path& source, bool goes_on = true) {
    Told told{std::nullopt, fail("not run")};
    LoadVolumeOptions options;
    options.spacing_m = Vec3(0.0004, 0.0006, 0.0011);
    options.announce = [&](const VolumeHead& head) {
      told.head = head;
      return goes_on;
    };
    told.volume = load_volume(source, options);
    return told;
  }
  Told load(const std::string& name, const std::string& bytes, bool goes_on = true) {
    write(file(name), bytes);
    return load(file(name), goes_on);
  }
  /// The head is that of the volume, also when the voxels are missing, and may stop the reading.
  void expect_told(const std::string& name, const std::string& whole, std::size_t header_bytes) {
    const Told good = load(name, whole);
    ASSERT_TRUE(good.volume) << name << good.volume.error().message();
    ASSERT_TRUE(good.head) << name;
    EXPECT_EQ(good.head->frame.size, good.volume->frame.size) << name;
    EXPECT_LT((good.head->frame.origin_P - good.volume->frame.origin_P).norm(), 1e-9) << name;
    EXPECT_LT((good.head->frame.spacing_m - good.volume->frame.spacing_m).norm(), 1e-9) << name;
    EXPECT_LT((good.head->frame.axes_P - good.volume->frame.axes_P).norm(), 1e-9) << name;
    EXPECT_GE(good.head->reading_bytes,
              static_cast<double>(whole.size() + 2 * volume_.values.size()))
        << name;
    const Told cut = load(name, whole.substr(0, header_bytes));
    ASSERT_TRUE(cut.head) << name;
    EXPECT_EQ(cut.head->frame.size, good.head->frame.size) << name;
    EXPECT_FALSE(cut.volume) << name;
    const Told stopped_there = load(name, whole, false);
    ASSERT_FALSE(stopped_there.volume) << name;
    EXPECT_EQ(stopped_there.volume.error().message(), Error(stopped().value()).message()) << name;
  }
  Volume volume_ = noise_volume(small_frame(), 5);
};

TEST_F(VolumeHeads, NrrdAndMetaImage) {
  const std::string raw = raw_bytes(volume_);
  const std::string nrrd = nrrd_header("raw"), packed = nrrd_header("gzip");
  expect_told("a.nrrd", nrrd + raw, nrrd.size() + 1);
  expect_told("b.nrrd", packed + gzip(raw), packed.size() + 20);
  const std::string meta = meta_header("", "LOCAL");
  expect_told("c.mha", meta + raw, meta.size() + 1);
  std::string left_handed = nrrd;
  left_handed.replace(left_handed.find("(0,0,1.1)"), 9, "(0,0,-1.1)");
  expect_told("d.nrrd", left_handed + raw, left_handed.size() + 1);
}

TEST_F(VolumeHeads, DetachedVoxelsNeedNotBeThere) {
  const Told told = load("a.nhdr", nrrd_header("raw", "data file: gone.raw\n"));
  ASSERT_TRUE(told.head);
  EXPECT_EQ(told.head->frame.size, volume_.frame.size);
  ASSERT_FALSE(told.volume);
  EXPECT_NE(told.volume.error().message().find("gone.raw"), std::string::npos);
}

TEST_F(VolumeHeads, Nifti) {
  const std::string whole = nifti(volume_, false, true);
  expect_told("a.nii", whole, 360);
  // What a packed file holds shows once it is unpacked; enough of it for the header is there.
  const std::string packed = gzip(whole);
  expect_told("b.nii.gz", packed, packed.size() - 20);
}

TEST_F(VolumeHeads, Inv3WhereverItsDescriptionLies) {
  const std::string main = plist("int16", "CT"), raw = raw_bytes(volume_);
  const std::string first = inv3(main, raw);
  expect_told("a.inv3", first, first.size() - 20);
  std::string tar;
  add_to_tar(tar, "tmp/matrix.dat", raw);
  add_to_tar(tar, "tmp/main.plist", main);
  const Told told = load("b.inv3", gzip(tar + std::string(1024, '\0')));
  ASSERT_TRUE(told.head && told.volume);
  EXPECT_EQ(told.head->frame.size, volume_.frame.size);
}

TEST_F(VolumeHeads, PicturesByTheFirstOne) {
  for (int k = 0; k < 5; ++k)
    write_png_slice(TestSlice(9, 7, 1024), file("s" + std::to_string(k) + ".png"));
  write(file("s4.png"), "broken");
  const Told told = load(dir_);
  ASSERT_TRUE(told.head);
  EXPECT_EQ(told.head->frame.size, volume_.frame.size);
  EXPECT_FALSE(told.volume);
}

TEST_F(VolumeHeads, DicomByItsHeaders) {
  ASSERT_TRUE(write_dicom(volume_, dir_));
  const Told told = load(dir_);
  ASSERT_TRUE(told.head && told.volume);
  EXPECT_EQ(told.head->frame.size, told.volume->frame.size);
  EXPECT_GE(told.head->reading_bytes, 2.0 * static_cast<double>(volume_.values.size()));
  EXPECT_FALSE(load(dir_, false).volume);
}

// 1000 x 1000 x 300 numbers of eight bytes, packed: nothing of it has to be there.
TEST_F(VolumeHeads, LargePackedNumbersAreCountedUnpacked) {
  std::string header = nrrd_header("gzip");
  header.replace(header.find("9 7 5"), 5, "1000 1000 300");
  header.replace(header.find("short"), 5, "double");
  const Told told = load("a.nrrd", header, false);
  ASSERT_TRUE(told.head);
  EXPECT_GE(told.head->reading_bytes, 3e8 * (8 + 2));
}

TEST_F(VolumeHeads, NothingIsSaidOfWhatIsTooSmall) {
  std::string flat = nrrd_header("raw");
  flat.replace(flat.find("9 7 5"), 5, "9 7 2");
  const Told told = load("a.nrrd", flat + raw_bytes(volume_));
  EXPECT_FALSE(told.head);
  ASSERT_FALSE(told.volume);
  EXPECT_NE(told.volume.error().message().find("9 x 7 x 2"), std::string::npos);
}

}  // namespace
}  // namespace osteon
