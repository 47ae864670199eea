// Files of every format, made byte by byte, then spoilt.
#include "files/volume_files.h"

#include "../slice_files.h"
#include "../temp_folder.h"
#include "../volume_bytes.h"
#include "osteon/image/load_volume.h"

namespace osteon {
namespace {

void expect_same(const Result<Volume>& got, const Volume& wanted) {
  ASSERT_TRUE(got) << got.error().message();
  EXPECT_EQ(got->frame.size, wanted.frame.size);
  EXPECT_LT((got->frame.spacing_m - wanted.frame.spacing_m).norm(), 1e-9);
  EXPECT_LT((got->frame.axes_P - wanted.frame.axes_P).norm(), 1e-6);
  EXPECT_LT((got->frame.origin_P - wanted.frame.origin_P).norm(), 1e-8);
  EXPECT_EQ(got->values, wanted.values);
}

class VolumeFiles : public TempFolder {
 protected:
  Result<Volume> load(const std::string& name, const std::string& bytes) {
    write(file(name), bytes);
    return load_volume(file(name));
  }
  void expect_refused(const std::string& name, const std::string& bytes, const std::string& says) {
    const auto volume = load(name, bytes);
    ASSERT_FALSE(volume) << says;
    EXPECT_NE(volume.error().message().find(says), std::string::npos) << volume.error().message();
    EXPECT_NE(volume.error().message().find(name), std::string::npos) << volume.error().message();
    EXPECT_FALSE(volume.error().todo.empty());
  }
  Volume volume_ = noise_volume(small_frame(), 5);
};

TEST_F(VolumeFiles, NrrdRawGzipBigEndianAndDetached) {
  const std::string raw = raw_bytes(volume_);
  expect_same(load("a.nrrd", nrrd_header("raw") + raw), volume_);
  expect_same(load("b.nrrd", nrrd_header("gzip") + gzip(raw)), volume_);
  std::string big = nrrd_header("raw");
  big.replace(big.find("little"), 6, "big");
  expect_same(load("c.nrrd", big + swapped(raw)), volume_);
  write(file("d.raw"), raw);
  expect_same(load("d.nhdr", nrrd_header("raw", "data file: d.raw\n")), volume_);
}

TEST_F(VolumeFiles, NrrdInRasIsTurnedIntoLps) {
  std::string header = nrrd_header("raw");
  header.replace(header.find("left-posterior"), 14, "right-anterior");
  const auto volume = load("a.nrrd", header + raw_bytes(volume_));
  ASSERT_TRUE(volume) << volume.error().message();
  EXPECT_LT(
      (volume->frame.point_P(Vec3(1, 2, 3)) - Vec3(0.012 - 0.0004, -0.034 - 0.0012, 0.1033)).norm(),
      1e-9);
  EXPECT_EQ(volume->at(1, 2, 3), volume_.at(1, 2, 3));
}

// A left-handed grid becomes right-handed; every voxel stays where it is in the patient.
TEST_F(VolumeFiles, LeftHandedAxesKeepEveryVoxelInItsPlace) {
  std::string header = nrrd_header("raw");
  header.replace(header.find("(0,0,1.1)"), 9, "(0,0,-1.1)");
  const auto volume = load("a.nrrd", header + raw_bytes(volume_));
  ASSERT_TRUE(volume) << volume.error().message();
  EXPECT_NEAR(volume->frame.axes_P.determinant(), 1, 1e-9);
  for (const Vec3& ijk : {Vec3(0, 0, 0), Vec3(3, 2, 1), Vec3(8, 6, 4)}) {
    const Vec3 p_P = Vec3(-0.012, 0.034, 0.1) + Vec3(0.0004, 0.0006, -0.0011).cwiseProduct(ijk);
    EXPECT_NEAR(
        sample_linear(*volume, volume->frame.voxel(p_P)),
        volume_.at(static_cast<int>(ijk.x()), static_cast<int>(ijk.y()), static_cast<int>(ijk.z())),
        1e-3);
  }
}

TEST_F(VolumeFiles, BadNrrdIsNamed) {
  const std::string raw = raw_bytes(volume_);
  const auto with = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const std::string good = nrrd_header("raw");
  expect_refused("a.nrrd", "PNG", "not an NRRD");
  expect_refused("a.nrrd", good + raw.substr(2), "truncated");
  expect_refused("a.nrrd", nrrd_header("gzip") + gzip(raw).substr(0, 300), "ends early");
  expect_refused("a.nrrd", nrrd_header("bzip2") + raw, "encoding 'bzip2'");
  expect_refused("a.nrrd", with(good, "short", "block") + raw, "'block'");
  expect_refused("a.nrrd", with(good, "dimension: 3", "dimension: 4") + raw, "three-dimensional");
  expect_refused("a.nrrd", with(good, "9 7 5", "9 -7 5") + raw, "impossible size");
  expect_refused("a.nrrd", with(good, "9 7 5", "60000 60000 60000") + raw, "1200 million");
  expect_refused("a.nrrd", with(good, "(0.4,0,0)", "(0,0,0)") + raw, "spacing");
  expect_refused("a.nrrd", with(good, "(0.4,0,0)", "(400,0,0)") + raw, "spacing outside");
  expect_refused("a.nrrd", with(good, "(0.4,0,0)", "(0.4,0.3,0)") + raw, "right angles");
  expect_refused("a.nrrd", nrrd_header("raw", "data file: ../../secret\n") + raw, "same folder");
  std::string flat = with(good, "9 7 5", "9 7 2");
  expect_refused("a.nrrd", flat + raw, "9 x 7 x 2");
}

TEST_F(VolumeFiles, MetaImageLocalDetachedAndPacked) {
  const std::string raw = raw_bytes(volume_);
  expect_same(load("a.mha", meta_header("", "LOCAL") + raw), volume_);
  expect_same(load("b.mha", meta_header("CompressedData = True\n", "LOCAL") + gzip(raw)), volume_);
  write(file("c.raw"), "head" + raw);
  expect_same(load("c.mhd", meta_header("HeaderSize = -1\n", "c.raw")), volume_);
}

TEST_F(VolumeFiles, BadMetaImageIsNamed) {
  const std::string raw = raw_bytes(volume_);
  expect_refused("a.mha", "nonsense", "not a MetaImage");
  expect_refused("a.mha", meta_header("", "LOCAL") + raw.substr(1), "truncated");
  expect_refused("a.mhd", meta_header("", "/etc/passwd"), "same folder");
  const auto none = load("a.mhd", meta_header("", "none.raw"));
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message().find("none.raw"), std::string::npos);
  std::string header = meta_header("", "LOCAL");
  header.replace(header.find("ElementSpacing = 0.4"), 20, "ElementSpacing = 0.0");
  expect_refused("a.mha", header + raw, "spacing");
}

TEST_F(VolumeFiles, NiftiEitherEndianEitherFormPackedOrNot) {
  for (const bool big : {false, true})
    for (const bool sform : {false, true}) {
      const auto volume = load("a.nii", nifti(volume_, big, sform));
      ASSERT_TRUE(volume) << volume.error().message();
      EXPECT_EQ(volume->values, volume_.values);
      EXPECT_LT(
          (volume->frame.point_P(Vec3(2, 3, 4)) - volume_.frame.point_P(Vec3(2, 3, 4))).norm(),
          1e-7);
    }
  const auto packed = load("b.nii.gz", gzip(nifti(volume_, false, true)));
  ASSERT_TRUE(packed) << packed.error().message();
  EXPECT_EQ(packed->values, volume_.values);
}

TEST_F(VolumeFiles, NiftiSlopeApplies) {
  std::string bytes = nifti(volume_, false, true);
  set(bytes, 112, 2.0f);
  set(bytes, 116, -10.0f);
  const auto volume = load("a.nii", bytes);
  ASSERT_TRUE(volume);
  EXPECT_EQ(volume->values[7], 2 * volume_.values[7] - 10);
}

TEST_F(VolumeFiles, BadNiftiIsNamed) {
  const std::string good = nifti(volume_, false, true);
  expect_refused("a.nii", good.substr(0, 200), "truncated");
  expect_refused("a.nii", good.substr(0, 500), "truncated");
  expect_refused("a.nii", std::string(400, 'x'), "NIfTI-1");
  expect_refused("a.nii.gz", gzip(good).substr(0, 200), "ends early");
  std::string bad = good;
  set<std::int16_t>(bad, 70, 128);
  expect_refused("a.nii", bad, "type 128");
  bad = good;
  set<std::int16_t>(bad, 42, -9);
  expect_refused("a.nii", bad, "impossible size");
  bad = good;
  set(bad, 108, 1e9f);
  expect_refused("a.nii", bad, "after its end");
}

// InVesalius stores the rows of a slice from the back to the front.
TEST_F(VolumeFiles, Inv3) {
  Volume wanted = volume_;
  wanted.frame.origin_P = Vec3::Zero();
  const auto& size = wanted.frame.size;
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i) wanted.at(i, j, k) = volume_.at(i, size[1] - 1 - j, k);
  expect_same(load("a.inv3", inv3(plist("int16", "CT"), raw_bytes(volume_))), wanted);
}

TEST_F(VolumeFiles, BadInv3IsNamed) {
  const std::string raw = raw_bytes(volume_), good = inv3(plist("int16", "CT"), raw);
  expect_refused("a.inv3", "x", "ends early");
  expect_refused("a.inv3", good.substr(0, good.size() / 2), "ends early");
  expect_refused("a.inv3", gzip("no archive, but long enough" + std::string(600, 'x')), "damaged");
  expect_refused("a.inv3", inv3(plist("int16", "MRI"), raw), "'MRI'");
  expect_refused("a.inv3", inv3(plist("uint8", "CT"), raw), "16-bit");
  expect_refused("a.inv3", inv3("<dict></dict>", raw), "16-bit");
  expect_refused("a.inv3", inv3(plist("int16", "CT"), raw.substr(9)), "truncated");
}

TEST_F(VolumeFiles, PictureStacksInTheOrderOfTheirNumbers) {
  for (int k = 0; k < 12; ++k) {
    TestSlice slice(6, 4, static_cast<std::uint16_t>(1024 + 100 * k));
    slice.at(1, 2) = 1000;
    const std::string name = "s" + std::to_string(k);
    if (k % 2) write_png_slice(slice, file(name + ".png"));
    if (k % 2 == 0) write_tiff_slice(slice, file(name + ".tif"));
  }
  EXPECT_FALSE(load_volume(dir_));
  LoadVolumeOptions options;
  options.spacing_m = Vec3(0.001, 0.001, 0.002);
  const auto volume = load_volume(dir_, options);
  ASSERT_TRUE(volume) << volume.error().message();
  EXPECT_EQ(volume->frame.size, (std::array<int, 3>{6, 4, 12}));
  for (int k = 0; k < 12; ++k) EXPECT_EQ(volume->at(0, 0, k), 100 * k);
  EXPECT_EQ(volume->at(2, 1, 5), -24);
  write_png_slice(TestSlice(6, 4, 3, 8), file("s5.png"));
  EXPECT_NE(load_volume(dir_, options).error().message().find("16 bits"), std::string::npos);
  write(file("s5.png"), "broken");
  EXPECT_NE(load_volume(dir_, options).error().message().find("s5.png"), std::string::npos);
}

// The room for a picture is taken by what its header says: it must be refused before.
TEST_F(VolumeFiles, PicturesThatClaimToBeHugeAreRefusedUnseen) {
  std::string png("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\x75\x30\0\0\x75\x30\x10\0\0\0\0", 29);
  const auto huge = load_volume_from_memory(png, "png", "s.png");
  ASSERT_FALSE(huge);
  EXPECT_NE(huge.error().message().find("30000 x 30000"), std::string::npos)
      << huge.error().message();
  std::string tiff("MM\0\x2a\0\0\0\x08\0\x02", 10);
  tiff += std::string("\x01\0\0\x04\0\0\0\x01\0\0\x75\x30", 12);
  tiff += std::string("\x01\x01\0\x03\0\0\0\x01\0\x09\0\0", 12);
  const auto wide = load_volume_from_memory(tiff, "png", "s.tif");
  ASSERT_FALSE(wide);
  EXPECT_NE(wide.error().message().find("30000 x 9"), std::string::npos) << wide.error().message();
  EXPECT_FALSE(load_volume_from_memory("", "png", "s.png"));
  EXPECT_FALSE(load_volume_from_memory(std::string("II\x2a\0", 4), "png", "s.tif"));
}

TEST_F(VolumeFiles, UnknownFilesAreRefused) {
  expect_refused("a.txt", "hello", "not a scan format");
  EXPECT_FALSE(load_volume(file("nothing")));
}

}  // namespace
}  // namespace osteon
