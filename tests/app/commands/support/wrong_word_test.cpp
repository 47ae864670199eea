#include "commands/support/wrong_word.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

namespace osteon {
namespace {

std::string said(const std::vector<std::string>& words) {
  CLI::App app("test", "osteon");
  app.require_subcommand(1);
  app.add_flag("--quiet");
  CLI::App* group = app.add_subcommand("case", "");
  group->require_subcommand(1);
  group->add_subcommand("check", "")->add_flag("--json");
  app.add_subcommand("simulate", "")->add_option("--stiffness");
  return wrong_word(app, words).value_or("nothing");
}

TEST(WrongWord, NamesTheNearestOption) {
  EXPECT_EQ(said({"simulate", "--stifness", "3"}),
            "there is no option '--stifness'. Did you mean --stiffness? "
            "See osteon simulate --help.");
  EXPECT_EQ(said({"simulate", "--stifness=3"}), said({"simulate", "--stifness", "3"}));
  EXPECT_NE(said({"simulate", "--quitt"}).find("Did you mean --quiet?"), std::string::npos);
}

TEST(WrongWord, NamesTheNearestCommand) {
  EXPECT_EQ(said({"case", "chek", "folder"}),
            "there is no command 'chek'. Did you mean check? See osteon case --help.");
  EXPECT_EQ(said({"fly"}), "there is no command 'fly'. See osteon --help.");
}

TEST(WrongWord, IsSilentWhereEveryWordIsKnown) {
  EXPECT_EQ(said({"simulate", "--stiffness"}), "nothing");
  EXPECT_EQ(said({"case", "check", "--json", "--quiet"}), "nothing");
  EXPECT_EQ(said({"simulate", "--stiffness", "-1"}), "nothing") << "a number is no option";
  EXPECT_EQ(said({}), "nothing");
}

TEST(NearestName, TakesAThirdOfTheLettersAtMost) {
  EXPECT_EQ(nearest_name("radus", {"ulna", "radius"}), "radius");
  EXPECT_EQ(nearest_name("radius", {"ulna", "tibia"}), "");
  EXPECT_EQ(nearest_name("", {"ulna"}), "");
}

}  // namespace
}  // namespace osteon
