#include "osteon/results/store.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <set>

#include "osteon/base/file.h"
#include "osteon/base/random.h"
#include "results/attempts.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

using test::row_of, test::uuid_of;

class StoreTest : public ::testing::Test {
 protected:
  void SetUp() override {
    dir_ = fs::temp_directory_path() / ("osteon_results_" + std::to_string(::getpid()));
    fs::remove_all(dir_);
    fs::create_directories(dir_);
  }
  void TearDown() override { fs::remove_all(dir_); }
  ResultStore open() {
    auto store = ResultStore::open(dir_ / "results.sqlite");
    EXPECT_TRUE(store) << store.error().message();
    return std::move(*store);
  }
  fs::path dir_;
};

TEST_F(StoreTest, OfNothingIsEmpty) {
  ResultStore store = open();
  EXPECT_TRUE(store.list()->empty());
  EXPECT_FALSE(store.find(uuid_of(1, 1))->has_value());
  EXPECT_EQ(*store.forget("nobody"), 0);
}

TEST_F(StoreTest, KeepsWhatItIsGivenInTheOrderOfGiving) {
  ResultStore store = open();
  for (int n = 0; n < 3; ++n) EXPECT_TRUE(*store.add(row_of(1, n)));
  AttemptRow bare = row_of(2, 0);
  bare.score = bare.score_lo = bare.score_hi = std::nullopt;
  EXPECT_TRUE(*store.add(bare));
  const auto rows = open().list();
  ASSERT_EQ(rows->size(), 4u);
  EXPECT_EQ((*rows)[0], row_of(1, 0));  // though its clock was later
  EXPECT_EQ((*rows)[3], bare);
  EXPECT_EQ(open().list({"learner_1", ""})->size(), 3u);
  EXPECT_EQ(open().list({"", "other"})->size(), 0u);
}

TEST_F(StoreTest, AnAttemptIsWrittenOnce) {
  ResultStore store = open();
  EXPECT_TRUE(*store.add(row_of(1, 0)));
  EXPECT_FALSE(*store.add(row_of(1, 0)));
  AttemptRow forged = row_of(1, 0);
  forged.verdict = "passed";
  EXPECT_FALSE(store.add(forged));
  EXPECT_EQ(store.list()->size(), 1u);
  EXPECT_EQ((*store.find(uuid_of(1, 0)))->verdict, "not_passed");
}

TEST_F(StoreTest, ForgettingLeavesNoTraceInTheFile) {
  ResultStore store = open();
  for (int n = 0; n < 5; ++n) (void)store.add(row_of(7, n));
  (void)store.add(row_of(8, 0));
  EXPECT_EQ(*store.forget("learner_7"), 5);
  EXPECT_EQ(store.list()->size(), 1u);
  for (const auto& entry : fs::directory_iterator(dir_)) {
    const auto bytes = read_file(entry.path());
    ASSERT_TRUE(bytes);
    EXPECT_EQ(bytes->find("learner_7"), std::string::npos) << entry.path();
  }
}

TEST_F(StoreTest, RefusesOtherFilesAndKeepsThem) {
  std::ofstream(dir_ / "results.sqlite") << "my diary, which is long enough to be a page of text";
  const auto store = ResultStore::open(dir_ / "results.sqlite");
  ASSERT_FALSE(store);
  EXPECT_NE(store.error().what.find("not a results file"), std::string::npos);
  EXPECT_EQ(read_file(dir_ / "results.sqlite")->substr(0, 8), "my diary");
  EXPECT_FALSE(ResultStore::open(dir_ / "results.sqlite" / "below_a_file.sqlite"));
}

TEST_F(StoreTest, OfANewerFormatIsRefused) {
  open();
  sqlite3* db = nullptr;
  sqlite3_open((dir_ / "results.sqlite").c_str(), &db);
  sqlite3_exec(db, "PRAGMA user_version=99", nullptr, nullptr, nullptr);
  sqlite3_close(db);
  const auto store = ResultStore::open(dir_ / "results.sqlite");
  ASSERT_FALSE(store);
  EXPECT_NE(store.error().what.find("newer"), std::string::npos);
}

TEST_F(StoreTest, WhatTheLockedStoreCannotTakeWaitsAndIsTakenLater) {
  ResultStore store = open();
  sqlite3* db = nullptr;
  sqlite3_open((dir_ / "results.sqlite").c_str(), &db);
  sqlite3_exec(db, "BEGIN EXCLUSIVE", nullptr, nullptr, nullptr);
  const auto kept = keep_attempt(row_of(1, 0), dir_ / "results.sqlite", dir_ / "waiting", 0.01);
  ASSERT_TRUE(kept) << kept.error().message();
  EXPECT_FALSE(kept->in_store);
  EXPECT_NE(kept->why_waiting->what.find("locked"), std::string::npos);
  EXPECT_NE(kept->why_waiting->todo.find("waits in"), std::string::npos);
  sqlite3_exec(db, "ROLLBACK", nullptr, nullptr, nullptr);
  sqlite3_close(db);
  EXPECT_EQ(*take_waiting(store, dir_ / "waiting"), 1);
  EXPECT_EQ(*take_waiting(store, dir_ / "waiting"), 0);
  ASSERT_EQ(store.list()->size(), 1u);
  EXPECT_EQ(store.list()->at(0), row_of(1, 0));
}

// A limit on the size of files is what a full disk looks like to SQLite.
TEST_F(StoreTest, OfAFullDiskChangesNothingAndFails) {
  { EXPECT_TRUE(*open().add(row_of(1, 0))); }
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{200000, 200000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    AttemptRow large = row_of(2, 0);
    large.report_json.assign(4u << 20, 'x');
    auto mine = ResultStore::open(dir_ / "results.sqlite");
    if (!mine) ::_exit(2);
    ::_exit(mine->add(large) ? 3 : 0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  ASSERT_EQ(open().list()->size(), 1u);
  EXPECT_EQ(open().list()->at(0), row_of(1, 0));
}

// Writers that add attempts, say after each that it is in, and are killed at any moment.
TEST_F(StoreTest, TwentyWritersKilledAtRandomLoseAndDoubleNothing) {
  constexpr int kWriters = 20, kEach = 12;
  const fs::path file = dir_ / "results.sqlite";
  open();
  int said[2];
  ASSERT_EQ(::pipe(said), 0);
  std::vector<pid_t> writers;
  for (int w = 0; w < kWriters; ++w) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child > 0) {
      writers.push_back(child);
      continue;
    }
    auto store = ResultStore::open(file, 60);
    if (!store) ::_exit(1);
    for (int n = 0; n < kEach; ++n) {
      if (!store->add(row_of(w, n))) ::_exit(1);
      const int done[2] = {w, n};
      if (::write(said[1], done, sizeof done) != sizeof done) ::_exit(1);
    }
    ::_exit(0);
  }
  ::close(said[1]);
  // Every few attempts that are said to be in, one writer dies.
  Random random(5);
  std::set<std::string> in;
  int done[2];
  while (::read(said[0], done, sizeof done) == sizeof done) {
    in.insert(uuid_of(done[0], done[1]));
    if (random.uniform() < 0.1) ::kill(writers[random.next() % kWriters], SIGKILL);
  }
  ::close(said[0]);
  for (const pid_t child : writers) ::waitpid(child, nullptr, 0);

  ResultStore store = open();
  std::set<std::string> kept;
  const auto rows = store.list();
  ASSERT_TRUE(rows);
  for (const AttemptRow& row : *rows) {
    EXPECT_TRUE(kept.insert(row.id).second) << row.id << " is there twice";
  }
  for (const std::string& id : in) EXPECT_TRUE(kept.count(id)) << id << " was lost";
  EXPECT_LT(kept.size(), static_cast<std::size_t>(kWriters * kEach)) << "nobody was killed";
  // Handed over again, as after a restart: all are there, once.
  for (int w = 0; w < kWriters; ++w)
    for (int n = 0; n < kEach; ++n) ASSERT_TRUE(store.add(row_of(w, n)));
  EXPECT_EQ(store.list()->size(), static_cast<std::size_t>(kWriters * kEach));
}

}  // namespace
}  // namespace osteon
