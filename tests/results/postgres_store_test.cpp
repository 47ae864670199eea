// A real server, started here on a socket of its own and stopped at the end.
#include <gtest/gtest.h>
#include <pwd.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <set>

#include "osteon/base/random.h"
#include "osteon/results/store.h"
#include "results/attempts.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;
using test::row_of, test::uuid_of;

std::string server_programs() {
  for (const auto& entry : fs::directory_iterator("/usr/lib/postgresql"))
    if (fs::exists(entry.path() / "bin/initdb")) return (entry.path() / "bin").string();
  return "";
}

// The server will not run as root: then as the user that its package made.
int as_server_user(const std::string& command) {
  const std::string program =
      ::geteuid() == 0 ? "setpriv --reuid=postgres --regid=postgres --clear-groups " : "";
  return std::system((program + "sh -c '" + command + "' >/dev/null 2>&1").c_str());
}

class PostgresStoreTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    std::error_code ec;
    if (!fs::is_directory("/usr/lib/postgresql", ec)) return;
    programs_ = server_programs();
    dir_ = "/tmp/osteon_pg_" + std::to_string(::getpid());
    fs::create_directories(dir_);
    const passwd* user = ::geteuid() == 0 ? ::getpwnam("postgres") : nullptr;
    if (user) {
      ASSERT_EQ(::chown(dir_.c_str(), user->pw_uid, user->pw_gid), 0);
    }
    ASSERT_EQ(as_server_user(programs_ + "/initdb -D " + dir_ +
                             "/data -U osteon -A trust -N --locale=C -E UTF8"),
              0);
    start();
  }
  static void TearDownTestSuite() {
    if (dir_.empty()) return;
    stop();
    fs::remove_all(dir_);
  }
  static void start() {
    ASSERT_EQ(
        as_server_user(programs_ + "/pg_ctl -D " + dir_ + "/data -w -l " + dir_ + "/log -o \"-k " +
                       dir_ + " -c listen_addresses= -c max_connections=60 -c fsync=off\" start"),
        0);
  }
  static void stop() {
    as_server_user(programs_ + "/pg_ctl -D " + dir_ + "/data -w -m immediate stop");
  }
  void SetUp() override {
    if (programs_.empty()) GTEST_SKIP() << "install postgresql to try the server of results";
    ASSERT_EQ(as_server_user(programs_ + "/psql -h " + dir_ +
                             " -U osteon -d postgres -c \"DROP DATABASE IF EXISTS lab\" -c "
                             "\"CREATE DATABASE lab\""),
              0);
  }
  static std::string url() { return "postgresql://osteon:secret@/lab?host=" + dir_; }
  static ResultStore open() {
    auto store = ResultStore::open(url());
    EXPECT_TRUE(store) << store.error().message();
    return std::move(*store);
  }
  static inline std::string programs_, dir_;
};

TEST_F(PostgresStoreTest, OfNothingIsEmpty) {
  ResultStore store = open();
  EXPECT_TRUE(store.list()->empty());
  EXPECT_FALSE(store.find(uuid_of(1, 1))->has_value());
  EXPECT_EQ(*store.forget("nobody"), 0);
}

TEST_F(PostgresStoreTest, KeepsWhatItIsGivenInTheOrderOfGiving) {
  ResultStore store = open();
  AttemptRow odd = row_of(1, 0);
  odd.learner = "o'brien";
  odd.score = 0.1 + 0.2;
  odd.score_lo = std::nullopt;
  odd.case_name = "Handgelenk \xc3\xa4 \\ \"%s\"";
  EXPECT_TRUE(*store.add(odd));
  for (int n = 1; n < 3; ++n) EXPECT_TRUE(*store.add(row_of(1, n)));
  const auto rows = open().list();
  ASSERT_EQ(rows->size(), 3u);
  EXPECT_EQ((*rows)[0], odd);
  EXPECT_EQ((*rows)[2], row_of(1, 2));
  EXPECT_EQ(open().list({"learner_1", ""})->size(), 2u);
  EXPECT_EQ(open().list({"", "other"})->size(), 0u);
}

TEST_F(PostgresStoreTest, AnAttemptIsWrittenOnceAndForgottenWhole) {
  ResultStore store = open();
  EXPECT_TRUE(*store.add(row_of(1, 0)));
  EXPECT_FALSE(*store.add(row_of(1, 0)));
  AttemptRow forged = row_of(1, 0);
  forged.verdict = "passed";
  EXPECT_FALSE(store.add(forged));
  EXPECT_EQ((*store.find(uuid_of(1, 0)))->verdict, "not_passed");
  ASSERT_TRUE(store.mark({uuid_of(1, 0), "https://a", "no"}));
  ASSERT_TRUE(store.mark({uuid_of(1, 0), "https://a", ""}));
  EXPECT_EQ(*store.sendings("https://a"), (std::vector<Sending>{{uuid_of(1, 0), "https://a", ""}}));
  EXPECT_EQ(*store.forget("learner_1"), 1);
  EXPECT_TRUE(store.list()->empty());
  EXPECT_TRUE(store.sendings("https://a")->empty());
}

TEST_F(PostgresStoreTest, AServerThatGoesInTheMiddleLosesNoAttempt) {
  ResultStore store = open();
  EXPECT_TRUE(*store.add(row_of(1, 0)));
  stop();
  const auto gone = store.add(row_of(1, 1));
  ASSERT_FALSE(gone);
  EXPECT_EQ(gone.error().where.find("secret"), std::string::npos);
  const auto kept = keep_attempt(row_of(1, 1), url(), dir_ + "/waiting", 1);
  ASSERT_TRUE(kept) << kept.error().message();
  EXPECT_FALSE(kept->in_store);
  EXPECT_EQ(kept->why_waiting->message().find("secret"), std::string::npos);
  start();
  EXPECT_EQ(*take_waiting(store, dir_ + "/waiting"), 1) << "on a new connection";
  EXPECT_EQ(store.list()->size(), 2u);
}

TEST_F(PostgresStoreTest, NoServerIsSaidWithoutThePassword) {
  const auto none = ResultStore::open("postgresql://osteon:secret@/lab?host=/tmp/nowhere_at_all");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message().find("secret"), std::string::npos) << none.error().message();
  EXPECT_NE(none.error().what.find("does not answer"), std::string::npos);
}

TEST_F(PostgresStoreTest, TwentySeatsKilledAtRandomLoseAndDoubleNothing) {
  constexpr int kSeats = 20, kEach = 8;
  int said[2];
  ASSERT_EQ(::pipe(said), 0);
  std::vector<pid_t> seats;
  for (int w = 0; w < kSeats; ++w) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child > 0) {
      seats.push_back(child);
      continue;
    }
    auto store = ResultStore::open(url(), 60);  // all make the tables at once
    if (!store) ::_exit(1);
    for (int n = 0; n < kEach; ++n) {
      if (!store->add(row_of(w, n))) ::_exit(1);
      const int done[2] = {w, n};
      if (::write(said[1], done, sizeof done) != sizeof done) ::_exit(1);
    }
    ::_exit(0);
  }
  ::close(said[1]);
  Random random(5);
  std::set<std::string> in;
  int done[2];
  while (::read(said[0], done, sizeof done) == sizeof done) {
    in.insert(uuid_of(done[0], done[1]));
    if (random.uniform() < 0.1) ::kill(seats[random.next() % kSeats], SIGKILL);
  }
  ::close(said[0]);
  int failed = 0;
  for (const pid_t child : seats) {
    int status = 0;
    ::waitpid(child, &status, 0);
    failed += WIFEXITED(status) && WEXITSTATUS(status) != 0 ? 1 : 0;
  }
  EXPECT_EQ(failed, 0);
  ResultStore store = open();
  std::set<std::string> kept;
  const auto rows = store.list();
  ASSERT_TRUE(rows);
  for (const AttemptRow& row : *rows)
    EXPECT_TRUE(kept.insert(row.id).second) << row.id << " is there twice";
  for (const std::string& id : in) EXPECT_TRUE(kept.count(id)) << id << " was lost";
  for (int w = 0; w < kSeats; ++w)
    for (int n = 0; n < kEach; ++n) ASSERT_TRUE(store.add(row_of(w, n)));
  EXPECT_EQ(store.list()->size(), static_cast<std::size_t>(kSeats * kEach));
}

}  // namespace
}  // namespace osteon
