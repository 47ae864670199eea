#include "commands/support/parser.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace osteon {
namespace {

struct Parsed {
  int exit_code = 0;
  std::string complaint;
  double size = 1;
  std::optional<double> depth;
  std::vector<std::string> names;
  bool json = false, ran = false;
};

Parsed parse_outcome(std::vector<std::string> words) {
  Parsed out;
  cli::App app("test", "osteon");
  app.require_subcommand(1);
  cli::App* sub = app.add_subcommand("cut", "Cut");
  cli::Option* size = sub->add_option("--size", out.size, "mm")->check(cli::Range(0.0, 5.0));
  sub->add_option("--depth", out.depth, "mm")->excludes(size);
  sub->add_option("--name", out.names, "one of")->check(cli::IsMember({"a", "b"}));
  sub->add_flag("--json", out.json, "print JSON");
  sub->callback([&] {
    if (out.json && size->count() == 0) cli::refuse("--json", "give --size as well");
    out.ran = true;
  });
  std::reverse(words.begin(), words.end());
  try {
    app.parser().parse(words);
  } catch (const CLI::ParseError& e) {
    out.exit_code = e.get_exit_code();
    out.complaint = e.what();
  }
  return out;
}

TEST(Parser, RefusesWhatIsNoneOfTheWordsOrOutOfRange) {
  EXPECT_NE(parse_outcome({"cut", "--name", "c"}).exit_code, 0);
  EXPECT_NE(parse_outcome({"cut", "--size", "5.1"}).exit_code, 0);
  EXPECT_NE(parse_outcome({"cut", "--size", "1", "--depth", "2"}).exit_code, 0);
  EXPECT_NE(parse_outcome({}).exit_code, 0);
}

TEST(Parser, ACallbackMayRefuse) {
  const Parsed out = parse_outcome({"cut", "--json"});
  EXPECT_NE(out.exit_code, 0);
  EXPECT_NE(out.complaint.find("give --size as well"), std::string::npos) << out.complaint;
  EXPECT_FALSE(out.ran);
}

TEST(Parser, FillsInWhatIsGiven) {
  const Parsed out = parse_outcome({"cut", "--depth", "2.5", "--name", "a", "b"});
  EXPECT_EQ(out.exit_code, 0) << out.complaint;
  EXPECT_TRUE(out.ran);
  EXPECT_EQ(out.depth, 2.5);
  EXPECT_EQ(out.names, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(out.size, 1);
}

TEST(Parser, ASubcommandIsFoundAgain) {
  cli::App app("test", "osteon");
  cli::App* sub = app.add_subcommand("case", "Look at a case");
  EXPECT_EQ(app.get_subcommand("case"), sub);
  EXPECT_THROW(app.get_subcommand("cases"), CLI::OptionNotFound);
}

}  // namespace
}  // namespace osteon
