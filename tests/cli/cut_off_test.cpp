// A piece that is cut off a bone in a session: seen by X-rays and saved where it lies.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "block_case.h"
#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

using Json = nlohmann::json;

constexpr int kSide = 160;

// An osteotome of 8 mm goes through a block of 6 mm, its edge along y: the lid of 1.5 mm that it
// cuts off comes to lie on the blade, which carries it along.
class CutOff : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    ASSERT_EQ(make_block_case(dir_, 3).exit_code, 0);
    std::ofstream(file("chisel.csv"))
        << "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button,instrument,size,power,jaw\n"
           "0,10,0,0.5,0.5,0.5,0.5,0.5,0,osteotome,8,0,0\n"
           "0.2,4,0,0.5,0.5,0.5,0.5,0.5,0,osteotome,8,1,0\n"
           "3.5,-7,0,0.5,0.5,0.5,0.5,0.5,0,osteotome,8,1,0\n";
    const Ran made = run_osteon("simulate --case '" + file("case") + "#block=field' --path " +
                                file("chisel.csv") + " --record " + file("r.osr") + " --report " +
                                file("report.json"));
    ASSERT_EQ(made.exit_code, 0) << made.output;
    std::ifstream in(file("report.json"));
    const Json carving = Json::parse(in, nullptr, false)["carving"];
    ASSERT_EQ(carving["loose"].size(), 1u) << carving.dump(2);
    piece_mm3_ = carving["loose"][0]["volume_mm3"];
    left_mm3_ = 216 - carving["removed_mm3"].get<double>();
  }
  /// Mass along each ray of a picture from the side, g/cm2, every bone of one density.
  std::vector<float> shadow(const std::string& of) {
    const Ran ran = run_osteon("xray " + of + " --view lateral --isocenter 0,0,0 --size 160x160 " +
                               "--c-arm field=30 --hu 700 --raw " + file("raw"));
    EXPECT_EQ(ran.exit_code, 0) << ran.output;
    std::vector<float> out(kSide * kSide);
    std::ifstream in(file("raw"), std::ios::binary);
    in.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(4 * out.size()));
    EXPECT_TRUE(in);
    return out;
  }
  double piece_mm3_ = 0, left_mm3_ = 0;
};

double sum_of(const std::vector<float>& values) {
  double sum = 0;
  for (const float value : values) sum += static_cast<double>(value);
  return sum;
}

// The case that is saved casts the shadow that the recording casts at that moment; without the
// piece it would lack a third of it.
TEST_F(CutOff, APieceIsSavedWhereXRaysSeeIt) {
  const Ran saved = run_osteon("case save " + file("r.osr") + " --at 3.4 --out " + file("after"));
  ASSERT_EQ(saved.exit_code, 0) << saved.output;
  EXPECT_NE(saved.output.find("1 carved bone and 1 loose piece at 3.4 s"), std::string::npos)
      << saved.output;
  const Ran info = run_osteon("case info --json " + file("after"));
  ASSERT_EQ(info.exit_code, 0) << info.output;
  const Json bones = Json::parse(info.output)["bones"];
  ASSERT_EQ(bones.size(), 2u) << info.output;
  EXPECT_EQ(bones[0]["name"], "block");
  EXPECT_EQ(bones[1]["name"], "block_piece");
  EXPECT_NEAR(1e3 * bones[1]["volume_cm3"].get<double>(), piece_mm3_, 0.05 * piece_mm3_);

  const std::vector<float> recorded = shadow(file("r.osr") + " --at 3.4");
  const std::vector<float> kept = shadow(file("after"));
  const double all = sum_of(recorded);
  const double piece_share = piece_mm3_ / (left_mm3_ + piece_mm3_);
  EXPECT_GT(piece_share, 0.2);
  EXPECT_NEAR(sum_of(kept), all, 0.02 * all);
  double apart = 0;
  for (std::size_t n = 0; n < kept.size(); ++n)
    apart += std::abs(static_cast<double>(kept[n]) - static_cast<double>(recorded[n]));
  EXPECT_LT(apart, 0.1 * piece_share * all);
}

// All of the block casts a shadow before the cut; afterwards what the blade took is missing, and
// the lid is not.
TEST_F(CutOff, XRaysMissWhatTheBladeTookAlone) {
  const double before = sum_of(shadow(file("r.osr") + " --at 0.1"));
  const double after = sum_of(shadow(file("r.osr") + " --at 3.4"));
  EXPECT_NEAR(after / before, (left_mm3_ + piece_mm3_) / 216, 0.03);
  EXPECT_GT(piece_mm3_, 0.2 * 216);
}

}  // namespace
}  // namespace osteon::testing_cli
