#include "loops/device_log.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "fake_device.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

std::string saved(const DeviceLog& log) {
  const auto path = std::filesystem::path(testing::TempDir()) /
                    ("osteon_log_" + std::to_string(::getpid()) + ".csv");
  EXPECT_TRUE(log.save(path));
  const std::string text = read_file(path).value();
  std::filesystem::remove(path);
  return text;
}

TEST(DeviceLog, AnEmptyOneHasAHeaderAlone) {
  test::DeviceLog seen;
  const DeviceLog log(std::make_unique<test::FakeDevice>(test::press_and_slide, seen));
  EXPECT_EQ(saved(log), "time_s,x_mm,y_mm,z_mm,fx_n,fy_n,fz_n\n");
}

TEST(DeviceLog, KeepsTheLastSecondsInOrderAndPassesEverythingOn) {
  test::DeviceLog seen;
  DeviceLog log(std::make_unique<test::FakeDevice>(test::press_and_slide, seen), 0.003);
  for (int i = 0; i < 5; ++i) {
    log.read();
    log.write_force(Vec3(i, 0, 0));
  }
  log.close();
  const std::string text = saved(log);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 5);  // header, three rows, "closed"
  EXPECT_NE(text.find("\n0.002000,0.0000,0.0000,2.9000,2.00000,"), std::string::npos) << text;
  EXPECT_EQ(text.find("1.00000"), std::string::npos);
  EXPECT_LT(text.find("3.00000"), text.find("4.00000"));
  EXPECT_TRUE(text.ends_with("closed\n"));
  EXPECT_EQ(seen.forces_V.size(), 5u);
  EXPECT_TRUE(seen.closed);
}

TEST(DeviceLog, WithAFileItIsThereAtOnceAndWholeOnceTheDeviceIsClosed) {
  const auto path = std::filesystem::path(testing::TempDir()) /
                    ("osteon_own_log_" + std::to_string(::getpid()) + ".csv");
  test::DeviceLog seen;
  DeviceLog log(std::make_unique<test::FakeDevice>(test::press_and_slide, seen), 1, path);
  EXPECT_TRUE(std::filesystem::exists(path));
  log.read();
  log.write_force(Vec3(7, 0, 0));
  log.close();
  const std::string text = read_file(path).value();
  EXPECT_NE(text.find("7.00000"), std::string::npos);
  EXPECT_TRUE(text.ends_with("closed\n"));
  std::filesystem::remove(path);
  log.close();
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace osteon
