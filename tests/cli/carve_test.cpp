// Bone removed along a path, through the command line alone.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "block_case.h"
#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

constexpr const char* kHead = "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button\n";

class Carve : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    ASSERT_EQ(make_block_case(dir_).exit_code, 0);
    std::ofstream(file("down.csv")) << kHead << "0,0,0,25,1,0,0,0,1\n0.5,0,0,10,1,0,0,0,1\n";
    std::ofstream(file("pose.csv")) << kHead << "0,1,2,3,1,0,0,0,1\n";
    std::ofstream(file("air.csv")) << kHead << "0,0,0,90,1,0,0,0,1\n1,0,0,80,1,0,0,0,1\n";
  }
  std::string arguments(const std::string& tool, const std::string& size, const std::string& path) {
    return "carve " + file("case") + "#block --tool " + tool + " --size " + size + " --path " +
           file(path) + " --out " + file("out.stl");
  }
};

TEST_F(Carve, BadInputExitsWithTwoAndWritesNothing) {
  std::ofstream(file("nan.csv")) << kHead << "0,nan,0,0,1,0,0,0,1\n";
  std::ofstream(file("empty.csv")) << kHead;
  const std::pair<std::string, std::string> bad[] = {
      {arguments("spoon", "4", "down.csv"), "burr, drill"},
      {arguments("burr", "0", "down.csv"), "0.2 to 40 mm"},
      {arguments("burr", "nan", "down.csv"), "not a finite number"},
      {arguments("burr", "4", "nan.csv"), "nan.csv"},
      {arguments("burr", "4", "empty.csv"), "empty.csv"},
      {arguments("burr", "4", "none.csv"), "none.csv"},
      {arguments("burr", "4", "down.csv") + " --cell 0.02 --memory-mb 16", "16 MB are allowed"},
      {arguments("burr", "4", "down.csv") + " --cell nan", "not a finite number"},
      {arguments("burr", "4", "down.csv") + " --cell 3", "0.02 to 2 mm"},
      {"carve " + file("case") + "#femur --tool burr --size 4 --path " + file("down.csv") +
           " --out " + file("out.stl"),
       "It has block"}};
  for (const auto& [words, why] : bad) {
    const Ran ran = run_osteon(words);
    EXPECT_EQ(ran.exit_code, 2) << words << ": " << ran.output;
    EXPECT_NE(ran.output.find(why), std::string::npos) << words << ": " << ran.output;
    EXPECT_FALSE(fs::exists(file("out.stl"))) << words;
  }
}

TEST_F(Carve, ABurrsWayIsReportedAndWritten) {
  const Ran ran = run_osteon(arguments("burr", "4", "down.csv") + " --json");
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const auto report = nlohmann::json::parse(ran.output, nullptr, false);
  ASSERT_TRUE(report.is_object()) << ran.output;
  const double wanted = std::numbers::pi * (4 * 10 + 2.0 / 3 * 8);
  EXPECT_NEAR(report["removed_mm3"].get<double>(), wanted, 0.005 * wanted);
  const auto& tissues = report["removed_by_tissue_mm3"];
  double sum = 0;
  for (const auto& [name, mm3] : tissues.items()) sum += mm3.get<double>();
  EXPECT_NEAR(sum, report["removed_mm3"].get<double>(), 1e-9);
  EXPECT_NEAR(tissues["cortical_bone"].get<double>(), std::numbers::pi * 4 * 1.2, 0.2);
  EXPECT_EQ(report["steps"], 501);
  EXPECT_GT(report["blocks"], 10);
  EXPECT_GT(report["surface_us"], 0);
  EXPECT_LE(report["step_us"]["p50"], report["step_us"]["p99"]);
  EXPECT_LE(report["step_us"]["p99"], report["step_us"]["p999"]);
  EXPECT_TRUE(fs::exists(file("out.stl")));
}

TEST_F(Carve, APathOfOnePoseCutsThere) {
  const Ran ran = run_osteon(arguments("burr", "4", "pose.csv") + " --json");
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const auto report = nlohmann::json::parse(ran.output, nullptr, false);
  const double ball = std::numbers::pi * 32 / 3;
  EXPECT_EQ(report["steps"], 1);
  EXPECT_NEAR(report["removed_mm3"].get<double>(), ball, 0.005 * ball);
}

TEST_F(Carve, APathThroughNothingRemovesNothingAndSaysSo) {
  const Ran ran = run_osteon(arguments("burr", "4", "air.csv"));
  EXPECT_EQ(ran.exit_code, 0) << ran.output;
  EXPECT_NE(ran.output.find("nothing was removed"), std::string::npos) << ran.output;
  EXPECT_TRUE(fs::exists(file("out.stl")));
}

// A hole drilled in a session is measured in its recording, at its end or before; a ball that the
// drill went through keeps what lies beside the cylinder: (1 - r^2/R^2)^(3/2).
TEST_F(Carve, ARecordingIsMeasuredAsItWasLeft) {
  std::filesystem::remove_all(file("case"));
  ASSERT_EQ(make_block_case(dir_, 5).exit_code, 0);
  std::ofstream(file("drill.csv"))
      << "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button,instrument,size,power,jaw\n"
         "0,0,0,8,1,0,0,0,0,drill,3.2,1,0\n0.2,0,0,6,1,0,0,0,0,drill,3.2,1,0\n"
         "9,0,0,-22,1,0,0,0,0,drill,3.2,1,0\n";
  const Ran made = run_osteon("simulate --case '" + file("case") + "#block=field' --path " +
                              file("drill.csv") + " --record " + file("r.osr"));
  ASSERT_EQ(made.exit_code, 0) << made.output;
  const Ran ran = run_osteon("case measure " + file("r.osr") + " --region mid=0,0,0,2 --json");
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const auto report = nlohmann::json::parse(ran.output, nullptr, false);
  ASSERT_EQ(report["holes"].size(), 1u) << ran.output;
  const auto& hole = report["holes"][0];
  EXPECT_NEAR(hole["diameter_mm"].get<double>(), 3.2, 0.05);
  EXPECT_NEAR(hole["length_mm"].get<double>(), 10, 0.3);
  EXPECT_TRUE(hole["through"].get<bool>());
  ASSERT_EQ(report["regions"].size(), 1u);
  EXPECT_NEAR(report["regions"][0]["share_removed"].get<double>(), 1 - std::pow(0.36, 1.5), 0.02);
  const Ran before = run_osteon("case measure " + file("r.osr") + " --at 0.1 --json");
  ASSERT_EQ(before.exit_code, 0) << before.output;
  EXPECT_TRUE(nlohmann::json::parse(before.output)["holes"].empty());
  const std::pair<std::string, std::string> bad[] = {{file("r.osr") + " --at 99", "ends at"},
                                                     {file("case") + " --at 1", "recordings only"},
                                                     {file("none.osr"), "none.osr"}};
  for (const auto& [words, why] : bad) {
    const Ran refused = run_osteon("case measure " + words);
    EXPECT_EQ(refused.exit_code, 2) << words << ": " << refused.output;
    EXPECT_NE(refused.output.find(why), std::string::npos) << words << ": " << refused.output;
  }
}

// Enclosed by the triangles of a binary STL file that is in metres, mm3.
double stl_volume(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  in.seekg(80);
  std::uint32_t count = 0;
  in.read(reinterpret_cast<char*>(&count), sizeof count);
  double sum = 0;
  std::array<char, 50> bytes{};
  for (std::uint32_t t = 0; t < count && in.read(bytes.data(), 50); ++t) {
    std::array<float, 12> f{};
    std::memcpy(f.data(), bytes.data(), sizeof f);
    const auto at = [&](std::size_t k) { return static_cast<double>(f[k]); };
    sum += at(3) * (at(7) * at(11) - at(8) * at(10)) - at(4) * (at(6) * at(11) - at(8) * at(9)) +
           at(5) * (at(6) * at(10) - at(7) * at(9));
  }
  return 1e9 * sum / 6;
}

// A layer of 2 mm on the block's top: a case that was made elsewhere and has cartilage.
TEST_F(Carve, TheCartilageOfACaseIsCarvedToo) {
  std::ofstream layer(file("case/layer.obj"));
  for (int i = 0; i < 8; ++i)
    layer << "v " << (i & 1 ? 0.015 : -0.015) << ' ' << (i & 2 ? 0.015 : -0.015) << ' '
          << (i & 4 ? 0.022 : 0.020) << '\n';
  layer << "f 1 3 2\nf 2 3 4\nf 5 6 7\nf 6 8 7\nf 1 2 5\nf 2 6 5\nf 3 7 4\nf 4 7 8\n"
           "f 1 5 3\nf 3 5 7\nf 2 4 6\nf 4 8 6\n";
  layer.close();
  std::ofstream(file("case/case.toml"), std::ios::app)
      << "\n[[soft]]\nname = \"layer\"\nfma_id = 0\ntissue = \"articular_cartilage\"\n"
         "kind = \"cartilage\"\nmesh = \"layer.obj\"\nthickness_m = 0.002\nbones = [\"block\"]\n";
  const Ran ran = run_osteon(arguments("burr", "4", "down.csv") + " --json");
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const auto report = nlohmann::json::parse(ran.output, nullptr, false);
  ASSERT_TRUE(report.is_object()) << ran.output;
  const auto& tissues = report["removed_by_tissue_mm3"];
  const double layer_mm3 = std::numbers::pi * 4 * 2;
  const double bone_mm3 = std::numbers::pi * (4 * 10 + 2.0 / 3 * 8);
  EXPECT_NEAR(tissues["cartilage"].get<double>(), layer_mm3, 0.005 * layer_mm3);
  EXPECT_NEAR(report["removed_mm3"].get<double>(), layer_mm3 + bone_mm3, 0.005 * bone_mm3);
  EXPECT_NEAR(tissues["cortical_bone"].get<double>(), std::numbers::pi * 4 * 1.2, 0.2);
  // What is written is the bone: a cube of 40 mm less its part, without the layer.
  EXPECT_NEAR(stl_volume(file("out.stl")), 64000 - bone_mm3, 0.005 * 64000);
  EXPECT_LT(stl_volume(file("out.stl")), 64000 - 0.5 * bone_mm3);
}

// Its author wrote millimetres where the case has metres.
TEST_F(Carve, ALayerOfAMistakenUnitIsLeftOutAndNamed) {
  std::ofstream layer(file("case/layer.obj"));
  for (int i = 0; i < 8; ++i)
    layer << "v " << (i & 1 ? 15 : -15) << ' ' << (i & 2 ? 15 : -15) << ' ' << (i & 4 ? 22 : 20)
          << '\n';
  layer << "f 1 3 2\nf 2 3 4\nf 5 6 7\nf 6 8 7\nf 1 2 5\nf 2 6 5\nf 3 7 4\nf 4 7 8\n"
           "f 1 5 3\nf 3 5 7\nf 2 4 6\nf 4 8 6\n";
  layer.close();
  std::ofstream(file("case/case.toml"), std::ios::app)
      << "\n[[soft]]\nname = \"layer\"\nfma_id = 0\ntissue = \"articular_cartilage\"\n"
         "kind = \"cartilage\"\nmesh = \"layer.obj\"\nthickness_m = 0.002\nbones = [\"block\"]\n";
  const Ran ran = run_osteon(arguments("burr", "4", "down.csv"));
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_NE(ran.output.find("unit"), std::string::npos) << ran.output;
  EXPECT_NE(ran.output.find("cartilage on 'block'"), std::string::npos) << ran.output;
}

TEST_F(Carve, AToolLargerThanTheBoneIsRefused) {
  std::ofstream(file("small.obj")) << "";
  fs::create_directories(dir_ / "small");
  std::ofstream block(dir_ / "small/chip.obj");
  for (int i = 0; i < 8; ++i)
    block << "v " << (i & 1 ? 2 : -2) << ' ' << (i & 2 ? 2 : -2) << ' ' << (i & 4 ? 2 : -2) << '\n';
  block << "f 1 3 2\nf 2 3 4\nf 5 6 7\nf 6 8 7\nf 1 2 5\nf 2 6 5\nf 3 7 4\nf 4 7 8\n"
           "f 1 5 3\nf 3 5 7\nf 2 4 6\nf 4 8 6\n";
  block.close();
  ASSERT_EQ(
      run_osteon("import mesh " + file("small") + " --unit mm --out " + file("chip")).exit_code, 0);
  const Ran ran = run_osteon("carve " + file("chip") + "#chip --tool burr --size 6 --path " +
                             file("down.csv") + " --out " + file("out.stl"));
  EXPECT_EQ(ran.exit_code, 2) << ran.output;
  EXPECT_NE(ran.output.find("larger than the bone"), std::string::npos) << ran.output;
  EXPECT_FALSE(fs::exists(file("out.stl")));
}

}  // namespace
}  // namespace osteon::testing_cli
