// The bundled probe paths feel what their expectations say, and a clumsy path does not.
#include <fstream>

#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

std::string bundled(const std::string& name) {
  return std::string(OSTEON_SOURCE_DIR) + "/assets/paths/" + name;
}

Ran replay(const std::string& path, const std::string& expectation) {
  return run_osteon("replay " + bundled(path) + ".csv --expect " + bundled(expectation) +
                    ".expect.json");
}

class BundledPath : public CliTest, public testing::WithParamInterface<const char*> {};

TEST_P(BundledPath, FeelsWhatIsExpected) {
  const Ran ran = replay(GetParam(), GetParam());
  EXPECT_EQ(ran.exit_code, 0) << ran.output;
}

INSTANTIATE_TEST_SUITE_P(All, BundledPath,
                         testing::Values("wrist_tap", "wrist_slide", "wrist_rest",
                                         "wrist_push_through"));

using Expectation = CliTest;

TEST_F(Expectation, AHeavyHandFailsAndIsToldWhy) {
  const Ran ran = replay("wrist_push_through", "wrist_tap");
  EXPECT_EQ(ran.exit_code, 1) << ran.output;
  EXPECT_NE(ran.output.find("not as expected"), std::string::npos) << ran.output;
  EXPECT_NE(ran.output.find("radius"), std::string::npos) << ran.output;
}

// The same slide 3 mm deeper: the probe slips off the side of the shaft.
TEST_F(Expectation, ASlideThatSlipsOffTheBoneFails) {
  std::ifstream in(bundled("wrist_slide.csv"));
  std::ofstream out(file("deep.csv"));
  std::string line;
  std::getline(in, line);
  out << line << '\n';
  double t = 0, x = 0, y = 0, z = 0;
  while (std::getline(in, line)) {
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &t, &x, &y, &z), 4);
    out << t << ',' << x << ',' << y << ',' << z - 3 << ",1,0,0,0,0\n";
  }
  out.close();
  const Ran ran =
      run_osteon("replay " + file("deep.csv") + " --expect " + bundled("wrist_slide.expect.json"));
  EXPECT_EQ(ran.exit_code, 1) << ran.output;
  EXPECT_NE(ran.output.find("mean_force_n"), std::string::npos) << ran.output;
}

}  // namespace
}  // namespace osteon::testing_cli
