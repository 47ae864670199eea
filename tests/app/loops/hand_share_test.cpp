#include "loops/hand_share.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/loops/fake_device.h"

namespace osteon {
namespace {

using test::DeviceLog;
using test::FakeDevice;

// A hand that goes along x at 10 mm/s.
DeviceSample walking(std::uint64_t tick) {
  DeviceSample sample;
  sample.time_ns = static_cast<std::int64_t>(tick) * 1'000'000;
  sample.X_VD.p.x() = 1e-5 * static_cast<double>(tick);
  sample.v_V.x() = 0.01;
  return sample;
}

struct TwoHands {
  DeviceLog log;
  std::shared_ptr<HandShare> share =
      std::make_shared<HandShare>(std::make_unique<FakeDevice>(walking, log), 0);
  Pose rest{Vec3(0.05, 0.02, 0), Quat(Eigen::AngleAxisd(0.5, Vec3::UnitY()))};
  SharedHand first{share, 0, Pose{}}, second{share, 1, rest};
};

TEST(HandShare, TheHandThatHasTheDeviceSeesItAsItIs) {
  TwoHands two;
  for (std::uint64_t tick = 0; tick < 5; ++tick)
    EXPECT_EQ(two.first.read().X_VD.p, walking(tick).X_VD.p);
  two.first.write_force(Vec3(1, 2, 3));
  ASSERT_EQ(two.log.forces_V.size(), 1u);
  EXPECT_EQ(two.log.forces_V[0], Vec3(1, 2, 3));
}

TEST(HandShare, TheOtherRestsAndItsForceReachesNobody) {
  TwoHands two;
  for (int i = 0; i < 10; ++i) {
    const DeviceSample sample = two.second.read();
    EXPECT_EQ(sample.X_VD.p, two.rest.p);
    EXPECT_EQ(sample.v_V, Vec3(Vec3::Zero()));
    two.second.write_force(Vec3(5, 0, 0));
  }
  EXPECT_TRUE(two.log.forces_V.empty());
}

TEST(HandShare, TheDeviceIsTakenOnlyAfterItWasLetGoAtZeroForce) {
  TwoHands two;
  two.first.read();
  two.share->give(1);
  EXPECT_EQ(two.second.read().X_VD.p, two.rest.p) << "the first has not let go yet";
  const Vec3 left_at = two.first.read().X_VD.p;
  ASSERT_FALSE(two.log.forces_V.empty());
  EXPECT_EQ(two.log.forces_V.back(), Vec3(Vec3::Zero()));
  const DeviceSample taken = two.second.read();
  EXPECT_LT((taken.X_VD.p - two.rest.p).norm(), 1e-15) << "it goes on where it rested";
  EXPECT_LT(taken.X_VD.q.angularDistance(two.rest.q), 1e-12);
  EXPECT_NEAR(two.second.read().X_VD.p.x() - taken.X_VD.p.x(), 1e-5, 1e-15);
  EXPECT_EQ(two.first.read().X_VD.p, left_at) << "the first rests where it was left";
}

// The gate takes readings that grow no younger for a device that is lost, whichever clock the
// device has: here it starts far ahead of the hands'.
TEST(HandShare, EveryHandsReadingsGrowYoungerWhoeverHasTheDevice) {
  DeviceLog log;
  const auto late = [](std::uint64_t tick) {
    DeviceSample sample = walking(tick);
    sample.time_ns += 222'000'000'000;
    return sample;
  };
  const auto share = std::make_shared<HandShare>(std::make_unique<FakeDevice>(late, log), 0);
  SharedHand first{share, 0, Pose{}}, second{share, 1, Pose{}};
  std::int64_t first_ns = first.read().time_ns, second_ns = second.read().time_ns;
  for (int turn = 1; turn <= 4; ++turn) {
    share->give(static_cast<std::size_t>(turn % 2));
    for (int tick = 0; tick < 50; ++tick) {
      const std::int64_t now_first = first.read().time_ns, now_second = second.read().time_ns;
      ASSERT_GT(now_first, first_ns) << "turn " << turn << ", tick " << tick;
      ASSERT_GT(now_second, second_ns) << "turn " << turn << ", tick " << tick;
      first_ns = now_first;
      second_ns = now_second;
    }
  }
}

// Whoever leads an emulated user brings the hand to where he wants it, whatever lies between the
// device and the hand.
TEST(HandShare, WhoLeadsTheDeviceKnowsWhereItHasTheHand) {
  TwoHands two;
  EXPECT_TRUE(two.share->is_led(0));
  EXPECT_EQ(two.share->to_device(0, two.rest).p, two.rest.p);
  two.first.read();
  two.share->give(1);
  two.first.read();
  EXPECT_FALSE(two.share->is_led(0));
  EXPECT_FALSE(two.share->is_led(1)) << "nobody has told yet where the device is";
  const DeviceSample hand = two.second.read();
  ASSERT_TRUE(two.share->is_led(1));
  const Pose device = two.share->to_device(1, hand.X_VD);
  EXPECT_LT((device.p - walking(1).X_VD.p).norm(), 1e-15);
  EXPECT_LT(device.q.angularDistance(walking(1).X_VD.q), 1e-12);
}

TEST(HandShare, TheForceRisesOverHalfASecondAfterAnExchange) {
  TwoHands two;
  two.first.read();
  two.share->give(1);
  two.first.read();
  const auto felt = [&] {
    two.second.read();
    two.second.write_force(Vec3(2, 0, 0));
    return two.log.forces_V.back().x();
  };
  double last = felt();
  EXPECT_LT(last, 0.01);
  for (int tick = 0; tick < 498; ++tick) {
    const double now = felt();
    EXPECT_LE(now - last, 2.0 / 500 + 1e-12);
    last = now;
  }
  felt();
  EXPECT_DOUBLE_EQ(felt(), 2);
}

TEST(HandShare, ARestingHandIsNudgedWithoutALeapAndRefusesWhatIsNotFinite) {
  TwoHands two;
  two.second.read();
  Pose wanted = two.rest;
  wanted.p.z() += 0.002;
  two.share->set_rest(1, wanted);
  Vec3 last = two.rest.p;
  for (int tick = 0; tick < 400; ++tick) {
    const DeviceSample sample = two.second.read();
    EXPECT_LT((sample.X_VD.p - last).norm(), 1e-4);
    last = sample.X_VD.p;
  }
  EXPECT_LT((last - wanted.p).norm(), 1e-6);
  wanted.p.x() = std::nan("");
  two.share->set_rest(1, wanted);
  EXPECT_LT((two.second.read().X_VD.p - last).norm(), 1e-6);
}

TEST(HandShare, OnlyTheHandThatHasTheDeviceClosesIt) {
  TwoHands two;
  two.second.close();
  EXPECT_FALSE(two.log.closed);
  two.first.close();
  EXPECT_TRUE(two.log.closed);
}

}  // namespace
}  // namespace osteon
