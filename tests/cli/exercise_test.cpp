#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "block_case.h"

namespace osteon::testing_cli {
namespace {

using Json = nlohmann::json;

class Exercise : public CliTest {
 protected:
  Json read(const std::string& name) const {
    std::ifstream in(file(name));
    return Json::parse(in);
  }
  // A circle of 20 mm in 4 s through the block's top.
  void write_circle() const {
    std::ofstream csv(file("circle.csv"));
    csv.precision(15);
    csv << "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button\n";
    for (int i = 0; i <= 4000; ++i) {
      const double a = 2 * 3.14159265358979323846 * i / 4000;
      csv << i * 0.001 << ',' << 30 + 20 * std::cos(a) << ',' << 20 * std::sin(a)
          << ",0,1,0,0,0,0\n";
    }
  }
};

TEST_F(Exercise, MetricsOfACircleAreItsClosedForms) {
  write_circle();
  const Ran ran = run_osteon("metrics " + file("circle.csv") + " --json");
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const Json m = Json::parse(ran.output);
  const double v = 10 * 3.14159265358979323846;
  EXPECT_NEAR(m["path_mm"].get<double>(), 4 * v, 4e-3 * v);
  EXPECT_NEAR(m["smoothness"].get<double>(), v * v * v / 400 * 2, 1e-3 * v * v * v / 200);
  EXPECT_TRUE(m["time_in_tissue_s"].is_null());
  EXPECT_TRUE(m["inefficiency_percent"].is_null());
}

TEST_F(Exercise, MetricsKnowTheTissueAndRefuseAnOpenOne) {
  write_circle();
  ASSERT_EQ(make_block_case(dir_).exit_code, 0);
  const std::string circle = "metrics " + file("circle.csv") + " --json --tissue ";
  const Ran inside = run_osteon(circle + file("meshes/block.obj"));
  ASSERT_EQ(inside.exit_code, 0) << inside.output;
  // Within x < 20 mm: two thirds of a right angle to either side of the near point.
  EXPECT_NEAR(Json::parse(inside.output)["time_in_tissue_s"].get<double>(), 4.0 / 3, 2e-3);
  std::ofstream open(file("open.obj"));
  open << "v 0 0 0\nv 40 0 0\nv 0 40 0\nv 0 0 40\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";
  open.close();
  const Ran refused = run_osteon(circle + file("open.obj"));
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.output.find("not closed: 3 open edges"), std::string::npos) << refused.output;
}

TEST_F(Exercise, MetricsRefuseBadPaths) {
  const std::string head = "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button\n";
  const std::string row = "0,0,0,0,1,0,0,0,0\n";
  for (const std::string& rows : {std::string(), row, row + "0,1,0,0,1,0,0,0,0\n",
                                  row + "-1,1,0,0,1,0,0,0,0\n", row + "1,nan,0,0,1,0,0,0,0\n"}) {
    std::ofstream(file("bad.csv")) << head << rows;
    const Ran ran = run_osteon("metrics " + file("bad.csv"));
    EXPECT_EQ(ran.exit_code, 2) << rows << ran.output;
    EXPECT_NE(ran.output.find("osteon: "), std::string::npos);
  }
  EXPECT_EQ(run_osteon("metrics " + file("none.csv")).exit_code, 2);
}

TEST_F(Exercise, ScenariosAreListedAndChecked) {
  const Ran list = run_osteon("scenario list --json");
  ASSERT_EQ(list.exit_code, 0) << list.output;
  const Json all = Json::parse(list.output);
  ASSERT_GE(all.size(), 1u);
  for (const Json& s : all)
    for (const char* key : {"name", "title", "stages", "errors", "surgeons"})
      EXPECT_TRUE(s.contains(key)) << s;
  EXPECT_EQ(run_osteon("scenario info nothing").exit_code, 2);
  std::ofstream(file("bad.toml")) << "format = 1\nname = 3\n";
  const Ran bad = run_osteon("scenario check " + file("bad.toml"));
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_NE(bad.output.find("bad.toml:2"), std::string::npos) << bad.output;
}

// One scenario on one block, so that no patient need be grown: expert and every bad path.
TEST_F(Exercise, TheExpertTouchesABlockAndEachBadOneMakesItsErrorAlone) {
  ASSERT_EQ(make_block_case(dir_).exit_code, 0);
  std::string text;
  {
    std::ifstream in(std::string(OSTEON_SOURCE_DIR) + "/assets/scenarios/touch_bones.toml");
    text.assign(std::istreambuf_iterator<char>(in), {});
  }
  const std::size_t stages = text.find("[[stages]]"), errors = text.find("[[errors]]");
  text = text.substr(0, stages) +
         "[[stages]]\nname = \"block\"\ntitle = \"B\"\ninstruction = \"Touch it.\"\n"
         "[[stages.goals]]\nrule = \"touched\"\nfor_s = 0.2\nforce_n = 0.3\n" +
         text.substr(errors);
  std::ofstream(file("block.toml")) << text;
  const std::string run = "run " + file("block.toml") + " --case " + file("case") +
                          " --no-store --report " + file("r.json") + " --surgeon ";
  const Ran expert = run_osteon(run + "expert --record " + file("r.osr"));
  ASSERT_NE(expert.exit_code, 2) << expert.output;
  EXPECT_TRUE(read("r.json")["errors"].empty()) << expert.output;
  EXPECT_TRUE(read("r.json")["stages"][0]["completed_s"].is_number()) << expert.output;
  EXPECT_EQ(read("r.json")["metrics"]["peak_force_n"].get<double>() > 0.3, true);
  EXPECT_EQ(run_osteon("replay " + file("r.osr")).exit_code, 0);
  for (const std::string error : {"too_hard", "scratch", "strike"}) {
    const Ran bad = run_osteon(run + "bad:" + error);
    EXPECT_EQ(bad.exit_code, 1) << bad.output;
    const Json made = read("r.json")["errors"];
    ASSERT_FALSE(made.empty()) << error << bad.output;
    for (const Json& e : made) EXPECT_EQ(e["name"], error) << bad.output;
  }
  EXPECT_EQ(run_osteon(run + "bad:nothing").exit_code, 2);
}

// A box of posts is grown in no time: both hands are in the report, and the run repeats, its loose
// rings with it.
TEST_F(Exercise, TheRingsGoToTheFarPostsAndTheRecordingRepeats) {
  const Ran expert = run_osteon("run fast_ring_transfer --seed 3 --no-store --report " +
                                file("r.json") + " --surgeon expert --record " + file("r.osr"));
  ASSERT_EQ(expert.exit_code, 0) << expert.output;
  EXPECT_TRUE(read("r.json")["hands"]["scope"].contains("bones"));
  EXPECT_TRUE(read("r.json")["hands"]["grasper"].contains("bones"));
  EXPECT_TRUE(read("r.json")["errors"].empty());
  EXPECT_EQ(run_osteon("replay " + file("r.osr")).exit_code, 0);
}

}  // namespace
}  // namespace osteon::testing_cli
