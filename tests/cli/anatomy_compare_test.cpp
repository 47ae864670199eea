// How like the built-in bones are to others, through the command line alone.
#include <map>
#include <nlohmann/json.hpp>

#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

class AnatomyCompare : public CliTest {
 protected:
  static nlohmann::json compare(const std::string& arguments) {
    const Ran ran = run_osteon("anatomy compare " + arguments + " --json");
    EXPECT_EQ(ran.exit_code, 0) << ran.output;
    return nlohmann::json::parse(ran.output, nullptr, false);
  }
};

TEST_F(AnatomyCompare, BadReferencesExitWithTwoAndSayWhy) {
  for (const char* bad : {"builtin:wrist --reference /nowhere", "builtin:wrist",
                          "builtin:elbow --reference builtin:wrist"}) {
    const Ran ran = run_osteon("anatomy compare " + std::string(bad));
    EXPECT_EQ(ran.exit_code, 2) << bad << ": " << ran.output;
    EXPECT_FALSE(ran.output.empty());
  }
  const fs::path skull = shared_dir() / "anatomy/skull";
  if (!fs::is_directory(skull)) return;
  const Ran ran = run_osteon("anatomy compare builtin:wrist --reference " + skull.string());
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_NE(ran.output.find("same name"), std::string::npos) << ran.output;
}

TEST_F(AnatomyCompare, TheWristIsLikeTheBonesOfTheReference) {
  const fs::path reference = shared_dir() / "anatomy/wrist";
  if (!fs::is_directory(reference)) GTEST_SKIP() << "no reference bones; set OSTEON_SHARED";
  const auto got = compare("builtin:wrist --reference " + reference.string());
  std::map<std::string, double> means_mm;
  for (const auto& row : got["bones"]) {
    means_mm[row["bone"]] = row["mean_mm"];
    EXPECT_GT(row["p95_mm"], row["mean_mm"]) << row;
    EXPECT_NEAR(row["scale"], 1, 0.2) << row;
  }
  EXPECT_EQ(means_mm.size(), 15u);
  for (const auto& [bone, mean_mm] : means_mm) {
    std::printf("%-13s %.2f mm\n", bone.c_str(), mean_mm);
    const bool metacarpal = bone.starts_with("metacarpal");
    if (bone == "radius" || bone == "ulna") continue;  // of the reference these are coarse
    EXPECT_LE(mean_mm, metacarpal ? 1.5 : 1.0) << bone;
  }
  ASSERT_GE(got["gaps"].size(), 19u);
  for (const auto& row : got["gaps"]) EXPECT_GT(row["gap_mm"], -0.1) << row;
}

}  // namespace
}  // namespace osteon::testing_cli
