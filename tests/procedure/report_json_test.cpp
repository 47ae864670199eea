#include <gtest/gtest.h>

#include <clocale>
#include <locale>
#include <nlohmann/json.hpp>

#include "osteon/procedure/hand_reports.h"
#include "report_fixtures.h"

namespace osteon {
namespace {

using testing::sample_report;

TEST(ReportJson, HasTheDocumentedKeys) {
  const auto json = nlohmann::json::parse(to_json(sample_report()));
  EXPECT_EQ(json["case"], "wrist");
  EXPECT_EQ(json["case_hash"], "0000000000000123");
  EXPECT_EQ(json["duration_s"], 60.5);
  EXPECT_EQ(json["ticks"], 60500);
  EXPECT_EQ(json["bones"]["radius"]["first_contact_s"], 1.5);
  EXPECT_EQ(json["bones"]["radius"]["contact_time_s"], 3.25);
  EXPECT_EQ(json["bones"]["radius"]["peak_force_n"], 2.5);
  EXPECT_EQ(json["bones"]["radius"]["mean_force_n"], 1.25);
  EXPECT_EQ(json["bones"]["radius"]["deepest_mm"], 0.75);
  EXPECT_EQ(json["bones"]["hamate"]["first_contact_s"], -1);
  EXPECT_EQ(json["path_length_mm"], 812.5);
  EXPECT_EQ(json["smoothness_sparc"], -7.5);
  EXPECT_EQ(json["state_hash"], "fedcba9876543210");
  EXPECT_EQ(json["tick_us"]["p50"], 9.5);
  EXPECT_EQ(json["tick_us"]["p99"], 20.5);
  EXPECT_EQ(json["tick_us"]["p999"], 31.5);
  EXPECT_EQ(json["tick_us"]["max"], 55.5);
  EXPECT_EQ(json["missed_ticks"], 3);
  EXPECT_EQ(json["realtime_factor"], 41.5);
  EXPECT_EQ(json.size(), 11u);
}

TEST(ReportJson, CountsTheEventsOfEachKindAndIsSilentWithoutAny) {
  const Case the_case = testing::named_case({"radius"});
  ReportBuilder builder(the_case);
  EXPECT_FALSE(nlohmann::json::parse(to_json(builder.finish())).contains("events"));
  Event event;
  for (const EventKind kind : {EventKind::kContactBegin, EventKind::kContactEnd,
                               EventKind::kContactBegin, EventKind::kMark, EventKind{999}}) {
    event.kind = kind;
    builder.add(event);
  }
  const auto events = nlohmann::json::parse(to_json(builder.finish()))["events"];
  EXPECT_EQ(events.size(), 3u);
  EXPECT_EQ(events["contact_begin"], 2);
  EXPECT_EQ(events["contact_end"], 1);
  EXPECT_EQ(events["mark"], 1);
}

TEST(ReportJson, KeepsTheBonesInTheCasesOrder) {
  const std::string text = to_json(sample_report());
  EXPECT_LT(text.find("radius"), text.find("lunate"));
  EXPECT_LT(text.find("lunate"), text.find("hamate"));
}

TEST(ReportJson, OfAnAttemptWithTwoHandsHoldsTheBonesOfBoth) {
  std::vector<Report> reports{sample_report(), sample_report()};
  reports[1].bones[0].peak_force_n = 9;
  const std::vector<std::string> names{"probe", "scope"};
  const auto json = nlohmann::json::parse(to_json(reports, names, Outcome{}));
  EXPECT_EQ(json["bones"]["radius"]["peak_force_n"], 2.5);
  EXPECT_EQ(json["hands"]["probe"]["bones"]["radius"]["peak_force_n"], 2.5);
  EXPECT_EQ(json["hands"]["scope"]["bones"]["radius"]["peak_force_n"], 9);
  EXPECT_TRUE(json.contains("verdict"));
  reports.pop_back();
  EXPECT_EQ(to_json(reports, names, Outcome{}), to_json(sample_report(), Outcome{}));
}

TEST(ReportJson, OfNoBonesIsAnEmptyObject) {
  EXPECT_TRUE(nlohmann::json::parse(to_json(Report{}))["bones"].is_object());
}

// A decimal comma and dots between thousands, as in much of Europe.
struct CommaPunctuation : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(ReportJson, DoesNotDependOnTheLocale) {
  const std::string plain = to_json(sample_report());
  const std::string plain_text = to_text(sample_report());
  const std::locale before =
      std::locale::global(std::locale(std::locale::classic(), new CommaPunctuation));
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // where the system has it: C functions heed it
  const std::string there = to_json(sample_report());
  const std::string there_text = to_text(sample_report());
  std::locale::global(before);
  std::setlocale(LC_ALL, "C");
  EXPECT_EQ(plain, there);
  EXPECT_EQ(plain_text, there_text);
}

TEST(ReportJson, SurvivesANameThatIsNotUtf8) {
  Report report = sample_report();
  report.case_name = "wri\xff\xfest \"quoted\"\n";
  const auto json = nlohmann::json::parse(to_json(report), nullptr, false);
  EXPECT_FALSE(json.is_discarded());
}

}  // namespace
}  // namespace osteon
