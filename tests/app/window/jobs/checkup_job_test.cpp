#include "window/jobs/window_jobs.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <future>

#include "osteon/device/virtual_device.h"

namespace osteon {
namespace {

using CheckupJob = SideJob<CheckupOutcome>;
using DeviceList = Result<std::vector<DeviceInfo>>;
using OpenDevice = Result<std::unique_ptr<HapticDevice>>;

DeviceInfo seen_motor() {
  DeviceInfo info;
  info.name = "Arm";
  info.driver = "arm";
  info.peak_force_n = 3.3;
  info.continuous_force_n = 0.9;
  return info;
}

DeviceList usb_missing() { return fail("there is no USB on this computer", "usb", "Use another"); }
OpenDevice open_refused(const DeviceInfo&) {
  return fail("no permission", "arm", "Install the rule");
}
const std::array<Driver, 1> kTable{{{"usb", "USB", usb_missing, open_refused, nullptr}}};

// What a device saw; outlives it.
struct Seen {
  std::atomic<int> reads{0};
  std::atomic<bool> pushed{false};
  std::promise<void> first_push;
  std::atomic<bool> closed{false};
  std::atomic<bool> last_was_zero{true};

  void push() {
    if (!pushed.exchange(true)) first_push.set_value();
  }
};

class Watched : public VirtualDevice {
 public:
  explicit Watched(Seen& seen) : VirtualDevice(seen_motor()), seen_(seen) {}
  DeviceSample read() override {
    ++seen_.reads;
    return VirtualDevice::read();
  }
  void write_force(const Vec3& force_V) override {
    const bool zero = force_V.isZero(0);
    if (!zero) seen_.push();
    seen_.last_was_zero = zero;
    VirtualDevice::write_force(force_V);
  }
  void close() override {
    seen_.closed = true;
    VirtualDevice::close();
  }

 private:
  Seen& seen_;
};

CheckupOrder short_order() {
  CheckupOrder order;
  order.graphics = {FindingLevel::kGood, "OpenGL", "4.6", ""};
  order.read_s = 0.05;
  order.loop_s = 0.05;
  return order;
}

const Finding* found_on(const Findings& findings, const std::string& topic) {
  for (const Finding& f : findings)
    if (f.topic == topic) return &f;
  return nullptr;
}

TEST(CheckupJob, WithoutAnyDeviceItChecksTheComputerAndSaysWhatIsMissing) {
  CheckupJob job(check_up(short_order(), kTable));
  job.wait();
  const auto outcome = job.take();
  ASSERT_TRUE(outcome);
  const CheckupReport& report = outcome->report;
  EXPECT_EQ(outcome->order->device, nullptr);
  EXPECT_FALSE(report.ended_early);
  for (const char* topic : {"usb", "USB", "Loop", "Limits", "OpenGL"})
    EXPECT_NE(found_on(report.findings, topic), nullptr) << topic;
  EXPECT_NE(report.verdict.find("Ready for mouse"), std::string::npos) << report.verdict;
  EXPECT_NE(report.udev.text.find("uaccess"), std::string::npos);
}

TEST(CheckupJob, ALentDeviceIsReadNotPushedAndComesBackOpenAtZero) {
  Seen seen;
  CheckupOrder order = short_order();
  order.device = std::make_unique<Watched>(seen);
  CheckupJob job(check_up(std::move(order), kTable));
  job.wait();
  const auto outcome = job.take();
  ASSERT_TRUE(outcome);
  EXPECT_NE(found_on(outcome->report.findings, "Readings"), nullptr);
  EXPECT_GT(seen.reads, 10);
  EXPECT_FALSE(seen.pushed);
  EXPECT_FALSE(seen.closed);
  EXPECT_NE(outcome->order->device, nullptr);
}

TEST(CheckupJob, CancelledWhileItPushesTheForceEndsAtZero) {
  Seen seen;
  CheckupOrder order = short_order();
  order.push = true;
  order.device = std::make_unique<Watched>(seen);
  CheckupJob job(check_up(std::move(order), kTable));
  const auto pushes = seen.first_push.get_future().wait_for(std::chrono::minutes(1));
  ASSERT_EQ(pushes, std::future_status::ready);
  const int before = seen.reads;
  job.cancel();
  job.wait();
  EXPECT_LT(seen.reads - before, 50) << "went on pushing";
  EXPECT_TRUE(seen.last_was_zero);
  const auto outcome = job.take();
  ASSERT_TRUE(outcome);
  const CheckupReport& report = outcome->report;
  EXPECT_TRUE(report.ended_early);
  EXPECT_NE(report.verdict.find("stopped"), std::string::npos);
}

TEST(CheckupJob, GoingAwayItClosesADeviceThatNobodyTookBack) {
  Seen seen;
  {
    CheckupOrder order = short_order();
    order.read_s = 1000;
    order.device = std::make_unique<Watched>(seen);
    const CheckupJob job(check_up(std::move(order), kTable));
  }
  EXPECT_TRUE(seen.closed);
  EXPECT_TRUE(seen.last_was_zero);
}

}  // namespace
}  // namespace osteon
