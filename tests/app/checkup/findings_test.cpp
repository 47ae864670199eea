#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "checkup/computer_findings.h"
#include "checkup/device_findings.h"
#include "osteon/base/file.h"
#include "osteon/device/null_device.h"
#include "osteon/device/virtual_device.h"

namespace osteon {
namespace {

using DeviceList = Result<std::vector<DeviceInfo>>;
using OpenDevice = Result<std::unique_ptr<HapticDevice>>;

DeviceInfo motor_info() {
  DeviceInfo info;
  info.name = "Arm";
  info.driver = "arm";
  info.serial = "7";
  info.peak_force_n = 3.3;
  info.continuous_force_n = 0.9;
  return info;
}

// A device that is never calibrated, or sends nothing.
class Broken : public VirtualDevice {
 public:
  Broken(bool silent) : VirtualDevice(motor_info()), silent_(silent) {}
  DeviceSample read() override {
    DeviceSample sample = VirtualDevice::read();
    sample.calibrated = silent_;
    if (silent_) sample.time_ns = 1;
    return sample;
  }
  void write_force(const Vec3& force_V) override { pushed_ = pushed_ || force_V.norm() > 0; }
  DeviceHealth health() const override {
    DeviceHealth health;
    health.calibration = silent_ ? Calibration::kNotNeeded : Calibration::kNeeded;
    health.advice = silent_ ? "" : "Move the stylus into the inkwell";
    return health;
  }
  ~Broken() override { EXPECT_FALSE(pushed_); }

 private:
  bool silent_;
  bool pushed_ = false;
};

DeviceList one_arm() { return std::vector<DeviceInfo>{motor_info()}; }
DeviceList none() { return std::vector<DeviceInfo>{}; }
DeviceList no_usb() {
  return fail("there is no USB on this computer", "usb", "Use another device");
}
OpenDevice open_arm(const DeviceInfo& info) { return std::make_unique<VirtualDevice>(info); }
OpenDevice open_uncalibrated(const DeviceInfo&) { return std::make_unique<Broken>(false); }
OpenDevice open_silent(const DeviceInfo&) { return std::make_unique<Broken>(true); }
OpenDevice open_none(const DeviceInfo&) { return fail("no permission", "arm", "Install the rule"); }
std::vector<std::string> no_library() { return {"libHD.so was not found. Install OpenHaptics."}; }

const Driver kArm{"arm", "Arm", one_arm, open_arm, nullptr};
const DeviceTrial kShort{0.05, false, 0.5, 0.05, {}};

const Finding* find(const Findings& findings, const std::string& topic) {
  for (const Finding& f : findings)
    if (f.topic == topic) return &f;
  return nullptr;
}

TEST(Findings, NothingFoundIsGoodAndEmpty) {
  EXPECT_EQ(worst({}), FindingLevel::kGood);
  EXPECT_EQ(to_text(Findings{}), "");
  EXPECT_EQ(nlohmann::json::parse(to_json(Findings{})).size(), 0u);
}

TEST(Findings, TextAndJsonTellTheSame) {
  const Findings f{{FindingLevel::kGood, "A", "works", ""},
                   {FindingLevel::kBad, "B", "fails\nbadly", "mend it"}};
  EXPECT_EQ(worst(f), FindingLevel::kBad);
  const std::string text = to_text(f);
  EXPECT_NE(text.find("ok    A"), std::string::npos) << text;
  EXPECT_NE(text.find("-> mend it"), std::string::npos) << text;
  const auto json = nlohmann::json::parse(to_json(f));
  EXPECT_EQ(json[1]["level"], "bad");
  EXPECT_EQ(json[1]["todo"], "mend it");
  EXPECT_NE(verdict(f, true), verdict({f[0]}, true));
  EXPECT_NE(verdict({f[0]}, true), verdict({f[0]}, false));
}

TEST(DeviceFindings, NoLibraryNoPermissionAndNoUsbAreNotesNotFailures) {
  const std::array<Driver, 4> table{{
      kArm,
      {"usb", "USB", no_usb, open_arm, nullptr},
      {"phantom", "PHANToM", none, open_arm, no_library},
      {"other", "Other", none, open_arm, nullptr},
  }};
  const Findings found = device_findings(table);
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(worst(found), FindingLevel::kNote);
  EXPECT_NE(find(found, "arm")->text.find("Arm (7): force on XYZ, 3.3 N peak"), std::string::npos)
      << find(found, "arm")->text;
  EXPECT_EQ(find(found, "usb")->text, "there is no USB on this computer");
  EXPECT_EQ(find(found, "usb")->todo, "Use another device");
  EXPECT_NE(find(found, "phantom")->text.find("OpenHaptics"), std::string::npos);
  EXPECT_EQ(find(found, "other")->text, "none is plugged in");
  EXPECT_TRUE(has_force_device(table));
  EXPECT_FALSE(has_force_device(std::span(table).subspan(1)));
}

TEST(DeviceTrial, ASoundDeviceIsReadAndIsNotPushedUnasked) {
  const Findings found = try_device(kArm, motor_info(), kShort);
  EXPECT_EQ(worst(found), FindingLevel::kGood) << to_text(found);
  ASSERT_NE(find(found, "Readings"), nullptr);
  EXPECT_EQ(find(found, "Force"), nullptr);
}

TEST(DeviceTrial, WithConsentEachAxisAnswersToTheSmallForce) {
  DeviceTrial trial = kShort;
  trial.push = true;
  trial.push_s = 0.2;
  const Findings found = try_device(kArm, motor_info(), trial);
  int pushes = 0;
  for (const Finding& f : found)
    if (f.topic == "Force") {
      ++pushes;
      EXPECT_EQ(f.level, FindingLevel::kGood) << f.text;
      EXPECT_NE(f.text.find("0.50 N moved the hand by"), std::string::npos) << f.text;
    }
  EXPECT_EQ(pushes, 3);
}

TEST(DeviceTrial, AnUncalibratedDeviceIsNotPushedAndTheAdviceIsGiven) {
  DeviceTrial trial = kShort;
  trial.push = true;
  const Driver driver{"arm", "Arm", one_arm, open_uncalibrated, nullptr};
  const Findings found = try_device(driver, motor_info(), trial);
  const Finding* f = find(found, "Calibration");
  ASSERT_NE(f, nullptr);
  EXPECT_EQ(f->level, FindingLevel::kBad);
  EXPECT_EQ(f->todo, "Move the stylus into the inkwell");
  EXPECT_EQ(find(found, "Force"), nullptr);
}

TEST(DeviceTrial, ASilentDeviceAndOneThatCannotBeOpenedAreBad) {
  DeviceTrial trial = kShort;
  trial.push = true;
  const Driver silent{"arm", "Arm", one_arm, open_silent, nullptr};
  EXPECT_EQ(worst(try_device(silent, motor_info(), trial)), FindingLevel::kBad);
  const Driver closed{"arm", "Arm", one_arm, open_none, nullptr};
  const Findings found = try_device(closed, motor_info(), trial);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].level, FindingLevel::kBad);
  EXPECT_NE(found[0].text.find("no permission"), std::string::npos);
}

TEST(UdevRule, IsWrittenWhereAskedAndNamesTheDevices) {
  const auto folder =
      std::filesystem::path(testing::TempDir()) / ("osteon_udev_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const Finding done = install_udev_rule(folder);
  EXPECT_EQ(done.level, FindingLevel::kGood) << done.text;
  const std::string rule = read_file(folder / kUdevFile).value();
  EXPECT_NE(rule.find("ATTR{idVendor}==\"0403\", ATTR{idProduct}==\"cb48\""), std::string::npos);
  std::filesystem::remove_all(folder);
  const Finding refused = install_udev_rule(folder / "missing");
  EXPECT_EQ(refused.level, FindingLevel::kBad);
  EXPECT_NE(refused.todo.find("sudo"), std::string::npos);
}

}  // namespace
}  // namespace osteon
