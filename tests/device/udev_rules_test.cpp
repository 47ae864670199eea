#include "osteon/device/udev_rules.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "osteon/base/file.h"

namespace osteon {
namespace {

TEST(UdevRules, ProfilesTellTheirDevicesEachOnceAndBrokenOnesAreLeftOut) {
  const auto folder =
      std::filesystem::path(::testing::TempDir()) / ("osteon_ids_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  ASSERT_TRUE(write_file_atomic(folder / "a.toml",
                                "name = \"A\"\n[joystick.usb]\nvendor = 0x1209\nproduct = 1\n"));
  ASSERT_TRUE(write_file_atomic(folder / "b.toml", "[usb]\nvendor = 0x1209\nproduct = 1\n"));
  ASSERT_TRUE(
      write_file_atomic(folder / "c.toml", "name = \"C\"\n[usb]\nvendor = 70000\nproduct = 1\n"));
  ASSERT_TRUE(write_file_atomic(folder / "d.toml", "= = ="));
  ASSERT_TRUE(write_file_atomic(folder / "e.txt", "[usb]\nvendor = 1\nproduct = 1\n"));
  const std::vector<UsbId> ids = known_usb_devices(folder);
  ASSERT_EQ(ids.size(), 2u);
  EXPECT_EQ(ids[0], (UsbId{0x0403, 0xcb48, "Novint Falcon"}));
  EXPECT_EQ(ids[1], (UsbId{0x1209, 1, "A"}));
  const std::string rules = udev_rules(ids);
  EXPECT_NE(rules.find("ATTR{idVendor}==\"1209\", ATTR{idProduct}==\"0001\", TAG+=\"uaccess\"\n"),
            std::string::npos)
      << rules;
  std::filesystem::remove_all(folder);
  EXPECT_EQ(known_usb_devices(folder).size(), 1u);
}

}  // namespace
}  // namespace osteon
