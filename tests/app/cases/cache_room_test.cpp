#include "cases/cache_room.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <string>

namespace osteon {
namespace {

namespace fs = std::filesystem;

class CacheRoom : public ::testing::Test {
 protected:
  CacheRoom() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~CacheRoom() override { fs::remove_all(folder_); }

  // A file that was used so many hours ago.
  fs::path make(const std::string& name, std::size_t bytes, int hours) {
    const fs::path file = folder_ / name;
    std::ofstream(file) << std::string(bytes, 'x');
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(hours));
    return file;
  }

  fs::path folder_ =
      fs::path(::testing::TempDir()) / ("osteon_cache_room_" + std::to_string(::getpid()));
};

TEST_F(CacheRoom, AFolderThatIsNotThereIsNoError) {
  keep_cache_room(folder_ / "nowhere", folder_ / "nowhere/fields-a.bin", 0);
  note_use(folder_ / "nowhere/fields-a.bin");
  EXPECT_FALSE(fs::exists(folder_ / "nowhere"));
}

TEST_F(CacheRoom, WithinItsRoomNothingGoes) {
  const fs::path old = make("fields-a.bin", 500, 9), last = make("fields-b.bin", 500, 1);
  keep_cache_room(folder_, last, 1000);
  EXPECT_TRUE(fs::exists(old));
}

TEST_F(CacheRoom, TheLongestUnusedGoFirst) {
  const fs::path oldest = make("fields-a.bin", 400, 9), used = make("pieces-b.bin", 400, 8);
  const fs::path older = make("pieces-c.bin", 400, 7), last = make("fields-d.bin", 400, 1);
  note_use(used);
  note_use(last);
  keep_cache_room(folder_, last, 900);
  EXPECT_FALSE(fs::exists(oldest));
  EXPECT_FALSE(fs::exists(older));
  EXPECT_TRUE(fs::exists(used));
  EXPECT_TRUE(fs::exists(last));
}

TEST_F(CacheRoom, NothingElseGoesAndNotWhatWasJustWritten) {
  const fs::path picture = make("picture.png", 5000, 9), other = make("experts.bin", 5000, 9);
  const fs::path last = make("fields-d.bin", 5000, 0);
  keep_cache_room(folder_, last, 10);
  EXPECT_TRUE(fs::exists(picture));
  EXPECT_TRUE(fs::exists(other));
  EXPECT_TRUE(fs::exists(last));
}

}  // namespace
}  // namespace osteon
