#include "osteon/anatomy/generate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "anatomy/surface_probe.h"
#include "mesh/surface_checks.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

constexpr double kPi = 3.14159265358979323846;

class Generate : public testing::Test {
 protected:
  Result<GeneratedAnatomy> grow(const std::string& bones, const GenerateOptions& options = {}) {
    const auto written = write_file_atomic(path_, "name = \"t\"\nside = \"right\"\n" + bones);
    EXPECT_TRUE(written);
    return generate_anatomy(path_, options);
  }
  static std::string bone(const std::string& name, const std::string& place,
                          const std::string& rest) {
    return "[[bone]]\nname = \"" + name + "\"\nfma_id = 1\nposition_mm = " + place + "\n" + rest +
           "\n";
  }
  void TearDown() override { std::filesystem::remove(path_); }

  std::filesystem::path path_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("generate_") + testing::UnitTest::GetInstance()->current_test_info()->name() +
       ".toml");
};

TEST_F(Generate, AMissingFileIsAnErrorThatNamesIt) {
  const auto r = generate_anatomy("/nowhere/hand.toml");
  ASSERT_FALSE(r);
  EXPECT_NE(r.error().message().find("/nowhere/hand.toml"), std::string::npos);
}

TEST_F(Generate, UnusableCellsAreRefused) {
  const std::string ball = bone("ball", "[0, 0, 0]",
                                "add = [{ shape = \"ellipsoid\", center_mm = [0, 0, 0], "
                                "radii_mm = [10, 10, 10] }]");
  for (const double cell : {0.0, -0.001, std::numeric_limits<double>::quiet_NaN(), 1e-7}) {
    GenerateOptions options;
    options.cell_m = cell;
    EXPECT_FALSE(grow(ball, options)) << cell;
  }
}

TEST_F(Generate, ABoneThatIsCutAwayWhollyIsAnErrorThatNamesIt) {
  const auto r = grow(bone("ghost", "[0, 0, 0]",
                           "add = [{ shape = \"ellipsoid\", center_mm = [0, 0, 0], radii_mm = [5, "
                           "5, 5] }]\ncut = [{ shape = \"half_space\", point_mm = [9, 0, 0], "
                           "normal = [1, 0, 0] }]"));
  ASSERT_FALSE(r);
  EXPECT_NE(r.error().message().find("ghost"), std::string::npos);
}

TEST_F(Generate, TellsHowFarItIsAndStopsWhenTold) {
  const std::string shape =
      "add = [{ shape = \"ellipsoid\", center_mm = [0, 0, 0], radii_mm = [5, 5, 5] }]";
  const std::string pair = bone("a", "[0, 0, 0]", shape) + bone("b", "[50, 0, 0]", shape);
  std::vector<double> told;
  GenerateOptions options;
  options.progress = [&](double share) { told.push_back(share); };
  ASSERT_TRUE(grow(pair, options));
  EXPECT_EQ(told, (std::vector<double>{0, 0.5, 1}));

  struct Stop {};
  int bones = 0;
  options.progress = [&](double) {
    if (bones++ == 1) throw Stop{};
  };
  EXPECT_THROW((void)grow(pair, options), Stop);
  EXPECT_EQ(bones, 2);
}

TEST_F(Generate, EllipsoidHasItsVolumeAndExtents) {
  const auto r = grow(bone("egg", "[100, 0, 0]",
                           "add = [{ shape = \"ellipsoid\", center_mm = [1, 2, 3], radii_mm = [12, "
                           "8, 5] }]"));
  ASSERT_TRUE(r) << r.error().message();
  const TriMesh& mesh = r->bones[0].mesh;
  EXPECT_TRUE(checks::is_closed_manifold(mesh));
  EXPECT_NEAR(checks::signed_volume(mesh) / (4 * kPi / 3 * 480e-9), 1, 0.01);
  Aabb box;
  for (const Vec3& v : mesh.vertices) box.include(v);
  EXPECT_LT((box.extent() - Vec3(0.024, 0.016, 0.010)).cwiseAbs().maxCoeff(), 0.0001);
  EXPECT_LT((box.center() - Vec3(0.001, 0.002, 0.003)).norm(), 0.0001);
  EXPECT_EQ(r->bones[0].X_WB.p, Vec3(0.1, 0, 0));
}

TEST_F(Generate, CapsuleHasItsVolume) {
  const auto r = grow(bone("rod", "[0, 0, 0]",
                           "add = [{ shape = \"tube\", points_mm = [[0, 0, 0], [30, 0, 0]], "
                           "radii_mm = [5, 5] }]"));
  ASSERT_TRUE(r) << r.error().message();
  EXPECT_NEAR(checks::signed_volume(r->bones[0].mesh) / (kPi * 25e-6 * 0.03 + 4 * kPi / 3 * 125e-9),
              1, 0.01);
}

TEST_F(Generate, RotationTurnsTheBone) {
  const auto r = grow(bone("rod", "[0, 0, 0]",
                           "rotation_deg = [0, 0, 90]\nadd = [{ shape = \"tube\", points_mm = [[0, "
                           "0, 0], [30, 0, 0]], radii_mm = [5, 5] }]"));
  ASSERT_TRUE(r) << r.error().message();
  const Vec3 end = r->bones[0].X_WB * Vec3(0.03, 0, 0);
  EXPECT_LT((end - Vec3(0, 0.03, 0)).norm(), 1e-12);
}

/// The hollow follows the head at the gap that was asked for, also between turned bones.
TEST_F(Generate, ClearanceLeavesItsGapBetweenTurnedBones) {
  const std::string socket =
      bone("socket", "[0, 0, 0]",
           "rotation_deg = [0, 0, 30]\nadd = [{ shape = \"box\", center_mm = [0, 0, 0], half_mm = "
           "[10, 10, 10], round_mm = 2 }]\nclear = [{ bone = \"head\", gap_mm = 1.5 }]");
  const std::string head =
      bone("head", "[14, 2, 1]",
           "rotation_deg = [20, 40, 60]\nadd = [{ shape = \"ellipsoid\", center_mm = [0, 0, 0], "
           "radii_mm = [8, 7, 6] }]");
  const auto r = grow(socket + head);
  ASSERT_TRUE(r) << r.error().message();
  const checks::SurfaceProbe probe(r->bones[1].mesh, r->bones[1].X_WB);
  double gap = 1;
  for (const Vec3& v : r->bones[0].mesh.vertices)
    gap = std::min(gap, probe.distance(r->bones[0].X_WB * v, 0.003));
  EXPECT_NEAR(gap, 0.0015, 0.00015);
  EXPECT_LT(checks::signed_volume(r->bones[0].mesh), 7900e-9) << "the socket is hollowed";
}

TEST_F(Generate, NoShapeOfABoneDependsOnTheOrderOfBones) {
  const auto text = [](const std::string& name, const std::string& x, const std::string& other) {
    return bone(name, "[" + x + ", 0, 0]",
                "add = [{ shape = \"ellipsoid\", center_mm = [0, 0, 0], radii_mm = [8, 7, 6] }]\n"
                "clear = [{ bone = \"" +
                    other + "\", gap_mm = 1 }]");
  };
  const auto ab = grow(text("a", "0", "b") + text("b", "14", "a"));
  const auto ba = grow(text("b", "14", "a") + text("a", "0", "b"));
  ASSERT_TRUE(ab && ba);
  EXPECT_EQ(checks::hash_of(ab->bones[0].mesh), checks::hash_of(ba->bones[1].mesh));
  EXPECT_EQ(checks::hash_of(ab->bones[1].mesh), checks::hash_of(ba->bones[0].mesh));
}

}  // namespace
}  // namespace osteon
