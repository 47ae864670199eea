#include "osteon/scene/piece_cache.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <limits>
#include <string>

#include "osteon/base/file.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

PieceCorners some_pieces() {
  return {{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}, {Vec3(0.1, -2, 1e-9)}},
          0.00012};
}

class PieceCacheFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("osteon_pieces_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path file() const { return folder_ / "deep" / "pieces.bin"; }
  fs::path folder_;
};

TEST(PieceBytes, ComeBackAsTheyWere) {
  const auto read = read_pieces(to_bytes({{7, some_pieces()}, {9, {}}}));
  ASSERT_TRUE(read);
  ASSERT_EQ(read->size(), 2u);
  EXPECT_EQ(read->at(7).pieces, some_pieces().pieces);
  EXPECT_EQ(read->at(7).concavity_m, 0.00012);
  EXPECT_TRUE(read->at(9).pieces.empty());
}

TEST(PieceBytes, DamageIsNoticed) {
  const std::string good = to_bytes({{7, some_pieces()}});
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_FALSE(read_pieces(good.substr(0, size))) << size;
  EXPECT_FALSE(read_pieces(good + "x"));
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x10);
    EXPECT_FALSE(read_pieces(bad)) << i;
  }
}

TEST(PieceBytes, NotANumberIsNoticedThoughTheChecksumAgrees) {
  PieceCorners pieces = some_pieces();
  pieces.pieces[0][1].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(read_pieces(to_bytes({{7, pieces}})));
}

TEST_F(PieceCacheFile, AMissingOrBrokenFileIsAnEmptyCache) {
  EXPECT_EQ(PieceCache(file()).find(7), nullptr);
  fs::create_directories(file().parent_path());
  ASSERT_TRUE(write_file_atomic(file(), "something else"));
  EXPECT_EQ(PieceCache(file()).find(7), nullptr);
}

TEST_F(PieceCacheFile, KeepsWhatIsInUseAndDropsTheRest) {
  PieceCache first(file());
  first.put(7, some_pieces());
  first.put(8, {});
  ASSERT_TRUE(first.save());
  PieceCache second(file());
  ASSERT_NE(second.find(7), nullptr);
  EXPECT_EQ(second.find(7)->pieces, some_pieces().pieces);
  second.put(9, {});
  ASSERT_TRUE(second.save());
  PieceCache third(file());
  EXPECT_NE(third.find(7), nullptr);
  EXPECT_EQ(third.find(8), nullptr);
  EXPECT_NE(third.find(9), nullptr);
}

TEST_F(PieceCacheFile, WithoutChangesNothingIsWritten) {
  PieceCache cache(file());
  ASSERT_TRUE(cache.save());
  EXPECT_FALSE(fs::exists(file()));
}

}  // namespace
}  // namespace osteon
