#include "vary/variation_table.h"

#include <gtest/gtest.h>

#include <string>

#include "vary/vary.h"

namespace osteon {
namespace {

const std::string kSize =
    "overall_size = \"size_percent\"\n[[parameter]]\nname = \"size_percent\"\nmean = 100\nsd = 5\n"
    "min = 90\nmax = 110\nbuilt_in = 100\nsource = \"s\"\nmeaning = \"m\"\n";
const std::string kScale = "scale = [{ bones = [\"*\"], center_mm = [0, 0, 0], percent = 1 }]\n";

std::string complaint(const std::string& text) {
  const auto r = parse_variation(text, "t.toml");
  return r ? "" : r.error().message();
}

TEST(VariationTable, ReadsASoundOne) { EXPECT_EQ(complaint(kSize + kScale), ""); }

TEST(VariationTable, MistakesAreErrorsThatNameTheKey) {
  const auto changed = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const std::string sound = kSize + kScale;
  const std::pair<std::string, const char*> bad[] = {
      {"", "overall_size"},
      {"x = [", "t.toml"},
      {kSize, "overall_size"},
      {changed(sound, "\"size_percent\"", "\"else\""), "overall_size"},
      {changed(sound, "mean = 100", "mean = 120"), "mean"},
      {changed(sound, "built_in = 100", "built_in = nan"), "built_in"},
      {changed(sound, "sd = 5", "sd = -5"), "sd"},
      {changed(sound, "bones = [\"*\"], ", ""), "bones"},
      {changed(sound, "[\"*\"]", "[3]"), "bones"},
      {changed(sound, "percent = 1 }", "percent = 1, more = 1 }"), "more"},
      {sound + "turn = [{ bones = [\"a\"], degrees = [0, 0, 1], pivot_mm = [0, 0, 0], "
               "full_x_mm = 5, none_x_mm = 5 }]\n",
       "none_x_mm"}};
  for (const auto& [text, key] : bad)
    EXPECT_NE(complaint(text).find(key), std::string::npos) << key << ": " << complaint(text);
}

TEST(VariationTable, AStepOnABoneThatIsNotThereIsAnErrorThatNamesBoth) {
  const auto table = parse_variation(
      kSize + kScale + "shift = [{ bones = [\"femur\"], mm = [1, 0, 0] }]\n", "t.toml");
  ASSERT_TRUE(table) << table.error().message();
  AnatomyDescription anatomy;
  anatomy.bones.emplace_back();
  const auto r = vary(anatomy, *table, {105});
  ASSERT_FALSE(r);
  EXPECT_NE(r.error().message().find("femur"), std::string::npos) << r.error().message();
  EXPECT_NE(r.error().message().find("size_percent"), std::string::npos);
}

}  // namespace
}  // namespace osteon
