#include <gtest/gtest.h>

#include <sstream>

#include "report_fixtures.h"

namespace osteon {
namespace {

using testing::sample_report;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(ReportText, OfNothingSaysSo) {
  const std::string text = to_text(Report{});
  EXPECT_NE(text.find("no bone was touched"), std::string::npos);
  EXPECT_EQ(text.find("tick time"), std::string::npos);  // nothing was measured
}

TEST(ReportText, ShowsTheNumbers) {
  const std::string text = to_text(sample_report());
  for (const char* part : {"wrist", "60.500 s", "812.5 mm", "-7.50", "fedcba9876543210", "p99 20.5",
                           "missed ticks 3", "41.5 times real time", "never touched: hamate"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(ReportText, ColumnsStandUnderTheirHeads) {
  const auto lines = lines_of(to_text(sample_report()));
  const auto is_head = [](const std::string& line) { return line.rfind("bone ", 0) == 0; };
  const auto head = std::find_if(lines.begin(), lines.end(), is_head);
  ASSERT_NE(head, lines.end());
  EXPECT_EQ((head + 1)->size(), head->size());
  EXPECT_EQ((head + 2)->size(), head->size());
  EXPECT_EQ((head + 1)->rfind("radius", 0), 0u);
}

}  // namespace
}  // namespace osteon
