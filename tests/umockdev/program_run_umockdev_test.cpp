// The whole program with a Falcon through the real libusb: it is homed by its hand, presses onto a
// block, and the program is ended by a signal. The emulated firmware keeps its motors at what they
// were last told, so that only the program's own zero can have ended the force.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "cli/live_fixture.h"
#include "device/falcon/emulated_falcon.h"
#include "device/falcon/falcon_rig.h"
#include "umockdev/mock_usb.h"

namespace osteon::testing_cli {
namespace {

using testing::EmulatedFalcon;
using testing::MockUsb;

struct TestbedUnref {
  void operator()(UMockdevTestbed* testbed) const { g_object_unref(testbed); }
};

// Its hand does what the program's advice says, and then comes down onto the block and presses, by
// the device's own time: a program that is late on a busy machine sees it no faster.
class LedFalcon : public EmulatedFalcon {
 public:
  LedFalcon() : EmulatedFalcon(testing::pretended_firmware()) {}
  void advance(std::int64_t now_ns) override {
    if (runs() && begun_ns_ < 0) begun_ns_ = now_ns;
    if (begun_ns_ >= 0) want(wanted(static_cast<double>(now_ns - begun_ns_) * 1e-9));
    EmulatedFalcon::advance(now_ns);
  }

 private:
  static Vec3 wanted(double time_s) {
    static const std::vector<std::pair<double, Vec3>> way_mm = {
        {0.0, {0, 0, 0}},  {0.3, {0, 0, -30}}, {0.5, {0, 0, -30}},
        {1.3, {0, 0, 48}}, {1.6, {0, 0, 48}},  {2.0, {0, 20, 30}},
        {2.4, {0, 20, 0}}, {3.4, {0, 20, 0}},  {3.9, {0, -6, 0}}};
    std::size_t i = 1;
    while (i + 1 < way_mm.size() && way_mm[i].first < time_s) ++i;
    const auto& [from_s, from] = way_mm[i - 1];
    const auto& [to_s, to] = way_mm[i];
    const double share = std::clamp((time_s - from_s) / (to_s - from_s), 0.0, 1.0);
    return 1e-3 * (from + share * (to - from));
  }
  std::int64_t begun_ns_ = -1;
};

class FalconProgram : public LiveFixture {
 protected:
  void SetUp() override {
    const char* preloaded = std::getenv("LD_PRELOAD");
    if (!preloaded || !std::strstr(preloaded, "umockdev"))
      GTEST_SKIP() << "run this under umockdev-wrapper";
    LiveFixture::SetUp();
  }

  void plug_in() {
    usb.reset();
    testbed.reset();
    testbed.reset(umockdev_testbed_new());
    falcon = std::make_shared<LedFalcon>();
    usb = std::make_unique<MockUsb>(testbed.get(), falcon, testing::falcon_descriptors(), 2);
    usb->plug();
  }

  // On a machine that is busy enough the watchdog may end the force before the hand presses.
  bool wait_until_it_presses() {
    for (int i = 0; i < 20'000; ++i) {
      if (usb->locked([&] { return falcon->motor_force().y() > 0.5; })) return true;
      if (i % 100 == 0 && output().find("Force is off") != std::string::npos) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }

  // True: it pressed to the end.
  bool run_and_end_by(int number) {
    plug_in();
    const pid_t child = start_shell(std::string("exec ") + OSTEON_EXECUTABLE +
                                    " live --device falcon" + run_options());
    const bool pressed = wait_until_it_presses();
    ::kill(child, number);
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status)) << output();
    EXPECT_EQ(WEXITSTATUS(status), 128 + number) << output();
    EXPECT_NE(output().find("Pull the grip towards you"), std::string::npos) << output();
    const auto command = usb->locked([&] { return falcon->command(); });
    EXPECT_EQ(command.motors, (std::array<int, 3>{0, 0, 0}));
    EXPECT_EQ(command.lights, 0) << "not closed";
    const Ran replayed = run_osteon("replay " + file("run.osr"));
    EXPECT_EQ(replayed.exit_code, 0) << replayed.output;
    EXPECT_EQ(replayed.output.find("cut off"), std::string::npos) << replayed.output;
    std::string why = "it never pressed";
    if (pressed) expect_zero_after_contact(why);
    for (const char* name : {"run.osr", "force.csv", "out.txt"}) fs::remove(file(name));
    return why.empty();
  }

  testing::FirmwareFile firmware{testing::pretended_firmware()};
  std::unique_ptr<UMockdevTestbed, TestbedUnref> testbed;
  std::shared_ptr<LedFalcon> falcon;
  std::unique_ptr<MockUsb> usb;
};

TEST_F(FalconProgram, ASignalInContactLeavesItsMotorsAtZeroAndAWholeRecording) {
  for (const int number : {SIGTERM, SIGINT}) {
    SCOPED_TRACE(strsignal(number));
    bool pressed = false;
    for (int attempt = 0; attempt < 4 && !pressed; ++attempt) pressed = run_and_end_by(number);
    EXPECT_TRUE(pressed);
  }
}

}  // namespace
}  // namespace osteon::testing_cli
