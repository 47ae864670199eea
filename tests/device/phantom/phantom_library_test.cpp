#include <gtest/gtest.h>

#include <cstdlib>

#include "device/phantom/stub_library.h"
#include "osteon/device/drivers.h"
#include "phantom/arm_models.h"
#include "phantom/hd_api.h"
#include "phantom/hd_errors.h"
#include "phantom/phantom_driver.h"

namespace osteon {
namespace {

class WithLibrary {
 public:
  explicit WithLibrary(const std::string& path) { setenv("OSTEON_HD_LIBRARY", path.c_str(), 1); }
  ~WithLibrary() { unsetenv("OSTEON_HD_LIBRARY"); }
};

TEST(PhantomLibrary, AMissingOneIsNamedWithWhatToDo) {
  const std::vector<std::string> names{"libNoSuchHD.so.9", "libNoSuchHD.so"};
  const auto api = load_hd_api(names);
  ASSERT_FALSE(api);
  EXPECT_EQ(api.error().what, "libNoSuchHD.so was not found");
  EXPECT_NE(api.error().todo.find("Install OpenHaptics"), std::string::npos);
}

TEST(PhantomLibrary, EveryMissingCallIsNamed) {
  const std::vector<std::string> names{OLD_HD};
  const auto api = load_hd_api(names);
  ASSERT_FALSE(api);
  for (const char* call : {"hdMakeCurrentDevice", "hdGetError", "hdUpdateCalibration",
                           "hdScheduleSynchronous", "hdGetString"})
    EXPECT_NE(api.error().what.find(call), std::string::npos) << call;
  EXPECT_EQ(api.error().what.find("hdInitDevice"), std::string::npos);
  EXPECT_EQ(api.error().what.find("hdDisableDevice"), std::string::npos);
}

TEST(PhantomLibrary, AFileThatIsNoLibraryIsRefused) {
  const std::vector<std::string> names{OSTEON_SOURCE_DIR "/README.md"};
  const auto api = load_hd_api(names);
  ASSERT_FALSE(api);
  // It is there: what the system has against it must be told.
  EXPECT_NE(api.error().what.find("could not be loaded: "), std::string::npos) << api.error().what;
}

TEST(PhantomDriver, SaysWhyThereIsNoneWithoutTheLibrary) {
  const WithLibrary missing("/nowhere/libHD.so");
  const auto arms = list_phantom();
  ASSERT_TRUE(arms);
  EXPECT_TRUE(arms->empty());
  const auto reasons = unusable_phantom();
  ASSERT_EQ(reasons.size(), 1u);
  EXPECT_NE(reasons[0].find("/nowhere/libHD.so was not found"), std::string::npos) << reasons[0];
  EXPECT_NE(reasons[0].find("OpenHaptics"), std::string::npos);
  EXPECT_FALSE(open_device("phantom"));
}

TEST(PhantomDriver, OpensBothArmsByTheirNamesThroughTheTable) {
  testing::StubLibrary stub;
  const WithLibrary there(STUB_HD);
  EXPECT_TRUE(unusable_phantom().empty());
  const auto listed = list_phantom();
  ASSERT_TRUE(listed) << listed.error().message();
  ASSERT_FALSE(listed->empty());
  EXPECT_EQ(listed->front().driver, "phantom");
  EXPECT_DOUBLE_EQ(listed->front().peak_force_n, 3.3);  // the weakest until it is open

  DeviceInfo left = listed->front();
  left.serial = "Left Device";
  DeviceInfo right = left;
  right.serial = "Right Device";
  {
    const auto a = open_phantom(left);
    ASSERT_TRUE(a) << a.error().message();
    const auto b = open_phantom(right);
    ASSERT_TRUE(b) << b.error().message();
    EXPECT_EQ((*a)->info().serial, "Left Device");
    EXPECT_EQ((*b)->info().serial, "Right Device");
    EXPECT_EQ((*a)->info().name, listed->front().name);
    EXPECT_TRUE(stub.left->open && stub.right->open);
  }
  EXPECT_FALSE(stub.left->open || stub.right->open);
  EXPECT_FALSE(stub.scheduler_runs());
  EXPECT_EQ(stub.misuses(), 0u);
}

TEST(PhantomModels, KnowsTheFamiliesByName) {
  const auto profile = [](const char* name) { return std::string(arm_model(name).profile); };
  EXPECT_EQ(profile("PHANToM Omni"), "phantom_touch.toml");
  EXPECT_EQ(profile("Geomagic Touch"), "phantom_touch.toml");
  EXPECT_EQ(profile("3D Systems Touch X"), "phantom_desktop.toml");
  EXPECT_EQ(profile("PHANToM Desktop"), "phantom_desktop.toml");
  EXPECT_EQ(profile("PHANTOM Premium 1.5 HF"), "phantom_premium_1_5.toml");
  EXPECT_EQ(profile("Premium 3.0"), "phantom_premium_3.toml");
  EXPECT_EQ(profile(""), "phantom_touch.toml");
  EXPECT_EQ(profile("Something new"), "phantom_touch.toml");
  EXPECT_TRUE(arm_model("PHANToM Desktop").has_dead_man);
  EXPECT_FALSE(arm_model("PHANToM Omni").has_dead_man);
}

TEST(PhantomModels, TheLowerLimitCounts) {
  DeviceInfo profile;
  profile.peak_force_n = 7.9;
  profile.continuous_force_n = 1.75;
  profile.max_stiffness_n_per_m = 1480;
  ArmReport report;
  DeviceInfo info = limited_by(profile, report);  // an arm that tells nothing
  EXPECT_EQ(info.peak_force_n, 7.9);
  EXPECT_EQ(info.continuous_force_n, 1.75);
  EXPECT_EQ(info.max_stiffness_n_per_m, 1480);

  report.max_force_n = 37;  // a higher claim lifts nothing
  report.max_continuous_force_n = 6;
  report.max_stiffness_n_per_m = 1e6;
  info = limited_by(profile, report);
  EXPECT_EQ(info.peak_force_n, 7.9);
  EXPECT_EQ(info.continuous_force_n, 1.75);
  EXPECT_EQ(info.max_stiffness_n_per_m, 1480);

  report.max_force_n = 1.0;  // below the profile's continuous force
  report.max_continuous_force_n = 0;
  report.max_stiffness_n_per_m = 500;
  info = limited_by(profile, report);
  EXPECT_EQ(info.peak_force_n, 1.0);
  EXPECT_EQ(info.continuous_force_n, 1.0);
  EXPECT_EQ(info.max_stiffness_n_per_m, 500);
}

TEST(PhantomErrors, EachHasWordsAndACause) {
  for (const hd::ErrorCode code :
       {0x100u, 0x101u, 0x102u, 0x103u, 0x104u, 0x200u, 0x201u, 0x202u, 0x203u, 0x204u, 0x300u,
        0x301u, 0x302u, 0x303u, 0x304u, 0x400u, 0x401u, 0x402u, 0x500u, 0x501u, 0x600u}) {
    const std::string words = describe_hd_error(code);
    EXPECT_FALSE(words.empty());
    EXPECT_EQ(words.find("that Osteon does not know"), std::string::npos);
    EXPECT_NE(words, describe_hd_error(0x9999)) << std::hex << code;
  }
  EXPECT_EQ(force_off_for(hd::kSuccess), ForceOff::kNone);
  EXPECT_EQ(force_off_for(hd::kInvalidEnum), ForceOff::kNone);
  EXPECT_EQ(force_off_for(hd::kWarmMotors), ForceOff::kTemperature);
  EXPECT_EQ(force_off_for(hd::kExceededMaxVelocity), ForceOff::kVelocity);
  EXPECT_EQ(force_off_for(hd::kCommError), ForceOff::kDisconnect);
  EXPECT_EQ(force_off_for(hd::kDeviceFault), ForceOff::kDeviceFault);
  EXPECT_EQ(force_off_for(0x9999), ForceOff::kDeviceFault);  // unknown: the careful side
}

}  // namespace
}  // namespace osteon
