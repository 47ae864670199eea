#include "osteon/results/lrs.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "results/attempts.h"
#include "results/loopback_lrs.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;
using test::LoopbackAnswer, test::LoopbackLrs, test::LoopbackRequest, test::row_of;

class LrsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    dir_ = fs::temp_directory_path() / ("osteon_lrs_" + std::to_string(::getpid()));
    fs::remove_all(dir_);
    fs::create_directories(dir_);
    store_.emplace(std::move(*ResultStore::open(dir_ / "results.sqlite")));
  }
  void TearDown() override { fs::remove_all(dir_); }
  void keep(int count) {
    for (int n = 0; n < count; ++n) ASSERT_TRUE(store_->add(row_of(1, n)));
  }
  SentReport send(const LoopbackLrs& lrs, std::size_t batch = 50, long timeout_ms = 20000) {
    Lrs to;
    to.endpoint = lrs.url();
    to.batch = batch;
    to.timeout_ms = timeout_ms;
    auto sent = send_to_lrs(to, *store_->list(), *store_, [this](long ms) { waited_ms_ += ms; });
    EXPECT_TRUE(sent) << sent.error().message();
    return sent ? *sent : SentReport{};
  }
  fs::path dir_;
  std::optional<ResultStore> store_;
  long waited_ms_ = 0;
};

TEST_F(LrsTest, OfNothingAsksNothing) {
  LoopbackLrs lrs;
  EXPECT_EQ(send(lrs).accepted, 0u);
  lrs.stop();
  EXPECT_EQ(lrs.requests, 0);
}

TEST_F(LrsTest, AddressesThatAreNoneAndPasswordsInTheOpenAreRefused) {
  Lrs lrs;
  lrs.endpoint = "ftp://example.org";
  EXPECT_FALSE(send_to_lrs(lrs, {}, *store_, {}));
  lrs.endpoint = "http://lrs.example.org/xapi";
  lrs.user = "key";
  const auto open_way = send_to_lrs(lrs, {}, *store_, {});
  ASSERT_FALSE(open_way);
  EXPECT_NE(open_way.error().what.find("unencrypted"), std::string::npos);
  lrs.endpoint = "http://127.0.0.1.example.org/xapi";
  EXPECT_FALSE(send_to_lrs(lrs, {}, *store_, {}));
}

TEST_F(LrsTest, EverythingArrivesOnceHoweverOftenItIsSent) {
  LoopbackLrs lrs;
  keep(7);
  EXPECT_EQ(send(lrs, 3).accepted, 7u);
  EXPECT_EQ(send(lrs, 3).accepted, 0u);
  ASSERT_TRUE(store_->add(row_of(2, 0)));
  EXPECT_EQ(send(lrs, 3).accepted, 1u);
  lrs.stop();
  EXPECT_EQ(lrs.statements.size(), 8u);
  EXPECT_EQ(lrs.requests, 4);
  EXPECT_EQ(lrs.taken_twice, 0);
  EXPECT_TRUE(lrs.faults.empty()) << lrs.faults[0];
}

TEST_F(LrsTest, NobodyThereLeavesAllWaiting) {
  LoopbackLrs lrs;
  keep(3);
  lrs.stop();
  const SentReport sent = send(lrs);
  EXPECT_EQ(sent.waiting, 3u);
  ASSERT_TRUE(sent.why_waiting);
  EXPECT_NE(sent.why_waiting->what.find("cannot be reached"), std::string::npos);
}

// The answer to the first request is lost after the statements were taken.
TEST_F(LrsTest, AnAnswerThatIsLostDoublesNothing) {
  LoopbackLrs* here = nullptr;
  bool lost = false;
  LoopbackLrs lrs([&](const LoopbackRequest&, int n) -> std::optional<LoopbackAnswer> {
    if (n > 0 || lost) return std::nullopt;
    lost = true;
    return LoopbackAnswer{200, "", "taken: yes"};  // taken, and an empty answer
  });
  here = &lrs;
  keep(3);
  EXPECT_EQ(send(*here).accepted, 3u) << "asked for one by one";
  lrs.stop();
  EXPECT_EQ(lrs.statements.size(), 3u);
  EXPECT_EQ(lrs.taken_twice, 0);
}

TEST_F(LrsTest, ADroppedLineLeavesTheRestForTheNextTime) {
  LoopbackLrs lrs([](const LoopbackRequest&, int n) -> std::optional<LoopbackAnswer> {
    if (n == 1) return LoopbackAnswer{0, "", "", true};
    return std::nullopt;
  });
  keep(6);
  const SentReport first = send(lrs, 2);
  EXPECT_GE(first.accepted, 2u);
  EXPECT_EQ(send(lrs, 2).accepted + first.accepted, 6u);
  lrs.stop();
  EXPECT_EQ(lrs.statements.size(), 6u);
  EXPECT_EQ(lrs.taken_twice, 0);
}

TEST_F(LrsTest, AStallEndsInTimeAndLosesNothing) {
  LoopbackLrs lrs([](const LoopbackRequest&, int n) -> std::optional<LoopbackAnswer> {
    if (n == 0) return LoopbackAnswer{0, "", "", false, true};
    return std::nullopt;
  });
  keep(2);
  const SentReport sent = send(lrs, 50, 100);
  EXPECT_EQ(sent.waiting, 2u);
  EXPECT_NE(sent.why_waiting->what.find("in time"), std::string::npos);
  EXPECT_EQ(send(lrs).accepted, 2u);
}

TEST_F(LrsTest, ABusyStoreIsWaitedForAsItAsks) {
  LoopbackLrs lrs([](const LoopbackRequest&, int n) -> std::optional<LoopbackAnswer> {
    if (n == 0) return LoopbackAnswer{429, "", "Retry-After: 7"};
    if (n == 1) return LoopbackAnswer{503, ""};
    return std::nullopt;
  });
  keep(2);
  EXPECT_EQ(send(lrs).accepted, 2u);
  EXPECT_EQ(waited_ms_, 7000 + 2000);
}

TEST_F(LrsTest, ALongWaitIsForAnotherTime) {
  LoopbackLrs lrs([](const LoopbackRequest&, int) -> std::optional<LoopbackAnswer> {
    return LoopbackAnswer{429, "", "Retry-After: 3600"};
  });
  keep(2);
  EXPECT_EQ(send(lrs).waiting, 2u);
  EXPECT_EQ(waited_ms_, 0);
}

// One statement that the record store will not have spoils neither its batch nor what comes after.
TEST_F(LrsTest, OneRefusedStatementIsFoundByHalving) {
  const std::string bad = test::uuid_of(1, 5);
  LoopbackLrs lrs([&](const LoopbackRequest& request, int) -> std::optional<LoopbackAnswer> {
    if (request.body.find(bad) != std::string::npos) return LoopbackAnswer{400, "not\nthis one"};
    return std::nullopt;
  });
  keep(16);
  const SentReport sent = send(lrs, 8);
  EXPECT_EQ(sent.accepted, 15u);
  ASSERT_EQ(sent.refusals.size(), 1u);
  EXPECT_EQ(sent.refusals[0].id, bad);
  EXPECT_EQ(sent.refusals[0].refusal, "HTTP 400: not this one");
  EXPECT_EQ(send(lrs, 8).refused, 0u) << "it is not tried again";
  lrs.stop();
  EXPECT_EQ(lrs.statements.size(), 15u);
}

TEST_F(LrsTest, ABatchThatIsTooLargeIsHalved) {
  LoopbackLrs lrs([&](const LoopbackRequest& request, int) -> std::optional<LoopbackAnswer> {
    if (request.body.size() > 2000) return LoopbackAnswer{413, ""};
    return std::nullopt;
  });
  keep(16);
  EXPECT_EQ(send(lrs).accepted, 16u);
}

TEST_F(LrsTest, AnotherStatementUnderTheIdIsARefusalTheSameIsNot) {
  LoopbackLrs lrs;
  keep(2);
  lrs.statements[test::uuid_of(1, 0)] = {{"id", test::uuid_of(1, 0)}, {"verb", {{"id", "other"}}}};
  const SentReport sent = send(lrs);
  EXPECT_EQ(sent.accepted, 1u);
  EXPECT_EQ(sent.refused, 1u);
}

TEST_F(LrsTest, AStoreThatLiesIsNotBelieved) {
  LoopbackLrs lrs([](const LoopbackRequest& request, int) -> std::optional<LoopbackAnswer> {
    if (request.method == "POST") return LoopbackAnswer{200, "[\"some-other-id\"]"};
    return std::nullopt;
  });
  keep(2);
  const SentReport sent = send(lrs);
  EXPECT_EQ(sent.accepted, 0u);
  EXPECT_EQ(sent.waiting, 2u);
  EXPECT_NE(sent.why_waiting->what.find("does not have it"), std::string::npos);
}

TEST_F(LrsTest, AWrongPasswordRefusesNoAttempt) {
  LoopbackLrs lrs([](const LoopbackRequest&, int) -> std::optional<LoopbackAnswer> {
    return LoopbackAnswer{401, "who are you"};
  });
  keep(2);
  const SentReport sent = send(lrs);
  EXPECT_EQ(sent.refused, 0u);
  EXPECT_EQ(sent.waiting, 2u);
  EXPECT_NE(sent.why_waiting->todo.find("password"), std::string::npos);
  EXPECT_TRUE(store_->sendings(lrs.url())->empty());
}

// A real TLS server with a certificate that nobody signed.
TEST_F(LrsTest, ACertificateIsCheckedAndCanBeGiven) {
  const std::string key = (dir_ / "key.pem").string(), signed_by = (dir_ / "it.pem").string();
  if (std::system(("openssl req -x509 -newkey rsa:2048 -nodes -days 30 -subj /CN=localhost -addext "
                   "subjectAltName=DNS:localhost -keyout " +
                   key + " -out " + signed_by + " 2>/dev/null")
                      .c_str()) != 0)
    GTEST_SKIP() << "install openssl to try TLS";
  FILE* server =
      ::popen(("exec timeout 20 openssl s_server -www -naccept 2 -accept 127.0.0.1:0 -key " + key +
               " -cert " + signed_by + " 2>/dev/null")
                  .c_str(),
              "r");
  ASSERT_NE(server, nullptr);
  int port = 0;
  for (char line[256]; port == 0 && std::fgets(line, sizeof line, server);)
    if (std::sscanf(line, "ACCEPT 127.0.0.1:%d", &port) != 1) port = 0;
  ASSERT_GT(port, 0);
  keep(1);
  Lrs lrs;
  lrs.endpoint = "https://localhost:" + std::to_string(port);
  const auto refused = send_to_lrs(lrs, *store_->list(), *store_, [](long) {});
  ASSERT_TRUE(refused && refused->why_waiting);
  EXPECT_NE(refused->why_waiting->what.find("not trusted"), std::string::npos)
      << refused->why_waiting->what;
  lrs.certificates = signed_by;
  lrs.timeout_ms = 1000;  // it answers no POST
  const auto trusted = send_to_lrs(lrs, *store_->list(), *store_, [](long) {});
  ASSERT_TRUE(trusted && trusted->why_waiting) << "it is no record store";
  EXPECT_EQ(trusted->why_waiting->what.find("certificate"), std::string::npos)
      << trusted->why_waiting->what;
  ::pclose(server);
}

TEST_F(LrsTest, ForgettingALearnerForgetsWhatWasSaidOfThem) {
  LoopbackLrs lrs;
  keep(2);
  EXPECT_EQ(send(lrs).accepted, 2u);
  EXPECT_EQ(store_->sendings(lrs.url())->size(), 2u);
  EXPECT_EQ(*store_->forget("learner_1"), 2);
  EXPECT_TRUE(store_->sendings(lrs.url())->empty());
}

}  // namespace
}  // namespace osteon
