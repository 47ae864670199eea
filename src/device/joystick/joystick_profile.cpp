#include "joystick_profile.h"

#include "angles.h"

namespace osteon {
namespace {

void read_usb(ProfileReader& in, const toml::table& joystick, JoystickProfile& p) {
  const toml::table& usb = in.table(joystick, "usb");
  in.only(usb, {"vendor", "product", "interface", "in_endpoint", "out_endpoint", "in_bytes"});
  p.vendor = static_cast<std::uint16_t>(in.integer(usb, "vendor", 1, 0xFFFF));
  p.product = static_cast<std::uint16_t>(in.integer(usb, "product", 0, 0xFFFF));
  p.channel.interface_number = static_cast<std::uint8_t>(in.integer(usb, "interface", 0, 31));
  p.channel.in_endpoint = static_cast<std::uint8_t>(in.integer(usb, "in_endpoint", 0x81, 0x8F));
  p.channel.reports_by_control = p.dialect == JoystickDialectKind::kPid;
  const int lowest = p.channel.reports_by_control ? 0x00 : 0x01;
  p.channel.out_endpoint = static_cast<std::uint8_t>(in.integer(usb, "out_endpoint", lowest, 0x0F));
  p.channel.in_bytes = static_cast<std::size_t>(in.integer(usb, "in_bytes", 1, 512));
}

std::uint16_t read_usage(ProfileReader& in, const toml::table& table, std::string_view key) {
  const std::size_t i =
      in.choice(table, key, {"X", "Y", "Z", "Rx", "Ry", "Rz", "Slider", "Dial", "Wheel"});
  // In the order of the HID Usage Tables, from 0x30 on.
  return static_cast<std::uint16_t>(0x30 + i);
}

int read_sign(ProfileReader& in, const toml::table& table) {
  const auto sign = in.integer(table, "sign", -1, 1);
  if (sign == 0) in.complain("'sign' must be 1 or -1", table.get("sign"));
  return static_cast<int>(sign);
}

void read_axes(ProfileReader& in, const toml::table& joystick, JoystickProfile& p) {
  const toml::table& axes = in.table(joystick, "axes");
  in.only(axes, {"x", "y", "z"});
  constexpr std::array<std::string_view, 3> kNames{"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i) {
    const toml::table& axis = in.table(axes, kNames[i]);
    in.only(axis, {"usage", "force_usage", "sign", "half_range_mm"});
    p.axes[i].usage = read_usage(in, axis, "usage");
    p.force_usages[i] = read_usage(in, axis, "force_usage");
    p.axes[i].sign = read_sign(in, axis);
    p.axes[i].half_range = 1e-3 * in.number(axis, "half_range_mm", 1, 2500);
  }
}

void read_rotation(ProfileReader& in, const toml::table& joystick, JoystickProfile& p) {
  const toml::table& rotation = in.table(joystick, "rotation");
  in.only(rotation, {"usage", "about", "sign", "half_range_deg"});
  p.rotation.usage = read_usage(in, rotation, "usage");
  p.rotation.sign = read_sign(in, rotation);
  p.rotation.half_range = kRadPerDeg * in.number(rotation, "half_range_deg", 1, 3600);
  p.rotation_axis_V =
      Vec3::Unit(static_cast<Eigen::Index>(in.choice(rotation, "about", {"x", "y", "z"})));
}

void read_joystick(ProfileReader& in, JoystickProfile& p) {
  const toml::table& joystick = in.table("joystick");
  const std::size_t dialect = in.choice(joystick, "dialect", {"pid", "vector"});
  p.dialect = dialect == 0 ? JoystickDialectKind::kPid : JoystickDialectKind::kVector;
  const bool pid = p.dialect == JoystickDialectKind::kPid;
  if (pid)
    in.only(joystick, {"dialect", "firmware_timeout_ms", "dead_man_button", "full_scale_n", "usb",
                       "axes", "rotation"});
  else
    in.only(joystick, {"dialect", "firmware_timeout_ms", "dead_man_button", "usb"});
  p.firmware_timeout_s = 1e-3 * in.number(joystick, "firmware_timeout_ms", 0, 1000);
  p.dead_man_button = static_cast<int>(in.integer(joystick, "dead_man_button", -1, 31));
  p.info.has_dead_man = p.dead_man_button >= 0;
  read_usb(in, joystick, p);
  if (!pid) return;
  if (p.info.drives_rotation())
    in.complain("dialect \"pid\" drives no rotation", joystick.get("dialect"));
  p.full_scale_force_n = in.number(joystick, "full_scale_n", 0.1, 1000);
  if (p.full_scale_force_n < p.info.peak_force_n)
    in.complain("'full_scale_n' is below 'peak_n'", joystick.get("full_scale_n"));
  read_axes(in, joystick, p);
  read_rotation(in, joystick, p);
}

}  // namespace

void check_joystick_table(ProfileReader& in, const DeviceInfo& info) {
  JoystickProfile ignored;
  ignored.info = info;
  read_joystick(in, ignored);
}

Result<JoystickProfile> load_joystick_profile(const std::filesystem::path& path) {
  const auto root = parse_profile(path);
  if (!root) return tl::unexpected(root.error());
  ProfileReader in(*root, path.string());
  JoystickProfile profile;
  profile.info = read_device_info(in, *root, "joystick");
  if (profile.info.driver != "joystick")
    in.complain("'driver' must be \"joystick\"", root->get("driver"));
  read_joystick(in, profile);
  if (in.error()) return tl::unexpected(*in.error());
  return profile;
}

}  // namespace osteon
