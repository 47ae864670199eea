#include "falcon/falcon_bringup.h"

#include <gtest/gtest.h>

#include "device/falcon/falcon_rig.h"

namespace osteon {
namespace {

using testing::EmulatedFalcon;
using testing::FalconRig;
using testing::FirmwareFile;
using testing::pretended_firmware;

std::string as_text(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

std::unique_ptr<UsbLink> link_to(FalconRig& rig) {
  const auto entries = rig.bus.list(kFalconVendor, kFalconProduct);
  return std::move(rig.bus.open(entries.at(0), falcon_channel()).value());
}

Result<void> bring_up(FalconRig& rig) {
  const auto link = link_to(rig);
  return bring_up_falcon(*link, as_text(pretended_firmware()));
}

std::string message(const Result<void>& result) {
  return result ? "succeeded" : result.error().message();
}

TEST(FalconBringup, LoadsTheFirmwareAndSpeaksItsRequestsInOrder) {
  FalconRig rig;
  const auto up = bring_up(rig);
  ASSERT_TRUE(up) << message(up);
  EXPECT_TRUE(rig.falcon->runs());
  EXPECT_EQ(rig.falcon->loaded(), pretended_firmware().size());
  const std::vector<std::array<std::uint16_t, 2>> expected = {
      {9, 1},      {3, 2},      {0, 1},      {0, 2},  // is it running already?
      {0, 1},      {0, 2},      {9, 16},     {3, 0x4138}, {4, 8},    {2, 0},  // to the boot loader
      {1, 0x0200}, {1, 0x0100}, {1, 0x0101}, {1, 0x0100}, {3, 0x15},          // to load
      {9, 1},      {3, 2},      {0, 1},      {0, 2}};
  EXPECT_EQ(rig.falcon->requests(), expected);
  EXPECT_EQ(rig.falcon->command().motors, (std::array<int, 3>{0, 0, 0}));
}

TEST(FalconBringup, AFirmwareThatRunsIsNotLoadedAgain) {
  FalconRig rig;
  ASSERT_TRUE(bring_up(rig));
  const std::size_t before = rig.falcon->requests().size();
  ASSERT_TRUE(bring_up(rig));
  EXPECT_EQ(rig.falcon->requests().size(), before + 4);
}

TEST(FalconBringup, TheBootLoaderMayBeHardOfHearing) {
  FalconRig rig;
  rig.falcon->deaf_greetings = 60;
  rig.falcon->leading_zero = true;
  const auto up = bring_up(rig);
  EXPECT_TRUE(up) << message(up);
}

TEST(FalconBringup, EveryWaitHasAnEnd) {
  FalconRig rig;
  rig.falcon->deaf_greetings = 1'000'000;
  auto up = bring_up(rig);
  EXPECT_NE(message(up).find("boot loader does not answer"), std::string::npos) << message(up);

  FalconRig dead;
  dead.falcon->dead = true;
  up = bring_up(dead);
  EXPECT_FALSE(up);

  FalconRig silent;
  silent.bus.faults(silent.port).silent_until_ns = INT64_MAX;
  up = bring_up(silent);
  EXPECT_NE(message(up).find("did not answer in time"), std::string::npos) << message(up);
  EXPECT_LT(silent.bus.now_ns(), 10'000'000'000);

  FalconRig stalled;
  stalled.bus.faults(stalled.port).stall_control = true;
  up = bring_up(stalled);
  EXPECT_NE(message(up).find("STALL"), std::string::npos) << message(up);
}

TEST(FalconBringup, AWrongEchoStopsIt) {
  FalconRig rig;
  rig.falcon->wrong_echo_at = 700;
  const auto up = bring_up(rig);
  EXPECT_NE(message(up).find("at byte 682"), std::string::npos) << message(up);  // of the chunk
  EXPECT_FALSE(rig.falcon->runs());
}

TEST(FalconBringup, AnotherFileIsNotItsFirmware) {
  FalconRig rig;
  const auto link = link_to(rig);
  const auto up = bring_up_falcon(*link, std::string(500, 'x'));
  EXPECT_FALSE(up);
  EXPECT_FALSE(rig.falcon->runs());
}

TEST(FalconBringup, UnpluggedInTheMiddleEndsInAMessage) {
  FalconRig rig;
  rig.falcon->deaf_greetings = 1'000'000;
  const auto link = link_to(rig);
  rig.bus.detach(rig.port);
  const auto up = bring_up_falcon(*link, as_text(pretended_firmware()));
  EXPECT_NE(message(up).find("unplugged"), std::string::npos) << message(up);
}

TEST(FalconFirmware, AMissingOneSaysWhereItBelongs) {
  setenv("OSTEON_FALCON_FIRMWARE", "/nowhere/fw.bin", 1);
  auto firmware = load_falcon_firmware();
  ASSERT_FALSE(firmware);
  EXPECT_NE(firmware.error().message().find("/nowhere/fw.bin"), std::string::npos);
  unsetenv("OSTEON_FALCON_FIRMWARE");
  setenv("XDG_CONFIG_HOME", "/somewhere", 1);
  EXPECT_EQ(falcon_firmware_file(), "/somewhere/osteon/falcon_firmware.bin");
  unsetenv("XDG_CONFIG_HOME");
  const FirmwareFile empty({});
  EXPECT_FALSE(load_falcon_firmware());
}

TEST(FalconDriver, ListsWhatCanBeOpenedAndSaysWhyNot) {
  FalconRig rig;
  ASSERT_EQ(list_falcons(rig.bus)->size(), 1u);
  EXPECT_EQ(list_falcons(rig.bus)->front().serial, "FN0001");
  EXPECT_TRUE(unusable_falcons(rig.bus).empty());

  setenv("OSTEON_FALCON_FIRMWARE", "/nowhere/fw.bin", 1);
  EXPECT_TRUE(list_falcons(rig.bus)->empty());
  auto reasons = unusable_falcons(rig.bus);
  ASSERT_EQ(reasons.size(), 1u);
  EXPECT_NE(reasons[0].find("firmware is missing"), std::string::npos) << reasons[0];

  setenv("OSTEON_FALCON_FIRMWARE", rig.firmware.path().c_str(), 1);
  rig.bus.forbid(rig.port);
  EXPECT_TRUE(list_falcons(rig.bus)->empty());
  reasons = unusable_falcons(rig.bus);
  ASSERT_EQ(reasons.size(), 1u);
  EXPECT_NE(reasons[0].find(rig.port), std::string::npos) << reasons[0];

  rig.bus.detach(rig.port);
  EXPECT_TRUE(list_falcons(rig.bus)->empty());
  EXPECT_TRUE(unusable_falcons(rig.bus).empty());
}

TEST(FalconDriver, AMachineWithoutUsbOrFalconListsNone) {
  const auto listed = list_falcon();
  ASSERT_TRUE(listed);
  (void)unusable_falcon();
}

}  // namespace
}  // namespace osteon
