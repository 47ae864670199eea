// osteon xray as a user runs it: phantoms by their closed form, a case beside plastimatch's picture
// of its virtual scan, files and bad input.
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "block_case.h"
#include "osteon/base/types.h"
#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

using Json = nlohmann::json;

struct Raw {
  Json at;
  std::vector<float> g_per_cm2;
};

Raw read_raw(const std::string& file) {
  Raw raw;
  std::ifstream(file + ".json") >> raw.at;
  std::ifstream in(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  raw.g_per_cm2.resize(bytes.size() / 4);
  std::memcpy(raw.g_per_cm2.data(), bytes.data(), 4 * raw.g_per_cm2.size());
  return raw;
}

Vec3 vec(const Json& json) {
  return Vec3(json[0].get<double>(), json[1].get<double>(), json[2].get<double>());
}

/// From the file's words alone: how far the ray of a pixel goes in the block of 40 mm, cm.
double block_chord_cm(const Json& at, int column, int row) {
  const Vec3 source = vec(at["source_mm"]);
  const double pixel = at["pixel_mm"];
  const Vec3 to = vec(at["detector_center_mm"]) +
                  pixel * (column - 0.5 * (at["width"].get<int>() - 1)) * vec(at["u_axis"]) +
                  pixel * (row - 0.5 * (at["height"].get<int>() - 1)) * vec(at["v_axis"]);
  const Vec3 dir = (to - source).normalized();
  double enter = 0, leave = 1e9;
  for (int a = 0; a < 3; ++a) {
    const double t0 = (-20 - source[a]) / dir[a], t1 = (20 - source[a]) / dir[a];
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  return 0.1 * std::max(0.0, leave - enter);
}

class XrayCli : public CliTest {
 protected:
  Ran xray(const std::string& arguments) { return run_osteon("xray " + arguments); }
};

TEST_F(XrayCli, ABlockOfOneHuIsItsChords) {
  ASSERT_EQ(make_block_case(dir_).exit_code, 0);
  const Ran ran =
      xray(file("case") + " --c-arm orbit=25,angulation=10 --size 96x64 --hu 700 --raw " +
           file("raw") + " --out " + file("a.png") + " --json");
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const Raw raw = read_raw(file("raw"));
  ASSERT_EQ(raw.g_per_cm2.size(), 96u * 64u);
  const double density = 0.0005886 * 700 + 1.03;
  int inside = 0;
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 96; ++column) {
      const double want = density * block_chord_cm(raw.at, column, row);
      EXPECT_NEAR(raw.g_per_cm2[static_cast<std::size_t>(96 * row + column)], want,
                  0.005 * want + 1e-3)
          << column << ", " << row;
      inside += want > 0;
    }
  EXPECT_GT(inside, 300);
  const Json told = Json::parse(ran.output);
  EXPECT_EQ(told["source_mm"], raw.at["source_mm"]);
  EXPECT_NEAR(told["dose"]["air_kerma_mgy"].get<double>(), 0.069 * told["mas"].get<double>(), 1e-9);
  EXPECT_NEAR(
      told["dose"]["kap_mgy_cm2"].get<double>(),
      told["dose"]["air_kerma_mgy"].get<double>() * told["dose"]["beam_area_cm2"].get<double>(),
      1e-9);
}

TEST_F(XrayCli, PicturesAreWrittenAsPngAndAsDicomTheSameEachTime) {
  ASSERT_EQ(make_block_case(dir_).exit_code, 0);
  for (const std::string kind : {".png", ".dcm"}) {
    for (const std::string name : {"a", "b"}) {
      const Ran ran = xray(file("case") + " --size 64x64 --out " + file(name + kind));
      ASSERT_EQ(ran.exit_code, 0) << ran.output;
    }
    std::ifstream a(file("a" + kind), std::ios::binary), b(file("b" + kind), std::ios::binary);
    std::stringstream bytes_a, bytes_b;
    bytes_a << a.rdbuf();
    bytes_b << b.rdbuf();
    EXPECT_GT(bytes_a.str().size(), 100u);
    EXPECT_EQ(bytes_a.str(), bytes_b.str());
  }
}

TEST_F(XrayCli, BadInputIsRefusedWithWords) {
  ASSERT_EQ(make_block_case(dir_).exit_code, 0);
  const std::string block = file("case");
  for (const std::string& bad :
       {block, block + " --out " + file("a.jpg"), block + " --kv 20 --out " + file("a.png"),
        block + " --c-arm orbit --out " + file("a.png"),
        block + " --c-arm orbit=nan --out " + file("a.png"),
        block + " --c-arm tilt=3 --out " + file("a.png"),
        block + " --c-arm source=2000 --out " + file("a.png"),
        block + " --at 1 --out " + file("a.png"), block + " --size 0x9 --out " + file("a.png"),
        block + " --flexion 30 --out " + file("a.png"), block + " --hu nan --out " + file("a.png"),
        file("none") + " --out " + file("a.png"), file("none.osr") + " --out " + file("a.png"),
        block + " --out " + file("none/a.png")}) {
    const Ran ran = xray(bad);
    EXPECT_EQ(ran.exit_code, 2) << bad << "\n" << ran.output;
    EXPECT_FALSE(ran.output.empty()) << bad;
    EXPECT_FALSE(fs::exists(file("a.png"))) << bad;
  }
}

TEST_F(XrayCli, ARecordingShowsTheProbeAtItsTime) {
  ASSERT_EQ(make_block_case(dir_).exit_code, 0);
  std::ofstream path(file("path.csv"));
  path << "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button\n0,-10,0,30,1,0,0,0,0\n0.4,30,0,30,1,0,0,0,0\n";
  path.close();
  const Ran made = run_osteon("simulate --case " + file("case") + " --path " + file("path.csv") +
                              " --record " + file("r.osr"));
  ASSERT_EQ(made.exit_code, 0) << made.output;
  std::vector<float> last;
  for (const std::string at : {"0.05", "0.35"}) {
    const Ran ran =
        xray(file("r.osr") + " --at " + at + " --view lateral --size 128x128 --raw " + file("raw"));
    ASSERT_EQ(ran.exit_code, 0) << ran.output;
    const Raw raw = read_raw(file("raw"));
    EXPECT_NE(raw.g_per_cm2, last);
    last = raw.g_per_cm2;
  }
  // The hand that holds it is given what scatters from the block, or the beam where it is in it.
  const auto hand_of = [&](const std::string& options) {
    const Ran ran =
        xray(file("r.osr") + " --at 0.35 --size 64x64 --json --raw " + file("raw") + " " + options);
    EXPECT_EQ(ran.exit_code, 0) << ran.output;
    const Json hands = Json::parse(ran.output)["dose"]["hands"];
    EXPECT_EQ(hands.size(), 1u);
    return hands[0];
  };
  const Json aside = hand_of("--view lateral --mas 1"), hit = hand_of("--mas 1");
  EXPECT_GT(aside["at_mm"][2], 60) << "above the tip, on the shaft";
  EXPECT_FALSE(aside["in_beam"]);
  EXPECT_GT(aside["scattered_mgy"], 0);
  EXPECT_EQ(aside["direct_mgy"], 0);
  EXPECT_TRUE(hit["in_beam"]);
  EXPECT_GT(hit["direct_mgy"], 10 * aside["total_mgy"].get<double>());
  EXPECT_NEAR(hand_of("--view lateral --mas 2")["total_mgy"].get<double>(),
              2 * aside["total_mgy"].get<double>(), 1e-9);
  EXPECT_EQ(xray(file("r.osr") + " --at 9 --raw " + file("raw")).exit_code, 2);
}

// The first hand stands still; what the second holds moves through it.
TEST_F(XrayCli, ARecordingShowsTheInstrumentsOfAllHands) {
  ASSERT_EQ(make_block_case(dir_).exit_code, 0);
  const std::string columns = "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button\n";
  std::ofstream(file("left.csv")) << columns << "0,-10,0,30,1,0,0,0,0\n0.4,-10,0,30,1,0,0,0,0\n";
  std::ofstream(file("right.csv")) << columns << "0,10,0,30,1,0,0,0,0\n0.4,30,0,30,1,0,0,0,0\n";
  const Ran made =
      run_osteon("simulate --case " + file("case") + " --hand left=" + file("left.csv") +
                 " --hand right=" + file("right.csv") + " --record " + file("r.osr"));
  ASSERT_EQ(made.exit_code, 0) << made.output;
  std::vector<float> last;
  for (const std::string at : {"0.05", "0.35"}) {
    const Ran ran =
        xray(file("r.osr") + " --at " + at + " --view lateral --size 128x128 --raw " + file("raw"));
    ASSERT_EQ(ran.exit_code, 0) << ran.output;
    const Raw raw = read_raw(file("raw"));
    EXPECT_NE(raw.g_per_cm2, last);
    last = raw.g_per_cm2;
  }
}

/// Pearson's r over pixels that both see something in.
double correlation(const std::vector<float>& a, const std::vector<float>& b) {
  double n = 0, sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double x = static_cast<double>(a[k]), y = static_cast<double>(b[k]);
    if (x <= 0) continue;
    n += 1;
    sa += x;
    sb += y;
    saa += x * x;
    sbb += y * y;
    sab += x * y;
  }
  return (n * sab - sa * sb) / std::sqrt((n * saa - sa * sa) * (n * sbb - sb * sb));
}

/// A PFM file's floats, its first row the top one.
std::vector<float> read_pfm(const std::string& name, int width, int height) {
  std::ifstream in(name, std::ios::binary);
  std::string kind, scale;
  int w = 0, h = 0;
  in >> kind >> w >> h >> scale;
  in.get();
  std::vector<float> out(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  if (w != width || h != height) return {};
  in.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(4 * out.size()));
  return out;
}

/// World to the scanner's Patient: x_P = y_W, y_P = z_W, z_P = x_W.
std::string in_patient(const Vec3& v) {
  std::ostringstream text;
  text << '"' << v.y() << ' ' << v.z() << ' ' << v.x() << '"';
  return text.str();
}

TEST_F(XrayCli, AgreesWithPlastimatchOfTheVirtualScan) {
  if (std::system("plastimatch --version > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "plastimatch is not installed";
  ASSERT_EQ(run_osteon("scan builtin:wrist --spacing 0.8 --slice 0.8 --noise 0 --psf 0 --out " +
                       file("scan"))
                .exit_code,
            0);
  const Ran ran =
      xray("builtin:wrist --c-arm orbit=20,angulation=10 --size 256x256 --raw " + file("raw"));
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const Raw raw = read_raw(file("raw"));
  const Vec3 source = vec(raw.at["source_mm"]), middle = vec(raw.at["detector_center_mm"]);
  const Vec3 to_source = (source - middle).normalized();
  const Vec3 isocenter = source - 600 * to_source;
  std::ostringstream command;
  const double side = 256 * raw.at["pixel_mm"].get<double>();
  command << "plastimatch drr -P inline -t pfm -i exact --sad 600 --sid 1000 -r \"256 256\" -z \""
          << side << ' ' << side << "\" -o " << in_patient(isocenter) << " -n "
          << in_patient(to_source) << " --vup " << in_patient(-vec(raw.at["v_axis"])) << " -O "
          << file("drr") << " -I " << file("scan") << " > " << file("log") << " 2>&1";
  ASSERT_EQ(std::system(command.str().c_str()), 0) << command.str();
  const std::vector<float> peer = read_pfm(file("drr0000.pfm"), 256, 256);
  ASSERT_FALSE(peer.empty());
  EXPECT_GT(correlation(raw.g_per_cm2, peer), 0.99);
}

// What a burr has removed is missing in the picture: of one density, summed over the picture at the
// block's top and thinned by the beam's spread, by just its volume.
TEST_F(XrayCli, CarvedBoneIsMissing) {
  ASSERT_EQ(make_block_case(dir_, 5).exit_code, 0);
  std::ofstream(file("burr.csv"))
      << "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button,instrument,size,power,jaw\n"
         "0,0,0,8,1,0,0,0,0,microdrill,4,1,0\n0.1,0,0,6,1,0,0,0,0,microdrill,4,1,0\n"
         "0.7,0,0,4,1,0,0,0,0,microdrill,4,1,0\n";
  const Ran ran =
      run_osteon("simulate --case '" + file("case") + "#block=field' --path " + file("burr.csv") +
                 " --record " + file("r.osr") + " --report " + file("report.json"));
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  Json report;
  std::ifstream(file("report.json")) >> report;
  const double removed_mm3 = report["carving"]["removed_mm3"];
  ASSERT_GT(removed_mm3, 3);
  const auto picture = [&](const std::string& at) {
    const Ran shot = xray(file("r.osr") + at + " --c-arm field=30,distance=1000,source=900 " +
                          "--size 128x128 --hu 700 --raw " + file("raw"));
    EXPECT_EQ(shot.exit_code, 0) << shot.output;
    return read_raw(file("raw"));
  };
  const Raw whole = picture(" --at 0.05"), carved = picture("");
  ASSERT_EQ(whole.g_per_cm2.size(), carved.g_per_cm2.size());
  double missing_g_per_cm2 = 0;
  for (std::size_t n = 0; n < whole.g_per_cm2.size(); ++n) {
    EXPECT_LE(carved.g_per_cm2[n], whole.g_per_cm2[n] + 1e-3F) << n;
    missing_g_per_cm2 += static_cast<double>(whole.g_per_cm2[n] - carved.g_per_cm2[n]);
  }
  // The hole lies within 1 mm of the top's middle; a pixel there is smaller as it is nearer.
  const Vec3 source = vec(whole.at["source_mm"]);
  const double to_hole = (Vec3(0, 0, 4.5) - source).norm();
  const double to_detector = (vec(whole.at["detector_center_mm"]) - source).norm();
  const double pixel_cm = 0.1 * whole.at["pixel_mm"].get<double>() * to_hole / to_detector;
  const double density = 0.0005886 * 700 + 1.03;
  const double missing_mm3 = 1000 * missing_g_per_cm2 * pixel_cm * pixel_cm / density;
  EXPECT_NEAR(missing_mm3, removed_mm3, 0.03 * removed_mm3);
}

}  // namespace
}  // namespace osteon::testing_cli
