#include "segment/scan_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "osteon/image/dicom.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

class ScanFolders : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    dir_ = fs::temp_directory_path() /
           ("osteon_folder_" + std::string(info->name()) + std::to_string(::getpid()));
    fs::create_directories(dir_);
  }
  void TearDown() override { fs::remove_all(dir_); }
  void touch(const std::string& name) { std::ofstream(dir_ / name) << "x"; }
  fs::path dir_;
};

TEST_F(ScanFolders, WhatIsNotThereIsSaid) {
  const ScanFolder gone = list_scan_folder(dir_ / "gone");
  EXPECT_FALSE(gone.problem.empty());
  EXPECT_TRUE(gone.entries.empty());
  const ScanFolder empty = list_scan_folder(dir_);
  EXPECT_TRUE(empty.problem.empty());
  EXPECT_TRUE(empty.entries.empty());
  EXPECT_EQ(empty.dicom_files + empty.pictures, 0u);
}

TEST_F(ScanFolders, FoldersComeFirstAndOnlyScansAreListed) {
  for (const char* name : {"b.nrrd", "a.nii.gz", "C.MHA", "notes.txt", ".hidden.nrrd", "x.inv3"})
    touch(name);
  fs::create_directories(dir_ / "z_folder");
  fs::create_directories(dir_ / ".git");
  const ScanFolder folder = list_scan_folder(dir_ / "z_folder" / "..");
  EXPECT_EQ(folder.path, fs::absolute(dir_).lexically_normal());
  std::vector<std::string> names;
  for (const ScanFolder::Entry& entry : folder.entries) names.push_back(entry.name);
  EXPECT_EQ(names, (std::vector<std::string>{"z_folder", "C.MHA", "a.nii.gz", "b.nrrd", "x.inv3"}));
  EXPECT_TRUE(folder.entries[0].is_folder);
  EXPECT_FALSE(folder.entries[1].is_folder);
  EXPECT_EQ(folder.entries[2].path, dir_ / "a.nii.gz");
}

TEST_F(ScanFolders, DicomIsSeenByItsEndingOrItsStart) {
  GridFrame frame;
  frame.size = {3, 3, 3};
  ASSERT_TRUE(write_dicom({frame, std::vector<std::int16_t>(27)}, dir_));
  fs::rename(dir_ / "0002.dcm", dir_ / "IM002");
  touch("IM009");
  const ScanFolder folder = list_scan_folder(dir_);
  EXPECT_EQ(folder.dicom_files, 3u);
  EXPECT_EQ(folder.pictures, 0u);
  EXPECT_TRUE(folder.entries.empty());
}

TEST_F(ScanFolders, PicturesAreCounted) {
  for (const char* name : {"s1.png", "s2.TIF", "s3.tiff"}) touch(name);
  EXPECT_EQ(list_scan_folder(dir_).pictures, 3u);
  EXPECT_EQ(list_scan_folder(dir_).dicom_files, 0u);
}

TEST_F(ScanFolders, WhatIsDroppedTogetherIsOneScan) {
  EXPECT_FALSE(scan_among({}));
  EXPECT_FALSE(scan_among({"/a/1.dcm", "/b/2.dcm"}));
  EXPECT_EQ(*scan_among({"/a/ct.nrrd"}), "/a/ct.nrrd");
  EXPECT_EQ(*scan_among({"/a/ct/"}), "/a/ct");
  EXPECT_EQ(*scan_among({"/a/1.dcm", "/a/2.dcm", "/a/3"}), "/a");
}

}  // namespace
}  // namespace osteon
