#include "osteon/device/profile.h"

#include "joystick/joystick_profile.h"
#include "osteon/base/file.h"
#include "profile_reader.h"

namespace osteon {
namespace {

// Drivers whose profiles hold a table of their own, and what checks it.
struct DriverTable {
  std::string_view driver;  // the table's name too
  void (*check)(ProfileReader& in, const DeviceInfo& info);
};
constexpr std::array<DriverTable, 1> kDriverTables{{{"joystick", check_joystick_table}}};

void read_force(ProfileReader& in, DeviceInfo& info) {
  const toml::table& force = in.table("force");
  in.only(force, {"axes", "peak_n", "continuous_n", "max_stiffness_n_per_m", "max_slew_n_per_s"});
  info.force_axes = in.axes(force, "axes");
  info.peak_force_n = in.number(force, "peak_n", 0, 100);
  info.continuous_force_n = in.number(force, "continuous_n", 0, 100);
  info.max_stiffness_n_per_m = in.number(force, "max_stiffness_n_per_m", 0, 1e5);
  info.max_slew_n_per_s = in.number(force, "max_slew_n_per_s", 0, 1e6);
  if (info.continuous_force_n > info.peak_force_n)
    in.complain("'continuous_n' is above 'peak_n'", force.get("continuous_n"));
}

// A rotation whose limits are not told gets no torque.
void read_torque(ProfileReader& in, DeviceInfo& info) {
  const toml::table& torque = in.table("torque");
  in.only(torque, {"axes", "peak_nm", "continuous_nm", "max_slew_nm_per_s"});
  info.torque_axes = in.axes(torque, "axes");
  if (torque.size() < 2) return;
  info.peak_torque_nm = in.number(torque, "peak_nm", 0, 10);
  info.continuous_torque_nm = in.number(torque, "continuous_nm", 0, 10);
  info.max_torque_slew_nm_per_s = in.number(torque, "max_slew_nm_per_s", 0, 1e5);
  if (info.continuous_torque_nm > info.peak_torque_nm)
    in.complain("'continuous_nm' is above 'peak_nm'", torque.get("continuous_nm"));
}

const DriverTable* table_of(std::string_view driver) {
  for (const DriverTable& t : kDriverTables)
    if (t.driver == driver) return &t;
  return nullptr;
}

}  // namespace

DeviceInfo read_device_info(ProfileReader& in, const toml::table& root,
                            std::string_view driver_table) {
  DeviceInfo info;
  in.only(root, {"name", "driver", "rate_hz", "force", "torque", "workspace", driver_table});
  info.name = in.text(root, "name");
  info.driver = in.text(root, "driver");
  info.rate_hz = in.number(root, "rate_hz", 1, 100000);
  read_force(in, info);
  read_torque(in, info);
  const toml::table& workspace = in.table("workspace");
  in.only(workspace, {"extent_mm"});
  info.workspace_m = in.lengths_mm(workspace, "extent_mm");
  return info;
}

Result<toml::table> parse_profile(const std::filesystem::path& path) {
  constexpr std::uint64_t kLargestBytes = 1 << 20;
  const auto content = read_file(path, kLargestBytes);
  if (!content) return tl::unexpected(content.error());
  try {
    return toml::parse(*content, path.string());
  } catch (const toml::parse_error& e) {
    return fail(std::string(e.description()),
                path.string() + ", line " + std::to_string(e.source().begin.line),
                "Fix the TOML there");
  }
}

Result<DeviceInfo> load_device_profile(const std::filesystem::path& path) {
  const auto root = parse_profile(path);
  if (!root) return tl::unexpected(root.error());
  ProfileReader in(*root, path.string());
  const DriverTable* table = table_of((*root)["driver"].value_or(std::string_view()));
  DeviceInfo info = read_device_info(in, *root, table ? table->driver : "");
  if (table) table->check(in, info);
  if (in.error()) return tl::unexpected(*in.error());
  return info;
}

}  // namespace osteon
