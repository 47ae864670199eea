#include "osteon/scene/instrument_size.h"

#include <gtest/gtest.h>

#include "osteon/base/file.h"
#include "osteon/scene/instrument.h"

namespace osteon {
namespace {

TEST(InstrumentSize, IsTheOneThatTheTrayNamesOrTheUsualOne) {
  Tool tool;
  tool.tip_radius_m = 0.001;
  EXPECT_NEAR(size_in_use_mm("shaver:5.5", tool), 5.5, 1e-9);
  EXPECT_NEAR(size_in_use_mm("shaver", tool), 4.2, 1e-9);
  EXPECT_NEAR(size_in_use_mm("cannulated_drill:12", tool), 12, 1e-9);
}

TEST(InstrumentSize, OfWhatIsNoInstrumentIsItsTips) {
  const Tool probe = make_wrist_probe(0.00075);
  for (const char* name : {"", "wrist_probe", "../shaver", "shaver:5.4", ":"})
    EXPECT_NEAR(size_in_use_mm(name, probe), 1.5, 1e-12) << name;
}

// The drawn window of an oblique scope and what is judged by its view lean the same way: +y.
TEST(InstrumentSize, TheWindowOfAnObliqueScopeIsDrawnTowardsPlusY) {
  const auto data = find_data_dir();
  ASSERT_TRUE(data);
  for (const char* name : {"arthroscope_30", "arthroscope_70", "wrist_arthroscope_2_7"}) {
    const auto scope =
        load_instrument(*data / "assets" / "instruments" / (name + std::string(".toml")));
    ASSERT_TRUE(scope) << scope.error().message();
    ASSERT_TRUE(scope->optics && scope->optics->angle_deg > 0);
    // Turned about x, what looked along -z looks towards +y.
    EXPECT_GT(scope->look.at(1).turn_deg.x(), 0) << name;
    EXPECT_EQ(scope->look.at(1).turn_deg.y(), 0) << name;
  }
}

}  // namespace
}  // namespace osteon
