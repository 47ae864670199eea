#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <ostream>

#include "device/wall_loop.h"
#include "emulated/emulated_pid_joystick.h"
#include "emulated/emulated_usb.h"
#include "emulated/emulated_vector_joystick.h"
#include "joystick/joystick_device.h"

namespace osteon::testing {

inline constexpr std::int64_t kMs = 1'000'000;

inline JoystickProfile shipped_profile(JoystickDialectKind dialect) {
  const char* file =
      dialect == JoystickDialectKind::kPid ? "joystick_pid.toml" : "joystick_vector.toml";
  auto profile =
      load_joystick_profile(std::filesystem::path(OSTEON_SOURCE_DIR) / "assets" / "devices" / file);
  EXPECT_TRUE(profile) << profile.error().message();
  return *profile;
}

/// The joysticks that the tests go through.
struct JoystickKind {
  const char* name;
  JoystickDialectKind dialect;
  bool out_endpoint = true;  ///< false: reports by SET_REPORT alone
};
inline constexpr JoystickKind kPidKind{"Pid", JoystickDialectKind::kPid};
inline constexpr JoystickKind kPidByControlKind{"PidByControl", JoystickDialectKind::kPid, false};
inline constexpr JoystickKind kVectorKind{"Vector", JoystickDialectKind::kVector};
inline void PrintTo(const JoystickKind& kind, std::ostream* out) { *out << kind.name; }

/// An emulated joystick on an emulated bus, opened by the driver that a real one has.
struct JoystickRig {
  explicit JoystickRig(JoystickDialectKind dialect, UsbSpeed pid_speed = UsbSpeed::kFull)
      : profile(shipped_profile(dialect)) {
    if (dialect == JoystickDialectKind::kPid) {
      pid = std::make_shared<EmulatedPidJoystick>("P0001", pid_speed);
      emulated = pid;
      mechanics = &pid->mechanics();
    } else {
      vector = std::make_shared<EmulatedVectorJoystick>();
      emulated = vector;
      mechanics = &vector->mechanics();
    }
    port = bus.attach(emulated);
  }
  explicit JoystickRig(const JoystickKind& kind) : JoystickRig(kind.dialect) {
    if (!kind.out_endpoint) pid->leave_out_endpoint_away();
  }

  Result<std::unique_ptr<JoystickDevice>> try_open() {
    UsbEntry entry = emulated->entry();
    entry.port = port;
    auto link = bus.open(entry, profile.channel);
    if (!link) return tl::unexpected(link.error());
    return JoystickDevice::start(profile, std::move(*link));
  }
  void open() {
    auto opened = try_open();
    ASSERT_TRUE(opened) << opened.error().message();
    device = std::move(*opened);
  }
  UsbFaults& faults() { return bus.faults(port); }
  Vec3 motors() const { return mechanics->motors(); }
  /// The emulated user wants the stylus there, at rest.
  void want(const Vec3& p_V, std::uint32_t buttons = 0) {
    Pose wanted;
    wanted.p = p_V;
    mechanics->set_target(wanted, Vec3::Zero(), buttons);
  }
  void pass_ms(int ms) { bus.advance(ms * kMs); }

  JoystickProfile profile;
  EmulatedUsbBus bus;
  std::shared_ptr<EmulatedPidJoystick> pid;
  std::shared_ptr<EmulatedVectorJoystick> vector;
  std::shared_ptr<EmulatedUsbDevice> emulated;
  JoystickMechanics* mechanics = nullptr;
  std::string port;
  std::unique_ptr<JoystickDevice> device;
};

}  // namespace osteon::testing
