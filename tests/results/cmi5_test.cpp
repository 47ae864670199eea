#include "osteon/results/cmi5.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "results/attempts.h"
#include "results/loopback_lms.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;
using test::LoopbackLms, test::row_of;
using LmsJson = nlohmann::json;

AttemptRow judged_row(const std::string& verdict, double score, bool whole = true) {
  AttemptRow row = row_of(1, 1);
  row.verdict = verdict;
  row.score = score;
  row.report_json = whole ? R"({"stages": [{"name": "a", "completed_s": 3.5}]})"
                          : R"({"stages": [{"name": "a", "completed_s": null}]})";
  return row;
}

class Cmi5Test : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("osteon_cmi5_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  Cmi5Session begun(const LoopbackLms& lms) {
    const auto launch = parse_cmi5_launch(lms.launch_url());
    EXPECT_TRUE(launch) << launch.error().message();
    const auto session = begin_cmi5(*launch, {});
    EXPECT_TRUE(session) << session.error().message();
    return session ? *session : Cmi5Session{};
  }
  // The whole session: first words, then the attempt's.
  Cmi5Sent tell(const Cmi5Session& session, const std::optional<AttemptRow>& attempt) {
    EXPECT_TRUE(queue_cmi5(session, cmi5_first_words(session), 1, folder_));
    EXPECT_TRUE(queue_cmi5(session, cmi5_last_words(session, attempt, session.began_ms + 90500), 2,
                           folder_));
    return sent();
  }
  Cmi5Sent sent() {
    auto done = send_cmi5(folder_, {});
    EXPECT_TRUE(done) << done.error().message();
    return done ? *done : Cmi5Sent{};
  }
  std::size_t queued() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  fs::path folder_;
};

TEST_F(Cmi5Test, AnAddressThatLacksAPartOrHidesOneIsRefused) {
  const LoopbackLms lms;
  const std::string good = lms.launch_url();
  EXPECT_TRUE(parse_cmi5_launch(good));
  for (const char* part : {"endpoint=", "fetch=", "actor=", "registration=", "activityId="}) {
    std::string without = good;
    without.replace(without.find(part), 3, "zzz");
    EXPECT_FALSE(parse_cmi5_launch(without)) << without;
  }
  for (const std::string& bad :
       {std::string(), std::string("osteon://"), "http" + good.substr(6),
        "osteon://launch/..%2Fetc?" + good.substr(good.find('?') + 1),
        "osteon://launch/../touch_bones" + good.substr(good.find('?')),
        "osteon://run/touch_bones" + good.substr(good.find('?')), good + "&seed=-1",
        good + "&seed=1x", good + "%", good + "&x=%0d%0aEvil", good + "&x=%g1", good + "&x=%ff"})
    EXPECT_FALSE(parse_cmi5_launch(bad)) << bad;
  std::string open_way = good;
  open_way.replace(open_way.find("127%2e0%2e0%2e1"), 15, "lms.example.org");
  const auto refused = parse_cmi5_launch(open_way);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("unencrypted"), std::string::npos);
  std::string disguised = good;  // what comes before '@' is a user's name
  disguised.replace(disguised.find("127%2e0%2e0%2e1"), 15, "localhost%3a80%40lms.example.org");
  EXPECT_FALSE(parse_cmi5_launch(disguised));
  EXPECT_EQ(parse_cmi5_launch(good + "&seed=7")->seed, 7u);
}

TEST_F(Cmi5Test, APassedAttemptArrivesAsItsFourStatementsInOrder) {
  LoopbackLms lms;
  const Cmi5Session session = begun(lms);
  EXPECT_EQ(session.learner.size(), 20u);
  const Cmi5Sent sent = tell(session, judged_row("passed", 91.5));
  lms.stop();
  EXPECT_EQ(sent.accepted, 4u) << lms.faults_text();
  EXPECT_EQ(lms.verbs(), "initialized completed passed terminated");
  EXPECT_EQ(lms.faults_text(), "");
  const LmsJson& passed = lms.told[2];
  EXPECT_DOUBLE_EQ(passed["result"]["score"]["scaled"], 0.915);
  EXPECT_EQ(passed["result"]["duration"], "PT61.25S");
  EXPECT_EQ(lms.told[3]["result"]["duration"], "PT90.50S");
  EXPECT_EQ(queued(), 0u);
}

// What is judged is the attempt's own verdict and the LMS's mastery score.
TEST_F(Cmi5Test, VerdictAndMasteryScoreDecideBetweenPassedAndFailed) {
  struct Case {
    const char *verdict, *mastery;
    double score;
    const char* verbs;
    bool has_score;
  };
  const Case cases[] = {
      {"passed", "0.9", 91, "initialized completed passed terminated", true},
      {"passed", "0.95", 91, "initialized completed failed terminated", true},
      {"not_passed", "0.5", 91, "initialized completed failed terminated", false},
      {"not_passed", "0.95", 91, "initialized completed failed terminated", true},
      {"undecided", "0.5", 91, "initialized completed terminated", false},
      {"passed", "", 140, "initialized completed passed terminated", true},
  };
  for (const Case& one : cases) {
    LoopbackLms lms("Normal", one.mastery);
    tell(begun(lms), judged_row(one.verdict, one.score));
    lms.stop();
    EXPECT_EQ(lms.verbs(), one.verbs) << one.verdict << " " << one.mastery;
    EXPECT_EQ(lms.faults_text(), "") << one.verdict << " " << one.mastery;
    bool scored = false;
    for (const LmsJson& said : lms.told)
      scored = scored || said.dump().find("scaled") != std::string::npos;
    EXPECT_EQ(scored, one.has_score) << one.verdict << " " << one.mastery;
  }
}

TEST_F(Cmi5Test, WithoutAWholeAttemptOrWhereNothingCountsOnlyTheSessionIsTold) {
  for (const bool browses : {false, true}) {
    LoopbackLms lms(browses ? "Browse" : "Normal");
    tell(begun(lms), browses ? std::optional(judged_row("passed", 99)) : std::nullopt);
    lms.stop();
    EXPECT_EQ(lms.verbs(), "initialized terminated");
    EXPECT_EQ(lms.faults_text(), "");
  }
  LoopbackLms lms;
  tell(begun(lms), judged_row("not_passed", 50, false));
  lms.stop();
  EXPECT_EQ(lms.verbs(), "initialized failed terminated");
}

TEST_F(Cmi5Test, ARegistrationHasOneCompletedAndOnePassedAndNoFailedAfterIt) {
  LoopbackLms lms;
  tell(begun(lms), judged_row("passed", 90));
  tell(begun(lms), judged_row("passed", 95));
  tell(begun(lms), judged_row("not_passed", 60));
  lms.stop();
  EXPECT_EQ(
      lms.verbs(),
      "initialized completed passed terminated initialized terminated initialized terminated");
}

TEST_F(Cmi5Test, WhatCouldNotBeSentIsSentLaterOnce) {
  LoopbackLms lms;
  const Cmi5Session session = begun(lms);
  lms.busy(3);
  Cmi5Sent sent_now = tell(session, judged_row("passed", 90));
  EXPECT_EQ(sent_now.accepted, 0u);
  EXPECT_EQ(sent_now.waiting, 4u);
  EXPECT_TRUE(sent_now.why_waiting);
  EXPECT_EQ(queued(), 2u);
  // Its answer to the first is lost: it comes again.
  lms.busy(0);
  lms.lose_answers(1);
  for (int again = 0; again < 4 && queued() > 0; ++again) sent_now = sent();
  EXPECT_EQ(queued(), 0u);
  lms.stop();
  EXPECT_EQ(lms.verbs(), "initialized completed passed terminated");
  EXPECT_EQ(lms.faults_text(), "");
}

TEST_F(Cmi5Test, ARefusedStatementIsSetAsideAndTheTokenWithNone) {
  LoopbackLms lms;
  Cmi5Session session = begun(lms);
  session.authorization = "Basic other";
  const Cmi5Sent refused = tell(session, judged_row("passed", 90));
  lms.stop();
  EXPECT_EQ(refused.refusals.size(), 4u);
  EXPECT_EQ(refused.waiting, 0u);
  ASSERT_EQ(queued(), 2u);
  for (const auto& entry : fs::directory_iterator(folder_)) {
    EXPECT_EQ(entry.path().extension(), ".refused");
    std::ifstream in(entry.path());
    std::stringstream text;
    text << in.rdbuf();
    EXPECT_EQ(text.str().find("other"), std::string::npos);
  }
  EXPECT_EQ(sent().refusals.size(), 0u);
}

TEST_F(Cmi5Test, ALaunchWithoutTokenOrDataSaysWhatToDo) {
  LoopbackLms lms;
  (void)begun(lms);  // the token is given once
  const auto again = begin_cmi5(*parse_cmi5_launch(lms.launch_url(false)), {});
  ASSERT_FALSE(again);
  EXPECT_NE(again.error().what.find("used already"), std::string::npos);
  lms.stop();
  LoopbackLms empty("Normal", "", false);
  const auto none = begin_cmi5(*parse_cmi5_launch(empty.launch_url()), {});
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().what.find("LMS.LaunchData"), std::string::npos);
}

}  // namespace
}  // namespace osteon
