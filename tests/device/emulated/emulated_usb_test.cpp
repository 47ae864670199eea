#include "emulated/emulated_usb.h"

#include <gtest/gtest.h>

#include <vector>

namespace osteon {
namespace {

constexpr std::int64_t kUsbMs = 1'000'000;

// Answers every frame with a counter, keeps what it is sent, echoes controls.
class EchoDevice : public EmulatedUsbDevice {
 public:
  UsbEntry entry() const override { return {0x1209, 1, "S1", "Echo", "", ""}; }
  bool control(const UsbSetup& setup, std::span<const std::uint8_t> out, std::span<std::uint8_t> in,
               std::size_t& in_size) override {
    if (setup.request == 0xEE) return false;
    if (!setup.is_in()) controls.emplace_back(out.begin(), out.end());
    for (auto& b : in) b = static_cast<std::uint8_t>(setup.value);
    in_size = in.size();
    return true;
  }
  void take_out(std::uint8_t, std::span<const std::uint8_t> bytes) override {
    taken.emplace_back(bytes.begin(), bytes.end());
  }
  std::size_t give_in(std::uint8_t, std::span<std::uint8_t> packet) override {
    packet[0] = count++;
    packet[1] = 0xAA;
    return 2;
  }
  void advance(std::int64_t) override {}
  void disconnected() override { unplugged = true; }

  std::vector<std::vector<std::uint8_t>> taken, controls;
  std::uint8_t count = 0;
  bool unplugged = false;
};

struct Rig {
  EmulatedUsbBus bus;
  std::shared_ptr<EchoDevice> device = std::make_shared<EchoDevice>();
  std::string port = bus.attach(device);
  std::unique_ptr<UsbLink> link = open();

  std::unique_ptr<UsbLink> open() {
    const auto entries = bus.list(0x1209, 1);
    EXPECT_EQ(entries.size(), 1u);
    auto opened = bus.open(entries.front(), {});
    EXPECT_TRUE(opened);
    return std::move(*opened);
  }
  void send(std::size_t slot, std::uint8_t value) {
    EXPECT_TRUE(
        link->write(slot, std::array<std::uint8_t, 2>{static_cast<std::uint8_t>(slot), value}));
  }
  int received() {
    link->poll();
    UsbPacket packet;
    int n = 0;
    while (link->next_in(packet)) ++n;
    return n;
  }
};

TEST(EmulatedUsb, OneTransactionAnEndpointAndFrame) {
  Rig rig;
  rig.send(0, 1);
  rig.send(1, 2);
  rig.send(2, 3);
  rig.bus.advance(2 * kUsbMs);
  EXPECT_EQ(rig.device->taken.size(), 1u);  // what waits leaves when the host comes by
  EXPECT_TRUE(rig.link->send());
  rig.bus.advance(kUsbMs);
  EXPECT_TRUE(rig.link->send());
  EXPECT_EQ(rig.received(), 3);
  rig.bus.advance(kUsbMs / 2);
  EXPECT_EQ(rig.received(), 0);
  rig.bus.advance(kUsbMs / 2);
  EXPECT_EQ(rig.device->taken, (std::vector<std::vector<std::uint8_t>>{{0, 1}, {1, 2}, {2, 3}}));
  EXPECT_TRUE(rig.link->out_idle());
  EXPECT_EQ(rig.link->counters().out, 3u);
}

TEST(EmulatedUsb, TheSlotThatIsFarthestFromWhatItSentGoesFirstAndNoneWaitsForEver) {
  Rig rig;
  const auto put = [&](std::size_t slot, std::uint8_t value) {
    rig.link->put(slot, std::array<std::uint8_t, 2>{static_cast<std::uint8_t>(slot), value}, value);
  };
  int to_last = 0, to_still = 0;
  for (std::uint8_t i = 1; i <= 60; ++i) {
    put(0, i);
    put(1, static_cast<std::uint8_t>(4 * i));
    put(2, 0);
    EXPECT_TRUE(rig.link->send());
    rig.bus.advance(kUsbMs);
    ASSERT_EQ(rig.device->taken.size(), i);
    const auto& taken = rig.device->taken.back();
    to_last += taken[0] == 0 ? 1 : 0;
    to_still += taken[0] == 2 ? 1 : 0;
    EXPECT_TRUE(taken[0] != 0 || taken[1] == i) << "an old value";
  }
  EXPECT_GE(to_last, 10);
  EXPECT_LE(to_last, 30);
  EXPECT_GE(to_still, 3);
  EXPECT_LE(to_still, 6);
}

TEST(EmulatedUsb, AtHighSpeedThreePacketsLeaveInATick) {
  class Fast : public EchoDevice {
    UsbSpeed speed() const override { return UsbSpeed::kHigh; }
  };
  EmulatedUsbBus bus;
  const auto device = std::make_shared<Fast>();
  bus.attach(device);
  const auto link = bus.open(bus.list(0x1209, 1).front(), {}).value();
  for (std::uint8_t slot = 0; slot < 3; ++slot) link->put(slot, std::array{slot}, 1);
  EXPECT_TRUE(link->send());
  bus.advance(kUsbMs);
  EXPECT_EQ(device->taken.size(), 3u);
  EXPECT_TRUE(link->out_idle());
}

TEST(EmulatedUsb, LastValueWinsWhenTheDeviceStalls) {
  Rig rig;
  rig.bus.faults(rig.port).silent_until_ns = 100 * kUsbMs;
  for (std::uint8_t i = 0; i < 100; ++i) {
    rig.send(0, i);
    rig.link->poll();
    rig.bus.advance(kUsbMs);
  }
  // The device takes what is in flight at its waking, never older than the time to replace it.
  for (int i = 0; i < 10; ++i) {
    rig.link->send();
    rig.bus.advance(kUsbMs);
  }
  ASSERT_GE(rig.device->taken.size(), 1u);
  ASSERT_LE(rig.device->taken.size(), 2u);
  for (const auto& bytes : rig.device->taken) EXPECT_GE(bytes[1], 95);
  EXPECT_EQ(rig.device->taken.back()[1], 99);
  EXPECT_EQ(rig.link->counters().replaced + rig.device->taken.size(), 100u);
}

TEST(EmulatedUsb, ControlsAnswerStallAndTimeOut) {
  Rig rig;
  const auto in = control_and_wait(*rig.link, {0xC0, 1, 7, 0, 3}, {});
  EXPECT_EQ(in.error, UsbError::kNone);
  EXPECT_EQ(std::vector<std::uint8_t>(in.data.begin(), in.data.end()),
            (std::vector<std::uint8_t>{7, 7, 7}));
  const std::array<std::uint8_t, 2> sent{1, 2};
  EXPECT_EQ(control_and_wait(*rig.link, {0x40, 1, 0, 0, 2}, sent).error, UsbError::kNone);
  EXPECT_EQ(rig.device->controls.front(), (std::vector<std::uint8_t>{1, 2}));
  EXPECT_EQ(control_and_wait(*rig.link, {0xC0, 0xEE, 0, 0, 3}, {}).error, UsbError::kStall);
  EXPECT_FALSE(rig.link->start_control({0x40, 1, 0, 0, 3}, sent));  // fewer bytes than promised
  rig.bus.faults(rig.port).silent_until_ns = rig.bus.now_ns() + 500 * kUsbMs;
  const std::int64_t before = rig.bus.now_ns();
  EXPECT_EQ(control_and_wait(*rig.link, {0xC0, 1, 0, 0, 3}, {}, 0.05).error, UsbError::kTimeout);
  EXPECT_LT(rig.bus.now_ns() - before, 60 * kUsbMs);
}

TEST(EmulatedUsb, FaultsAreWhatTheySay) {
  Rig rig;
  UsbFaults& faults = rig.bus.faults(rig.port);
  faults.short_in = 1;
  faults.garbage_in = 2;
  rig.bus.advance(3 * kUsbMs);
  UsbPacket packet;
  rig.link->poll();
  ASSERT_TRUE(rig.link->next_in(packet));
  EXPECT_EQ(packet.bytes.size(), 1u);
  ASSERT_TRUE(rig.link->next_in(packet));
  EXPECT_EQ(packet.bytes.size(), 2u);
  ASSERT_TRUE(rig.link->next_in(packet));
  EXPECT_EQ(packet.bytes[1], 0xAA);
  faults.in_late_ns = 5 * kUsbMs;
  rig.bus.advance(5 * kUsbMs);
  EXPECT_EQ(rig.received(), 0);
  rig.bus.advance(kUsbMs);
  EXPECT_EQ(rig.received(), 1);
  faults.in_late_ns = 0;
  faults.stall_in = true;
  rig.bus.advance(10 * kUsbMs);
  EXPECT_EQ(rig.link->in_error(), UsbError::kStall);
  rig.received();
  rig.bus.advance(10 * kUsbMs);
  EXPECT_EQ(rig.received(), 0);
  rig.link->restart();
  rig.bus.advance(kUsbMs);
  EXPECT_EQ(rig.received(), 1);
  faults.short_out = 1;
  rig.send(0, 1);
  rig.bus.advance(kUsbMs);
  EXPECT_EQ(rig.link->out_error(), UsbError::kShort);
  EXPECT_EQ(rig.device->taken.back().size(), 1u);
}

TEST(EmulatedUsb, UnpluggedIsGoneAndAReplugIsAnotherLink) {
  Rig rig;
  rig.bus.detach(rig.port);
  EXPECT_TRUE(rig.device->unplugged);
  EXPECT_TRUE(rig.link->gone());
  EXPECT_FALSE(rig.link->write(0, std::array<std::uint8_t, 1>{1}));
  EXPECT_EQ(control_and_wait(*rig.link, {0xC0, 1, 0, 0, 1}, {}).error, UsbError::kGone);
  EXPECT_TRUE(rig.bus.list(0x1209, 1).empty());
  rig.bus.attach(rig.device);
  EXPECT_EQ(rig.bus.changes().arrived, 2u);
  EXPECT_EQ(rig.bus.changes().left, 1u);
  rig.bus.advance(10 * kUsbMs);
  EXPECT_TRUE(rig.link->gone());
  EXPECT_EQ(rig.received(), 0);
  rig.link = rig.open();
  rig.bus.advance(kUsbMs);
  EXPECT_EQ(rig.received(), 1);
}

TEST(EmulatedUsb, ForbiddenIsListedWithItsReason) {
  EmulatedUsbBus bus;
  bus.forbid(bus.attach(std::make_shared<EchoDevice>()));
  const auto entries = bus.list(0, 0);
  ASSERT_EQ(entries.size(), 1u);
  EXPECT_NE(entries[0].access_problem.find("permission"), std::string::npos);
  EXPECT_FALSE(bus.open(entries[0], {}));
}

}  // namespace
}  // namespace osteon
