#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "device/falcon/emulated_falcon.h"
#include "falcon/falcon_bringup.h"
#include "falcon/falcon_driver.h"

namespace osteon::testing {

/// A file with the pretended firmware, where the driver looks for it, for as long as this lives.
class FirmwareFile {
 public:
  explicit FirmwareFile(const std::vector<std::uint8_t>& bytes)
      : path_(std::filesystem::path(::testing::TempDir()) /
              ("falcon_firmware_" +
               std::to_string(::testing::UnitTest::GetInstance()->random_seed()) + "_" +
               std::to_string(reinterpret_cast<std::uintptr_t>(this)) + ".bin")) {
    std::ofstream out(path_, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()),
              static_cast<std::streamsize>(bytes.size()));
    out.close();
    setenv("OSTEON_FALCON_FIRMWARE", path_.c_str(), 1);
  }
  ~FirmwareFile() {
    unsetenv("OSTEON_FALCON_FIRMWARE");
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A Falcon on an emulated bus with a hand on its grip.
struct FalconRig {
  explicit FalconRig(const HandParams& hand = {}) : falcon(make(hand)) {}

  static std::shared_ptr<EmulatedFalcon> make(const HandParams& hand) {
    return std::make_shared<EmulatedFalcon>(pretended_firmware(), hand);
  }
  std::unique_ptr<HapticDevice> open() {
    const auto listed = list_falcons(bus);
    EXPECT_TRUE(listed && listed->size() == 1) << "no Falcon is listed";
    auto device = open_falcon(bus, listed->front());
    EXPECT_TRUE(device) << device.error().message();
    return device ? std::move(*device) : nullptr;
  }
  void step(int ms = 1) {
    for (int i = 0; i < ms; ++i) bus.advance(1'000'000);
  }
  /// Moves the hand there in so many ms and rests, while somebody looks at the device.
  void lead(HapticDevice& device, const Vec3& to_V, int ms) {
    const Vec3 from_V = falcon->position_V();
    for (int i = 1; i <= ms + 150; ++i) {
      falcon->want(from_V + (to_V - from_V) * std::min(i, ms) / ms);
      step();
      (void)device.read();
    }
  }
  /// In, out past the lights' turning point, and to the middle: as the advice says.
  void home(HapticDevice& device) {
    lead(device, Vec3(0, 0, -0.03), 100);
    lead(device, Vec3(0, 0, 0.048), 300);
    lead(device, Vec3(0, 0, 0), 300);
  }

  EmulatedUsbBus bus;
  FirmwareFile firmware{pretended_firmware()};
  std::shared_ptr<EmulatedFalcon> falcon;
  std::string port = bus.attach(falcon);
};

}  // namespace osteon::testing
