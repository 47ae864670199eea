// Every soft part of the built-in anatomies, as a simulation of soft tissue would take it.
#include "anatomy/soft/filled_checks.h"

namespace osteon {
namespace {

void expect_all_filled(const std::string& name) {
  const auto grown = generate_anatomy(std::filesystem::path(OSTEON_SOURCE_DIR) / "assets/anatomy" /
                                      (name + ".toml"));
  ASSERT_TRUE(grown) << grown.error().message();
  for (const GeneratedSoft& soft : grown->softs) checks::expect_filled(soft);
}

TEST(SoftFilled, EverySoftPartOfTheWrist) { expect_all_filled("wrist"); }
TEST(SoftFilled, EverySoftPartOfTheKnee) { expect_all_filled("knee"); }

}  // namespace
}  // namespace osteon
