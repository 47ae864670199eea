#include "osteon/scene/tool_set.h"

#include <gtest/gtest.h>

#include <set>

namespace osteon {
namespace {

const std::vector<Instrument>& all() {
  static const std::vector<Instrument> list = [] {
    auto loaded = load_instruments(std::filesystem::path(OSTEON_SOURCE_DIR) / "assets/instruments");
    if (!loaded) ADD_FAILURE() << loaded.error().message();
    return loaded ? std::move(*loaded) : std::vector<Instrument>();
  }();
  return list;
}

ToolSet some() {
  const std::vector<std::string> names{"hook_probe", "cannulated_drill:9", "femoral_offset_aimer",
                                       "cannulated_drill:4.5"};
  auto made = ToolSet::of(all(), names);
  if (!made) ADD_FAILURE() << made.error().message();
  return made ? std::move(*made) : ToolSet();
}

TEST(ToolSet, HoldsWhatIsNamedEachInstrumentTogether) {
  const ToolSet set = some();
  ASSERT_EQ(set.count(), 7u);
  EXPECT_EQ(set.instrument_at(0).name, "hook_probe");
  EXPECT_EQ(set.instrument_at(1).name, "cannulated_drill");
  EXPECT_EQ(set.instrument_at(2).name, "cannulated_drill");
  // Felt a tenth of a millimetre inside of what they cut.
  EXPECT_DOUBLE_EQ(set.at(1).tool->parts[0].rod.radius, 0.00215);
  EXPECT_DOUBLE_EQ(set.at(2).tool->parts[0].rod.radius, 0.0044);
  EXPECT_EQ(set.tools().size(), set.count());
}

TEST(ToolSet, FindsByNameSizeAndCode) {
  const ToolSet set = some();
  EXPECT_EQ(set.find("cannulated_drill"), 2u);  // 9 mm is usual
  EXPECT_EQ(set.find("cannulated_drill", 4.5), 1u);
  EXPECT_EQ(set.find("cannulated_drill", 6), std::nullopt);
  EXPECT_EQ(set.find("shaver"), std::nullopt);
  const int code = find_instrument(all(), "cannulated_drill")->code;
  EXPECT_EQ(set.find_code(code), 2u);
  EXPECT_EQ(set.find_code(0), std::nullopt);
}

TEST(ToolSet, ABackAndForthComesToTheSameInstrument) {
  const ToolSet set = some();
  std::size_t place = 0;
  std::set<std::string> seen;
  for (int i = 0; i < 3; ++i) {
    seen.insert(set.instrument_at(place).name);
    EXPECT_EQ(set.next(set.next(place), -1), set.next(place, 0));
    place = set.next(place);
  }
  EXPECT_EQ(place, 0u);
  EXPECT_EQ(seen.size(), 3u);
  EXPECT_EQ(set.next(0, -1), set.find("femoral_offset_aimer"));
}

TEST(ToolSet, ItsNamesMakeItAgain) {
  const ToolSet set = some();
  const std::vector<std::string> names = set.names();
  ASSERT_EQ(names.size(), set.count());
  EXPECT_EQ(names[1].substr(0, 18), "cannulated_drill:4");
  const auto again = ToolSet::of(all(), names);
  ASSERT_TRUE(again) << again.error().message();
  EXPECT_EQ(again->hash(), set.hash());
}

TEST(ToolSet, SizesGoRound) {
  const ToolSet set = some();
  EXPECT_EQ(set.next_size(0), 0u);
  EXPECT_EQ(set.next_size(1), 2u);
  EXPECT_EQ(set.next_size(2), 1u);
  EXPECT_EQ(set.next_size(6), 3u);
}

TEST(ToolSet, SaysWhatIsNotThere) {
  for (const char* bad : {"probe_of_gold", "hook_probe:77", "hook_probe:", "hook_probe:x",
                          "hook_probe:-3", "hook_probe:nan", ""}) {
    const std::vector<std::string> names{bad};
    EXPECT_FALSE(ToolSet::of(all(), names)) << bad;
  }
  EXPECT_FALSE(ToolSet::of(all(), std::vector<std::string>()));
}

TEST(ToolSet, AnotherShapeIsAnotherHash) {
  const std::vector<std::string> a{"hook_probe"}, b{"wrist_hook_probe"};
  EXPECT_NE(ToolSet::of(all(), a)->hash(), ToolSet::of(all(), b)->hash());
  EXPECT_EQ(ToolSet::of(all(), a)->hash(), ToolSet::of(all(), a)->hash());
}

}  // namespace
}  // namespace osteon
