#include "osteon/base/file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

namespace osteon {
namespace fs = std::filesystem;
namespace {

class FileTest : public testing::Test {
 protected:
  void SetUp() override {
    dir_ = fs::temp_directory_path() / ("osteon_file_" + std::to_string(::getpid()));
    fs::create_directories(dir_);
  }
  void TearDown() override { fs::remove_all(dir_); }
  fs::path dir_;
};

TEST_F(FileTest, AMissingFileSaysWhichAndWhy) {
  const auto r = read_file(dir_ / "nothing");
  ASSERT_FALSE(r);
  EXPECT_NE(r.error().message().find("nothing"), std::string::npos);
  EXPECT_NE(r.error().message().find("No such file"), std::string::npos);
}

TEST_F(FileTest, AFolderIsNotAFile) { EXPECT_FALSE(read_file(dir_)); }

TEST_F(FileTest, RefusesAFileOverTheLimit) {
  ASSERT_TRUE(write_file_atomic(dir_ / "f", std::string(100, 'x')));
  EXPECT_FALSE(read_file(dir_ / "f", 99));
  EXPECT_TRUE(read_file(dir_ / "f", 100));
}

TEST_F(FileTest, WhatIsWrittenIsRead) {
  const std::string bytes("a\0b\xff\n", 5);
  ASSERT_TRUE(write_file_atomic(dir_ / "f", bytes));
  EXPECT_EQ(read_file(dir_ / "f").value(), bytes);
}

TEST_F(FileTest, AFullDiskLeavesTheOldContent) {
  ASSERT_TRUE(write_file_atomic(dir_ / "f", "old"));
  // A file-size limit fails a write as a full disk does.
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const auto r = write_file_atomic(dir_ / "f", std::string(5000, 'n'));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_FALSE(r);
  EXPECT_EQ(read_file(dir_ / "f").value(), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(dir_), {}), 1) << "a temporary file was left";
}

TEST_F(FileTest, ALinkStaysAndItsTargetIsReplaced) {
  ASSERT_TRUE(write_file_atomic(dir_ / "target", "old"));
  fs::create_symlink("target", dir_ / "link");      // relative
  fs::create_symlink(dir_ / "link", dir_ / "far");  // a link to a link
  ASSERT_TRUE(write_file_atomic(dir_ / "far", "new"));
  EXPECT_TRUE(fs::is_symlink(dir_ / "link"));
  EXPECT_TRUE(fs::is_symlink(dir_ / "far"));
  EXPECT_FALSE(fs::is_symlink(dir_ / "target"));
  EXPECT_EQ(read_file(dir_ / "target").value(), "new");
}

TEST_F(FileTest, ALinkToNothingGetsItsTarget) {
  fs::create_symlink("later", dir_ / "link");
  ASSERT_TRUE(write_file_atomic(dir_ / "link", "x"));
  EXPECT_TRUE(fs::is_symlink(dir_ / "link"));
  EXPECT_EQ(read_file(dir_ / "later").value(), "x");
}

TEST_F(FileTest, LinksInACircleAreAnError) {
  fs::create_symlink("a", dir_ / "b");
  fs::create_symlink("b", dir_ / "a");
  EXPECT_FALSE(write_file_atomic(dir_ / "a", "x"));
  EXPECT_TRUE(fs::is_symlink(dir_ / "a"));
}

TEST_F(FileTest, AFullDeviceIsAnErrorAndStaysADevice) {
  fs::create_symlink("/dev/full", dir_ / "link");
  const auto r = write_file_atomic(dir_ / "link", "x");
  ASSERT_FALSE(r);
  EXPECT_NE(r.error().message().find("No space left"), std::string::npos) << r.error().message();
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
  EXPECT_TRUE(fs::is_symlink(dir_ / "link"));
}

TEST_F(FileTest, APipeIsWrittenThrough) {
  const std::string pipe = (dir_ / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int end = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(end, 0);
  ASSERT_TRUE(write_file_atomic(pipe, "through"));
  char got[16] = {};
  EXPECT_EQ(::read(end, got, sizeof got), 7);
  ::close(end);
  EXPECT_STREQ(got, "through");
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(FileTest, AnOpenFileIsWrittenWhereItStands) {
  const std::string file = (dir_ / "open").string();
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT, 0600);
  ASSERT_EQ(::write(descriptor, "before ", 7), 7);
  ASSERT_TRUE(write_file_atomic("/dev/fd/" + std::to_string(descriptor), "new "));
  ASSERT_EQ(::write(descriptor, "after", 5), 5);
  ::close(descriptor);
  EXPECT_EQ(read_file(file).value(), "before new after");
}

TEST_F(FileTest, AFolderIsNoPlaceToWriteTo) {
  fs::create_directories(dir_ / "folder");
  const auto r = write_file_atomic(dir_ / "folder", "x");
  ASSERT_FALSE(r);
  EXPECT_NE(r.error().message().find("folder"), std::string::npos);
}

TEST_F(FileTest, AMissingFolderIsAnError) {
  EXPECT_FALSE(write_file_atomic(dir_ / "no" / "f", "x"));
}

TEST_F(FileTest, DataDirFollowsItsVariable) {
  ::setenv("OSTEON_DATA", dir_.c_str(), 1);
  EXPECT_FALSE(find_data_dir());
  fs::create_directories(dir_ / "assets");
  fs::create_directories(dir_ / "shaders");
  const auto r = find_data_dir();
  ::unsetenv("OSTEON_DATA");
  ASSERT_TRUE(r);
  EXPECT_EQ(*r, dir_);
}

}  // namespace
}  // namespace osteon
