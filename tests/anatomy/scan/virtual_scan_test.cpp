// Scans of balls and boxes are known by geometry alone.
#include "osteon/anatomy/virtual_scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "osteon/mesh/isosurface.h"

namespace osteon {
namespace {

constexpr double kRadius_m = 0.006;

const TriMesh& ball() {
  static const TriMesh mesh = *isosurface([](const Vec3& p) { return p.norm() - kRadius_m; },
                                          {Vec3::Constant(-0.008), Vec3::Constant(0.008)}, {});
  return mesh;
}

ScanOptions quiet() {
  ScanOptions options;
  options.noise_hu = 0;
  options.psf_m = 0;
  options.flesh_m = 0.003;
  return options;
}

Result<Volume> scan(const ScanOptions& options, const Pose& X_WB = {}) {
  const ScannedBone bone{&ball(), X_WB};
  return virtual_scan({std::span(&bone, 1)}, *load_default_tissues(), options);
}

TEST(VirtualScan, TissuesLieWhereTheirDistanceSaysInPatient) {
  Pose X_WB;
  X_WB.p = Vec3(0.01, 0.02, 0.03);
  const auto volume = scan(quiet(), X_WB);
  ASSERT_TRUE(volume) << volume.error().message();
  // World x is Patient z, World y is Patient x, World z is Patient y.
  const Vec3 center_P(0.02, 0.03, 0.01);
  const auto at = [&](double r) {
    return sample_linear(*volume, volume->frame.voxel(center_P + Vec3(0, 0, r)));
  };
  EXPECT_NEAR(at(0), 350, 1);
  EXPECT_NEAR(at(kRadius_m - 0.0006), 1500, 60);
  EXPECT_NEAR(at(kRadius_m + 0.0010), 55, 20);
  EXPECT_NEAR(at(kRadius_m + 0.0050), -1000, 1);
}

// The mean over voxels is that over space, however coarse the voxels are.
TEST(VirtualScan, PartialVolumeKeepsTheAmountOfEachTissue) {
  for (const double slice_m : {0.0005, 0.002}) {
    ScanOptions options = quiet();
    options.slice_m = slice_m;
    const auto volume = scan(options);
    ASSERT_TRUE(volume);
    double excess = 0;
    for (const auto hu : volume->values)
      if (hu > 55) excess += (hu - 55) * volume->frame.voxel_volume_m3();
    const auto ball_of = [](double r) { return 4.0 / 3 * M_PI * r * r * r; };
    const double core = ball_of(kRadius_m - options.cortical_m);
    const double expected = core * (350 - 55) + (ball_of(kRadius_m) - core) * (1500 - 55);
    EXPECT_NEAR(excess / expected, 1, 0.02) << slice_m;
  }
}

TEST(VirtualScan, NoiseHasItsDeviationAndItsSeed) {
  ScanOptions options = quiet();
  const auto clean = scan(options);
  options.noise_hu = 30;
  const auto noisy = scan(options), again = scan(options);
  options.seed = 2;
  const auto other = scan(options);
  ASSERT_TRUE(clean && noisy && again && other);
  EXPECT_EQ(noisy->values, again->values);
  EXPECT_NE(noisy->values, other->values);
  double square = 0;
  std::size_t count = 0;
  for (std::size_t n = 0; n < clean->values.size(); ++n) {
    if (clean->values[n] < -900) continue;  // cut at -1024
    square += std::pow(noisy->values[n] - clean->values[n], 2);
    ++count;
  }
  EXPECT_NEAR(std::sqrt(square / static_cast<double>(count)), 30, 1);
}

TriMesh ball_of(double radius_m) {
  const Vec3 corner = Vec3::Constant(radius_m + 0.001);
  return *isosurface([=](const Vec3& p) { return p.norm() - radius_m; }, {-corner, corner}, {});
}

TriMesh box_of(const Vec3& lo, const Vec3& hi) {
  TriMesh box;
  for (int n = 0; n < 8; ++n)
    box.vertices.emplace_back(n & 1 ? hi.x() : lo.x(), n & 2 ? hi.y() : lo.y(),
                              n & 4 ? hi.z() : lo.z());
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return box;
}

/// Bone and soft parts that stay while they are scanned.
struct Body {
  std::vector<TriMesh> bones;
  std::vector<std::pair<std::string, TriMesh>> softs;  ///< by kind

  Result<Volume> scan(const ScanOptions& options) const {
    static const std::map<std::string, std::string> tissue = {{"cartilage", "articular_cartilage"},
                                                              {"disc", "meniscus"}};
    std::vector<ScannedBone> scanned_bones;
    for (const TriMesh& mesh : bones) scanned_bones.push_back({&mesh, {}});
    std::vector<ScannedSoft> scanned_softs;
    for (const auto& [kind, mesh] : softs)
      scanned_softs.push_back({kind, kind, tissue.count(kind) ? tissue.at(kind) : kind, &mesh});
    return virtual_scan({scanned_bones, scanned_softs}, *load_default_tissues(), options);
  }
};

/// Value of the voxel that holds a point of World.
double at_W(const Volume& volume, const Vec3& p_W) {
  const Vec3 voxel = volume.frame.voxel(scanner_pose_PW() * p_W);
  return volume.at(static_cast<int>(std::lround(voxel.x())),
                   static_cast<int>(std::lround(voxel.y())),
                   static_cast<int>(std::lround(voxel.z())));
}

TEST(VirtualScan, WhatLiesInTheSkinIsSeenByItsTissueAndItsDepth) {
  const Body body{{ball()}, {{"skin", ball_of(0.014)}}};
  const auto volume = body.scan(quiet());
  ASSERT_TRUE(volume) << volume.error().message();
  const auto at = [&](double r) { return at_W(*volume, Vec3(0.6, 0.64, 0.48) * r); };
  EXPECT_NEAR(at(0), 350, 1);
  EXPECT_NEAR(at(kRadius_m - 0.0006), 1500, 60);
  EXPECT_NEAR(at(0.0085), 55, 1);
  EXPECT_NEAR(at(0.0115), -100, 3);
  EXPECT_NEAR(at(0.0133), 40, 60);
  EXPECT_NEAR(at(0.0150), -1000, 1);
}

TEST(VirtualScan, PartialVolumeInTheSkinKeepsTheAmountOfEachTissue) {
  const Body body{{ball()}, {{"skin", ball_of(0.014)}}};
  for (const double slice_m : {0.0005, 0.002}) {
    ScanOptions options = quiet();
    options.spacing_m = 0.001;
    options.slice_m = slice_m;
    const auto volume = body.scan(options);
    ASSERT_TRUE(volume);
    double sum = 0;
    for (const auto hu : volume->values) sum += (hu + 1000) * volume->frame.voxel_volume_m3();
    const auto within = [](double r) { return 4.0 / 3 * M_PI * r * r * r; };
    const double radii[] = {0.014, 0.0125, 0.0105, kRadius_m, kRadius_m - options.cortical_m, 0};
    const double hus[] = {40, -100, 55, 1500, 350};
    double expected = 0;
    for (int n = 0; n < 5; ++n)
      expected += (within(radii[n]) - within(radii[n + 1])) * (hus[n] + 1000);
    EXPECT_NEAR(sum / expected, 1, 0.005) << slice_m;
  }
}

// Each part alone somewhere, and overlaps of two.
TEST(VirtualScan, WhereSoftPartsOverlapTheOneThatComesFirstIsSeen) {
  const auto cube = [](double x, double y) {
    return box_of(Vec3(x, y, -0.003), Vec3(x + 0.008, y + 0.008, 0.003));
  };
  const Body body{{cube(0, 0)},
                  {{"skin", box_of(Vec3(-0.02, -0.02, -0.012), Vec3(0.04, 0.02, 0.012))},
                   {"fat", cube(0.020, 0)},
                   {"tendon", cube(0.015, 0.004)},
                   {"ligament", cube(0.010, 0)},
                   {"cartilage", cube(0.005, 0.004)}}};
  const auto volume = body.scan(quiet());
  ASSERT_TRUE(volume) << volume.error().message();
  EXPECT_NEAR(at_W(*volume, Vec3(0.004, 0.002, 0)), 350, 1);
  EXPECT_NEAR(at_W(*volume, Vec3(0.0065, 0.0074, 0)), 1500, 1) << "bone over cartilage";
  EXPECT_NEAR(at_W(*volume, Vec3(0.0065, 0.0100, 0)), 90, 1) << "cartilage alone";
  EXPECT_NEAR(at_W(*volume, Vec3(0.0115, 0.0060, 0)), 90, 1) << "cartilage over ligament";
  EXPECT_NEAR(at_W(*volume, Vec3(0.0140, 0.0020, 0)), 100, 1) << "ligament alone";
  EXPECT_NEAR(at_W(*volume, Vec3(0.0215, 0.0060, 0)), 100, 1) << "tendon over fat";
  EXPECT_NEAR(at_W(*volume, Vec3(0.0250, 0.0030, 0)), -100, 1) << "fat alone";
  EXPECT_NEAR(at_W(*volume, Vec3(0.0350, 0.0030, 0)), 55, 1) << "muscle";
}

// Planes across the voxels: the mean is linear in where they lie.
TEST(VirtualScan, VoxelsAtABorderHoldTheMeanByVolume) {
  ScanOptions options = quiet();
  for (const double shift_m : {0.0, 0.0001, 0.0002, 0.0003}) {
    // Bone's end is the ligament's beginning: no muscle may show between them.
    const double border = 0.004 + shift_m, skin = 0.014 + shift_m;
    const Body body{{box_of(Vec3(-0.004, -0.006, -0.006), Vec3(border, 0.006, 0.006))},
                    {{"ligament", box_of(Vec3(border, -0.006, -0.006), Vec3(0.008, 0.006, 0.006))},
                     {"skin", box_of(Vec3(-0.014, -0.014, -0.014), Vec3(skin, 0.014, 0.014))}}};
    const auto volume = body.scan(options);
    ASSERT_TRUE(volume) << volume.error().message();
    const auto mean_at = [&](double x, double below_hu, double above_hu) {
      const Vec3 voxel = volume->frame.voxel(scanner_pose_PW() * Vec3(x, 0, 0));
      const int k = static_cast<int>(std::lround(voxel.z()));
      const double below = std::clamp(voxel.z() - k + 0.5, 0.0, 1.0);
      EXPECT_NEAR(volume->at(static_cast<int>(voxel.x()), static_cast<int>(voxel.y()), k),
                  below * below_hu + (1 - below) * above_hu, 6)
          << "at " << x << ", shift " << shift_m;
    };
    mean_at(border, 1500, 100);
    mean_at(skin, 40, -1000);
  }
}

TEST(VirtualScan, BoneThatReachesOutOfTheSkinHasMuscleAroundIt) {
  const Body body{{box_of(Vec3(-0.003, -0.003, -0.003), Vec3(0.030, 0.003, 0.003))},
                  {{"skin", box_of(Vec3(-0.010, -0.010, -0.010), Vec3(0.015, 0.010, 0.010))}}};
  const auto volume = body.scan(quiet());  // 3 mm of muscle
  ASSERT_TRUE(volume) << volume.error().message();
  EXPECT_NEAR(at_W(*volume, Vec3(0.025, 0.005, 0)), 55, 1);
  EXPECT_NEAR(at_W(*volume, Vec3(0.025, 0.0075, 0)), -1000, 1);
  EXPECT_NEAR(at_W(*volume, Vec3(0.000, 0.0115, 0)), -1000, 1) << "over the skin";
}

TEST(VirtualScan, RefusesSoftPartsThatItCannotTellApart) {
  Body body{{ball()}, {{"skin", ball_of(0.012)}}};
  body.softs[0].second.triangles.pop_back();
  auto scanned = body.scan(quiet());
  ASSERT_FALSE(scanned);
  EXPECT_NE(scanned.error().message().find("not closed"), std::string::npos);
  body.softs = {{"feather", ball_of(0.012)}};
  scanned = body.scan(quiet());
  ASSERT_FALSE(scanned);
  EXPECT_NE(scanned.error().message().find("feather"), std::string::npos);
  const TriMesh mesh = ball_of(0.012);
  const ScannedBone bone{&ball(), {}};
  const ScannedSoft soft{"acl", "ligament", "silk", &mesh};
  scanned = virtual_scan({std::span(&bone, 1), std::span(&soft, 1)}, *load_default_tissues(), {});
  ASSERT_FALSE(scanned);
  EXPECT_NE(scanned.error().message().find("silk"), std::string::npos);
}

TEST(VirtualScan, RefusesWhatItCannotDo) {
  const auto tissues = *load_default_tissues();
  EXPECT_FALSE(virtual_scan({}, tissues));
  ScanOptions options;
  options.spacing_m = 0;
  EXPECT_FALSE(scan(options));
  options.spacing_m = std::nan("");
  EXPECT_FALSE(scan(options));
  const ScannedBone bone{&ball(), {}};
  EXPECT_FALSE(virtual_scan({std::span(&bone, 1)}, TissueTable{}, {}));
  options = quiet();
  options.skin_m = std::nan("");
  EXPECT_FALSE(scan(options));
  options = quiet();
  options.progress = [](const char*, double share) { return share < 0.5; };
  EXPECT_FALSE(scan(options));
}

}  // namespace
}  // namespace osteon
