#include "commands/support/number_check.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace osteon {
namespace {

// Exit code of the parser for `osteon sub <words>`; 0 where it takes them.
int parsed(std::vector<std::string> words) {
  CLI::App app("test", "osteon");
  CLI::App* sub = app.add_subcommand("sub", "");
  double real = 0, ranged = 0;
  int whole = 0;
  std::optional<std::uint64_t> seed;
  std::vector<double> three;
  std::string text;
  sub->add_option("--real", real);
  sub->add_option("--ranged", ranged)->check(CLI::Range(0.0, 5.0));
  sub->add_option("--whole", whole);
  sub->add_option("--seed", seed);
  sub->add_option("--three", three)->expected(3);
  sub->add_option("--text", text);
  sub->add_option("--most", real)->check(refuse_negative);
  sub->add_option("--size", real)->check(refuse_not_positive);
  check_all_numbers(app);
  words.insert(words.begin(), "sub");
  std::reverse(words.begin(), words.end());
  try {
    app.parse(words);
  } catch (const CLI::ParseError& e) {
    return e.get_exit_code();
  }
  return 0;
}

TEST(NumberCheck, RefusesWhatIsNotFinite) {
  for (const char* option : {"--real", "--ranged", "--three", "--most", "--size"})
    for (const char* bad : {"nan", "inf", "NAN", "1e999", "1x", ""})
      EXPECT_NE(parsed({option, bad, bad, bad}), 0) << option << " " << bad;
  EXPECT_NE(parsed({"--real=-inf"}), 0);
  EXPECT_NE(parsed({"--three", "1", "2", "nan"}), 0);
}

TEST(NumberCheck, RefusesASignWhereSomethingIsCounted) {
  EXPECT_NE(parsed({"--seed", "-1"}), 0);
  EXPECT_NE(parsed({"--seed", "1.5"}), 0);
  EXPECT_NE(parsed({"--seed", "18446744073709551616"}), 0) << "would be held as another number";
  EXPECT_NE(parsed({"--whole", "2.5"}), 0);
  EXPECT_NE(parsed({"--most", "-0.1"}), 0);
  EXPECT_NE(parsed({"--size", "0"}), 0);
}

TEST(NumberCheck, TakesNumbers) {
  EXPECT_EQ(parsed({"--real", "-2.5e-3"}), 0);
  EXPECT_EQ(parsed({"--real", "+2"}), 0);
  EXPECT_EQ(parsed({"--ranged", "5"}), 0);
  EXPECT_EQ(parsed({"--whole", "-3"}), 0);
  EXPECT_EQ(parsed({"--seed", "18446744073709551615"}), 0);
  EXPECT_EQ(parsed({"--three", "1", "-2", "3"}), 0);
  EXPECT_EQ(parsed({"--most", "0"}), 0);
  EXPECT_EQ(parsed({"--text", "nan"}), 0) << "a name may be anything";
}

TEST(NumberCheck, SaysWhatIsWrongShortly) {
  EXPECT_EQ(refuse_negative("-1"), "'-1' is not a number of 0 or more");
  EXPECT_EQ(refuse_negative("nan"), "'nan' is not a number of 0 or more");
  EXPECT_EQ(refuse_not_positive("0"), "'0' is not a number above 0");
}

}  // namespace
}  // namespace osteon
