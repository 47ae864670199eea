// The main job on real bones, through the command line alone.
#include <nlohmann/json.hpp>

#include "osteon/base/file.h"
#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

using Json = nlohmann::json;

/// Imported once, with its pieces, for all of the suite.
class RealWrist : public CliTest {
 protected:
  static void SetUpTestSuite() {
    if (shared_dir().empty()) return;
    imported_ = fs::temp_directory_path() / ("osteon_real_wrist_" + std::to_string(::getpid()));
    const Ran ran = run_osteon("import mesh " + (shared_dir() / "anatomy/wrist").string() +
                               " --unit m --out " + imported_.string());
    ASSERT_EQ(ran.exit_code, 0) << ran.output;
  }
  static void TearDownTestSuite() {
    if (!imported_.empty()) fs::remove_all(imported_);
  }
  void SetUp() override {
    CliTest::SetUp();
    if (shared_dir().empty()) GTEST_SKIP() << "the reference bones are not here (../shared)";
  }
  static std::string wrist() { return imported_.string(); }

  static inline fs::path imported_;
};

// Largest distance between the felt and the mesh, mm, of the carpals and the radius' ends.
void expect_felt_closely(const std::string& spec) {
  constexpr double kClose_mm = 0.3;
  const Ran ran = run_osteon("case felt '" + spec + "' --json");
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const Json bones = Json::parse(ran.output)["bones"];
  const auto check = [&](const std::string& name, const char* which) {
    ASSERT_TRUE(bones.contains(name));
    EXPECT_LE(bones[name]["pieces"].get<int>(), 64) << name;
    EXPECT_LE(bones[name][which]["max"].get<double>(), kClose_mm) << name << " of " << spec;
    EXPECT_GT(bones[name][which]["max"].get<double>(), 0.01) << name;
  };
  for (const char* name : {"scaphoid", "lunate", "triquetrum", "pisiform", "trapezium", "trapezoid",
                           "capitate", "hamate"})
    check(name, "felt_to_mesh_mm");
  check("radius", "felt_to_mesh_at_ends_mm");
}

TEST_F(RealWrist, PiecesStandNoHigherThanThreeTenthsOfAMillimetreOverTheCarpalsAndTheRadiusEnds) {
  expect_felt_closely(wrist());
}

TEST_F(CliTest, ThePiecesOfTheBuiltInWristStandNoHigherThanThreeTenthsOfAMillimetre) {
  expect_felt_closely("builtin:wrist");
}

TEST_F(RealWrist, ImportsFifteenNamedBonesThatCheckSound) {
  const Ran info = run_osteon("case info " + wrist());
  ASSERT_EQ(info.exit_code, 0) << info.output;
  for (const char* name : {"scaphoid", "lunate", "triquetrum", "pisiform", "trapezium", "trapezoid",
                           "capitate", "hamate", "radius", "ulna", "metacarpal_1", "metacarpal_2",
                           "metacarpal_3", "metacarpal_4", "metacarpal_5"})
    EXPECT_NE(info.output.find(name), std::string::npos) << name << " in\n" << info.output;
}

TEST_F(RealWrist, ASurveyOfAMinuteTouchesTwelveBonesAndReplaysIdentically) {
  const Ran survey =
      run_osteon("path survey --case " + wrist() + " --seed 3 --out " + file("p.csv"));
  ASSERT_EQ(survey.exit_code, 0) << survey.output;
  const Ran run =
      run_osteon("simulate --case " + wrist() + " --path " + file("p.csv") +
                 " --free-bones --record " + file("r.osr") + " --report " + file("r.json"));
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const Json report = Json::parse(read_file(file("r.json")).value());
  EXPECT_GE(report["duration_s"].get<double>(), 60);
  int touched = 0;
  for (const auto& [name, bone] : report["bones"].items())
    touched += bone["contact_time_s"].get<double>() > 0.5;
  EXPECT_GE(touched, 12) << run.output;
  const Ran replay = run_osteon("replay " + file("r.osr") + " --report " + file("r2.json"));
  EXPECT_EQ(replay.exit_code, 0) << replay.output;
  const Json again = Json::parse(read_file(file("r2.json")).value());
  EXPECT_EQ(again["bones"], report["bones"]);
  EXPECT_EQ(again["state_hash"], report["state_hash"]);
  EXPECT_EQ(again["path_length_mm"], report["path_length_mm"]);
}

TEST_F(RealWrist, ThePressIsTheForceThatWasAskedFor) {
  const Ran survey =
      run_osteon("path survey --case " + wrist() + " --force 2 --out " + file("p.csv"));
  ASSERT_EQ(survey.exit_code, 0) << survey.output;
  const Ran run = run_osteon("simulate --case " + wrist() + " --path " + file("p.csv") +
                             " --report " + file("r.json"));
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const Json report = Json::parse(read_file(file("r.json")).value());
  int pressed = 0;
  for (const auto& [name, bone] : report["bones"].items()) {
    const double mean = bone["mean_force_n"].get<double>();
    pressed += mean > 1.0 && mean < 3.0;
    EXPECT_LT(bone["peak_force_n"].get<double>(), 8.01) << name;
  }
  EXPECT_GE(pressed, 12) << run.output;
}

}  // namespace
}  // namespace osteon::testing_cli
