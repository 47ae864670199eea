// What is felt of soft parts is kept in the user's cache, and is the same with it and without.
#include "runs/hands/tray.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "cases/open_case.h"
#include "osteon/physics/soft_setup.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

class SoftsKept : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const char* before = std::getenv("XDG_CACHE_HOME")) before_ = before;
    fs::remove_all(dir_);
    ::setenv("XDG_CACHE_HOME", dir_.c_str(), 1);
    settings_.soft = {"tfcc"};
  }
  void TearDown() override {
    if (before_.empty())
      ::unsetenv("XDG_CACHE_HOME");
    else
      ::setenv("XDG_CACHE_HOME", before_.c_str(), 1);
    fs::remove_all(dir_);
  }
  std::uint64_t made(const Case& the_case) const {
    const auto softs = softs_for(the_case, settings_);
    EXPECT_TRUE(softs) << softs.error().message();
    return softs ? (*softs)->hash : 0;
  }
  fs::path file() const {
    for (const auto& entry : fs::directory_iterator(dir_ / "osteon"))
      if (entry.path().filename().string().starts_with("fields-soft-")) return entry.path();
    return {};
  }
  fs::path dir_ = fs::path(::testing::TempDir()) / "softs_kept";
  std::string before_;
  SessionSettings settings_;
};

TEST_F(SoftsKept, FieldsComeFromTheCacheAndAreMadeAgainWhereItIsDamaged) {
  const auto wrist = open_case("builtin:wrist#hull");
  ASSERT_TRUE(wrist) << wrist.error().message();
  const std::uint64_t hash = made(**wrist);
  const fs::path kept = file();
  ASSERT_FALSE(kept.empty());
  const auto bytes = fs::file_size(kept);
  EXPECT_GT(bytes, 100000u);
  EXPECT_EQ(made(**wrist), hash);
  fs::resize_file(kept, bytes / 2);
  EXPECT_EQ(made(**wrist), hash);
  EXPECT_EQ(fs::file_size(kept), bytes) << "kept anew";
  // A folder that cannot be written stops nothing.
  fs::remove_all(dir_);
  std::ofstream(dir_) << "no folder";
  EXPECT_EQ(made(**wrist), hash);
}

}  // namespace
}  // namespace osteon
