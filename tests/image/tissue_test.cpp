#include "osteon/image/tissue.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

const std::string kGood = R"(
[[tissue]]
name = "a"
density_kg_per_m3 = [1900, "K"]
stiffness_n_per_m = [2000, "D"]
static_friction = [0.2, "D"]
dynamic_friction = [0.1, "D"]
cutting_n = [50, "[33]"]
hu = [1500, "K"]
colour_srgb = [1, 0.5, 0]
)";

std::string with(const std::string& from, const std::string& to) {
  std::string text = kGood;
  return text.replace(text.find(from), from.size(), to);
}

TEST(TissueTable, ReadsValuesAndMarks) {
  const auto table = parse_tissue_table(kGood, "t");
  ASSERT_TRUE(table) << table.error().message();
  const Tissue* a = table->find("a");
  ASSERT_TRUE(a);
  EXPECT_EQ(a->hu.value, 1500);
  EXPECT_EQ(a->cutting_n.mark, "[33]");
  EXPECT_EQ(a->colour_srgb[1], 0.5);
  EXPECT_EQ(table->find("b"), nullptr);
}

TEST(TissueTable, MistakesNameTheLine) {
  const std::pair<std::string, std::string> mistakes[] = {
      {with("hu = [1500, \"K\"]", ""), "'hu' is missing"},
      {with("[1500, \"K\"]", "1500"), "mark of its source"},
      {with("[1500, \"K\"]", "[1500, \"\"]"), "mark of its source"},
      {with("1900", "-3"), "out of range"},
      {with("1900", "nan"), "out of range"},
      {with("hu =", "hue ="), "'hue' is not a key"},
      {with("[0.1,", "[0.3,"), "above the static"},
      {with("[1, 0.5, 0]", "[1, 2, 0]"), "colour_srgb"},
      {kGood + kGood, "comes twice"},
      {"x = 1", "other than"},
      {"[[", "not TOML"},
  };
  for (const auto& [text, says] : mistakes) {
    const auto table = parse_tissue_table(text, "t.toml");
    ASSERT_FALSE(table) << says;
    EXPECT_NE(table.error().message().find(says), std::string::npos) << table.error().message();
    EXPECT_NE(table.error().message().find("t.toml"), std::string::npos);
  }
}

TEST(TissueTable, TheShippedTableIsInOrder) {
  const auto table = load_default_tissues();
  ASSERT_TRUE(table) << table.error().message();
  const char* rising[] = {"air", "fat", "water", "muscle", "cancellous_bone", "cortical_bone"};
  double last = -1e9;
  for (const char* name : rising) {
    ASSERT_TRUE(table->find(name)) << name;
    EXPECT_GT(table->find(name)->hu.value, last) << name;
    last = table->find(name)->hu.value;
  }
}

}  // namespace
}  // namespace osteon
