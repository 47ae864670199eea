#include <gtest/gtest.h>
#include <sqlite3.h>

#include <fstream>

#include "chunk.h"
#include "osteon/base/file.h"
#include "record_fixtures.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;
using testing::expect_prefix;
using testing::TempFolder;
using testing::write_recording;

// Runs SQL on a file behind the library's back.
void tamper(const fs::path& file, const std::string& sql) {
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(file.string().c_str(), &db), SQLITE_OK);
  char* message = nullptr;
  EXPECT_EQ(sqlite3_exec(db, sql.c_str(), nullptr, nullptr, &message), SQLITE_OK)
      << (message ? message : "");
  sqlite3_free(message);
  sqlite3_close(db);
}

std::span<const std::byte> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}

// A sound recording, then `sql`, then the loader's answer.
Result<Recording> load_tampered(const std::string& sql, std::uint64_t ticks = 1000) {
  TempFolder folder;
  const fs::path file = folder / "r.osr";
  write_recording(file, ticks);
  tamper(file, sql);
  return load_recording(file);
}

void expect_refused(const std::string& sql, const std::string& saying) {
  const auto loaded = load_tampered(sql);
  ASSERT_FALSE(loaded) << sql;
  const std::string message = loaded.error().message();
  EXPECT_NE(message.find(saying), std::string::npos) << sql << "\n" << message;
  EXPECT_NE(message.find("r.osr"), std::string::npos) << message;
  EXPECT_FALSE(loaded.error().todo.empty());
}

TEST(LoadRecording, RefusesWhatIsNoFile) {
  TempFolder folder;
  EXPECT_FALSE(load_recording(folder / "none.osr"));
  EXPECT_FALSE(load_recording(folder.path()));
  EXPECT_FALSE(fs::exists(folder / "none.osr"));
}

TEST(LoadRecording, RefusesWhatIsNoDatabase) {
  TempFolder folder;
  std::ofstream(folder / "empty.osr");
  EXPECT_FALSE(load_recording(folder / "empty.osr"));
  std::ofstream(folder / "text.osr") << std::string(5000, 'x');
  const auto loaded = load_recording(folder / "text.osr");
  ASSERT_FALSE(loaded);
  EXPECT_NE(loaded.error().what.find("not a recording"), std::string::npos);
}

TEST(LoadRecording, RefusesAnotherDatabase) {
  TempFolder folder;
  tamper(folder / "other.osr", "CREATE TABLE ticks(first); INSERT INTO ticks VALUES(1)");
  const auto loaded = load_recording(folder / "other.osr");
  ASSERT_FALSE(loaded);
  EXPECT_NE(loaded.error().what.find("not a recording of Osteon"), std::string::npos);
}

TEST(LoadRecording, RefusesAnotherVersionAndSaysWhatToDo) {
  expect_refused("PRAGMA user_version=1", "format 1");
  expect_refused("PRAGMA user_version=1", "record the run again");
  expect_refused("PRAGMA user_version=3", "format 3");
}

TEST(LoadRecording, RefusesOtherTables) {
  expect_refused("CREATE TABLE more(x)", "tables");
  expect_refused("CREATE VIEW extra AS SELECT * FROM ticks", "tables");
  expect_refused("ALTER TABLE ticks RENAME TO spare", "tables");
  // A view that never ends, in the place of a table.
  expect_refused(
      "DROP TABLE steps; CREATE VIEW steps AS WITH RECURSIVE n(first) AS (SELECT 1 UNION ALL "
      "SELECT first + 1 FROM n) SELECT first, first AS last, 1 AS count, x'' AS data, 0 AS "
      "checksum FROM n",
      "tables");
}

TEST(LoadRecording, RefusesADamagedHeader) {
  for (const char* key : {"case_name", "case_source", "case_hash", "seed", "settings_json",
                          "osteon_version", "checksum", "ticks", "steps"})
    expect_refused(std::string("DELETE FROM meta WHERE key='") + key + "'", key);
  expect_refused("UPDATE meta SET value='12x' WHERE key='seed'", "seed");
  expect_refused("UPDATE meta SET value='' WHERE key='case_hash'", "case_hash");
  expect_refused("UPDATE meta SET value='11112222333344445' WHERE key='case_hash'", "case_hash");
  expect_refused("UPDATE meta SET value='knee' WHERE key='case_name'", "checksum");
  expect_refused("UPDATE meta SET value=x'00' WHERE key='case_name'", "header");
}

TEST(LoadRecording, NamesADamagedChunk) {
  expect_refused("UPDATE ticks SET checksum=checksum+1 WHERE first=251", "ticks from 251");
  expect_refused("UPDATE ticks SET data=zeroblob(100) WHERE first=501", "ticks from 501");
  expect_refused("UPDATE steps SET data='text' WHERE first=1", "steps from 1 ");
}

TEST(LoadRecording, RefusesGaps) {
  expect_refused("DELETE FROM ticks WHERE first=251", "ticks from 251");
  expect_refused("UPDATE ticks SET first=252, last=501 WHERE first=251", "ticks from 251");
  expect_refused("DELETE FROM ticks WHERE first=1", "ticks from 1 ");
  expect_refused("DELETE FROM ticks WHERE first=751", "1000 ticks");
  expect_refused("DELETE FROM steps", "steps");
}

TEST(LoadRecording, RefusesAbsurdCounts) {
  for (const char* count : {"0", "-1", "251", "9223372036854775807"})
    expect_refused(std::string("UPDATE ticks SET count=") + count + " WHERE first=251",
                   "ticks from 251");
  expect_refused("UPDATE ticks SET last=last+1 WHERE first=251", "ticks from 251");
  expect_refused("UPDATE ticks SET count='many' WHERE first=251", "ticks from 251");
}

// Replaces the only chunk of steps by `steps`, with the right checksum.
Result<Recording> load_with_steps(const std::vector<StepRecord>& steps) {
  TempFolder folder;
  const fs::path file = folder / "r.osr";
  write_recording(file, 100);
  const std::string frame = encode_chunk(steps);
  sqlite3* db = nullptr;
  sqlite3_open(file.string().c_str(), &db);
  sqlite3_stmt* stmt = nullptr;
  sqlite3_prepare_v2(db, "UPDATE steps SET data=?, checksum=?", -1, &stmt, nullptr);
  sqlite3_bind_blob(stmt, 1, frame.data(), static_cast<int>(frame.size()), SQLITE_STATIC);
  sqlite3_bind_int64(stmt, 2, static_cast<sqlite3_int64>(chunk_checksum(frame, 1, steps.size())));
  EXPECT_EQ(sqlite3_step(stmt), SQLITE_DONE);
  sqlite3_finalize(stmt);
  sqlite3_close(db);
  return load_recording(file);
}

TEST(LoadRecording, RefusesStepsThatConsumedWhatIsNotThere) {
  std::vector<StepRecord> steps;
  for (std::uint64_t n = 1; n <= 50; ++n) steps.push_back(testing::step_record(n));
  EXPECT_TRUE(load_with_steps(steps));
  steps[20].tool_ticks[0] = 101;
  const auto loaded = load_with_steps(steps);
  ASSERT_FALSE(loaded);
  EXPECT_NE(loaded.error().message().find("step 21"), std::string::npos);
  EXPECT_NE(loaded.error().message().find("r.osr"), std::string::npos);
}

// What a broken copy still holds is read, and is never taken for all of it.
TEST(LoadRecording, ATruncatedFileIsIncomplete) {
  TempFolder folder;
  RecordingHeader header = testing::header();
  header.case_path.clear();  // as of a built-in case
  write_recording(folder / "r.osr", 2000, true, header);
  const std::string whole = *read_file(folder / "r.osr");
  std::size_t most = 0;
  int read = 0;
  // The last page may be a spare one.
  for (std::size_t size = 0; size + 4096 < whole.size(); size += whole.size() / 40) {
    std::ofstream(folder / "cut.osr", std::ios::binary) << whole.substr(0, size);
    const auto loaded = load_recording(folder / "cut.osr");
    EXPECT_EQ(*read_file(folder / "cut.osr"), whole.substr(0, size)) << "the file was changed";
    if (!loaded) {
      EXPECT_LT(size, whole.size() / 4) << loaded.error().message();
      EXPECT_NE(loaded.error().message().find("cut.osr"), std::string::npos);
      continue;
    }
    ++read;
    EXPECT_FALSE(loaded->complete) << size;
    EXPECT_GE(loaded->ticks.size(), most) << size;
    most = loaded->ticks.size();
    expect_prefix(*loaded);
  }
  EXPECT_GT(read, 25);
  EXPECT_GT(most, 1000u);
  EXPECT_LT(most, 2000u);
}

TEST(LoadRecording, AFlippedByteIsRefusedOrHarmless) {
  TempFolder folder;
  write_recording(folder / "r.osr", 1000);
  const std::string whole = *read_file(folder / "r.osr");
  Random random(7);
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    std::string damaged = whole;
    const auto at = static_cast<std::size_t>(random.uniform(0, double(whole.size())));
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << (i % 8)));
    const auto loaded = load_recording_from_memory(bytes_of(damaged));
    if (!loaded) {
      ++refused;
      continue;
    }
    // A byte that nobody reads (free space, a comment field): what is read is untouched.
    EXPECT_EQ(loaded->ticks.size(), 1000u) << at;
    EXPECT_EQ(loaded->header.settings_json, testing::header().settings_json) << at;
    expect_prefix(*loaded);
  }
  EXPECT_GT(refused, 150);
}

TEST(LoadRecording, FromMemoryIsTheSame) {
  TempFolder folder;
  write_recording(folder / "r.osr", 777);
  const auto loaded = load_recording_from_memory(bytes_of(*read_file(folder / "r.osr")));
  ASSERT_TRUE(loaded) << loaded.error().message();
  EXPECT_TRUE(loaded->complete);
  EXPECT_EQ(loaded->ticks.size(), 777u);
  expect_prefix(*loaded);
}

TEST(LoadRecording, FromMemoryRefusesRubbish) {
  EXPECT_FALSE(load_recording_from_memory({}));
  EXPECT_FALSE(load_recording_from_memory(bytes_of(std::string(99, 'a'))));
  EXPECT_FALSE(load_recording_from_memory(bytes_of(std::string(100000, 'a'))));
  EXPECT_FALSE(load_recording_from_memory(bytes_of("SQLite format 3" + std::string(4096, '\0'))));
}

TEST(LoadRecording, LeavesAFinishedFileAsItWas) {
  TempFolder folder;
  write_recording(folder / "r.osr", 500);
  const std::string before = *read_file(folder / "r.osr");
  ASSERT_TRUE(load_recording(folder / "r.osr"));
  EXPECT_EQ(*read_file(folder / "r.osr"), before);
}

}  // namespace
}  // namespace osteon
