// Bone felt with its cartilage, in cases that were made elsewhere and in random patients.
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "block_case.h"
#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

using Json = nlohmann::json;

constexpr const char* kColumns =
    "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button,instrument,size,power,jaw\n";

class Covered : public CliTest {
 protected:
  /// Drills along path.csv; returns what the report says of carving.
  Json drilled(const std::string& spec, const std::string& name) {
    const Ran ran =
        run_osteon("simulate --case '" + spec + "' --path " + file("path.csv") + " --record " +
                   file(name + ".osr") + " --report " + file(name + ".json"));
    EXPECT_EQ(ran.exit_code, 0) << ran.output;
    std::ifstream in(file(name + ".json"));
    const Json report = Json::parse(in, nullptr, false);
    return report.is_object() ? report["carving"] : Json();
  }
  double cartilage_mm3(const Json& carving) {
    return carving["removed_by_tissue_mm3"]["cartilage"].get<double>();
  }
};

bool tells(const Json& carving, const std::string& kind) {
  for (const Json& event : carving["events"])
    if (event["kind"] == kind) return true;
  return false;
}

/// 2 mm of cartilage, 5 mm wide, on the top of a block of 6 mm.
void add_layer(const fs::path& folder) {
  std::ofstream layer(folder / "layer.obj");
  for (int i = 0; i < 8; ++i)
    layer << "v " << (i & 1 ? 0.0025 : -0.0025) << ' ' << (i & 2 ? 0.0025 : -0.0025) << ' '
          << (i & 4 ? 0.005 : 0.003) << '\n';
  layer << "f 1 3 2\nf 2 3 4\nf 5 6 7\nf 6 8 7\nf 1 2 5\nf 2 6 5\nf 3 7 4\nf 4 7 8\n"
           "f 1 5 3\nf 3 5 7\nf 2 4 6\nf 4 8 6\n";
  std::ofstream(folder / "case.toml", std::ios::app)
      << "\n[[soft]]\nname = \"layer\"\nfma_id = 0\ntissue = \"articular_cartilage\"\n"
         "kind = \"cartilage\"\nmesh = \"layer.obj\"\nthickness_m = 0.002\nbones = [\"block\"]\n";
}

// Without any cartilage in the case a bone is felt and drilled as it is.
TEST_F(Covered, ABoneWithoutCartilageIsBareBone) {
  ASSERT_EQ(make_block_case(dir_, 3).exit_code, 0);
  std::ofstream(file("path.csv")) << kColumns
                                  << "0,0,0,6,1,0,0,0,0,drill,2,1,0\n"
                                     "4,0,0,-7,1,0,0,0,0,drill,2,1,0\n";
  const Json covered = drilled(file("case") + "#block=covered", "covered");
  const Json bare = drilled(file("case") + "#block=field", "bare");
  EXPECT_EQ(cartilage_mm3(covered), 0);
  EXPECT_GT(bare["removed_mm3"].get<double>(), 1);
  EXPECT_EQ(covered["removed_mm3"], bare["removed_mm3"]);
}

// A drill of 2 mm takes pi r^2 times 2 mm of the layer. What is saved is such a case again: the
// drill falls into its hole and takes no more cartilage.
TEST_F(Covered, TheCartilageOfAFolderIsDrilledAndSaved) {
  ASSERT_EQ(make_block_case(dir_, 3).exit_code, 0);
  add_layer(dir_ / "case");
  std::ofstream(file("path.csv")) << kColumns
                                  << "0,0,0,8,1,0,0,0,0,drill,2,1,0\n"
                                     "0.2,0,0,6,1,0,0,0,0,drill,2,1,0\n"
                                     "4,0,0,-7,1,0,0,0,0,drill,2,1,0\n";
  const Json first = drilled(file("case") + "#block=covered", "first");
  EXPECT_NEAR(cartilage_mm3(first), 2 * std::numbers::pi, 0.05);
  EXPECT_TRUE(tells(first, "cartilage_entered"));
  EXPECT_TRUE(tells(first, "cortex_entered"));
  const Ran saved = run_osteon("case save " + file("first.osr") + " --at 4 --out " + file("after"));
  ASSERT_EQ(saved.exit_code, 0) << saved.output;
  const Json again = drilled(file("after"), "again");
  EXPECT_LT(cartilage_mm3(again), 0.3);
  EXPECT_FALSE(tells(again, "cartilage_entered"));
}

// Down onto the femur of three patients, bent by 100 degrees; and of the first from a folder. Takes
// half a minute of a core each.
TEST_F(Covered, RandomPatientsAreDrilledThroughTheirCartilage) {
  if (!std::getenv("OSTEON_LONG")) GTEST_SKIP() << "OSTEON_LONG is not set";
  std::ofstream(file("path.csv")) << kColumns
                                  << "0,-20.3,-16.5,36,1,0,0,0,0,drill,3.2,1,0\n"
                                     "4,-20.3,-16.5,22,1,0,0,0,0,drill,3.2,1,0\n";
  double first = 0;
  for (const std::string seed : {"5", "4", "3"}) {
    const Json carving =
        drilled("builtin:knee:" + seed + "#femur=covered,near=60,flexion=100", seed);
    EXPECT_TRUE(tells(carving, "cartilage_entered")) << seed;
    EXPECT_TRUE(tells(carving, "cortex_entered")) << seed;
    first = cartilage_mm3(carving);
    EXPECT_GT(first, 8) << seed;   // 1 mm
    EXPECT_LT(first, 33) << seed;  // 4 mm
  }
  const Ran posed = run_osteon("case pose builtin:knee:3 --flexion 100 --out " + file("bent"));
  ASSERT_EQ(posed.exit_code, 0) << posed.output;
  const double of_folder = cartilage_mm3(drilled(file("bent") + "#femur=covered", "folder"));
  EXPECT_NEAR(of_folder, first, 0.03 * first);
}

}  // namespace
}  // namespace osteon::testing_cli
