#include "loops/path_player.h"

#include <gtest/gtest.h>

#include "osteon/device/drivers.h"
#include "osteon/device/null_device.h"

namespace osteon {
namespace {

ProbePath straight(const Vec3& from, const Vec3& to, double seconds) {
  ProbePath path;
  const Quat q(Eigen::AngleAxisd(1.2, Vec3(1, 2, 2) / 3));
  path.samples.push_back({0, {from, q}, false});
  path.samples.push_back({seconds, {to, q}, true});
  return path;
}

TEST(PathPlayer, RefusesADeviceThatARealHandHolds) {
  const auto player =
      PathPlayer::make(std::make_unique<NullDevice>(), straight(Vec3::Zero(), Vec3(0.01, 0, 0), 1));
  ASSERT_FALSE(player);
  EXPECT_NE(player.error().what.find("real hand"), std::string::npos);
}

class PathPlayerOn : public ::testing::TestWithParam<const char*> {};

// Also a path three times as wide as the workspace: the device's hand goes a share of the way.
TEST_P(PathPlayerOn, TheHandIsWhereThePathIsInWorldAndYieldsToAForceInWorld) {
  for (const double width_m : {0.05, 0.9}) {
    const Vec3 from(1, 2, 3);
    const Vec3 to = from + width_m * Vec3(0.6, -0.8, 0);
    auto device = open_device(GetParam());
    ASSERT_TRUE(device) << device.error().message();
    auto player = PathPlayer::make(std::move(*device), straight(from, to, 4));
    ASSERT_TRUE(player) << player.error().message();
    EXPECT_EQ((*player)->scale() > 1, width_m > 0.5);
    DeviceSample sample;
    for (int i = 0; i < 2001; ++i) sample = (*player)->read();
    const Vec3 middle = 0.5 * (from + to);
    EXPECT_LT((sample.X_VD.p - middle).norm(), 1e-3) << sample.X_VD.p.transpose();
    EXPECT_LT(sample.X_VD.q.angularDistance(straight(from, to, 4).at(0).X_WD.q), 1e-3);
    EXPECT_LT((sample.v_V - (to - from) / 4).norm(), 0.02);
    const Vec3 force(1, 1, -1);
    const double yields_m = 1.0 / 500 * (*player)->scale();
    for (int i = 0; i < 300; ++i) {
      (*player)->write_force(force);
      sample = (*player)->read();
    }
    const Vec3 wanted = from + (to - from) * (2.3 / 4) + yields_m * force;
    EXPECT_LT((sample.X_VD.p - wanted).norm(), 1e-3 * (*player)->scale())
        << sample.X_VD.p.transpose();
    (*player)->close();
    EXPECT_FALSE((*player)->read().connected);
  }
}

INSTANTIATE_TEST_SUITE_P(Devices, PathPlayerOn,
                         ::testing::Values("virtual", "virtual-usb-pid", "virtual-usb-vector"));

}  // namespace
}  // namespace osteon
