#include "checkup/device_findings.h"

#include <cstdio>
#include <string>

namespace osteon {
namespace {

std::string number(double x, const char* unit) {
  char text[48];
  std::snprintf(text, sizeof text, "%.4g %s", x, unit);
  return text;
}

std::string axes_of(const std::array<bool, 3>& driven) {
  std::string out;
  for (std::size_t i = 0; i < 3; ++i)
    if (driven[i]) out += "XYZ"[i];
  return out.empty() ? "no axes" : out;
}

std::string describe_device(const DeviceInfo& info) {
  std::string text = info.name;
  if (!info.serial.empty()) text += " (" + info.serial + ")";
  if (info.peak_force_n <= 0) return text + ": no motors";
  text += ": force on " + axes_of(info.force_axes) + ", " + number(info.peak_force_n, "N") +
          " peak, " + number(info.continuous_force_n, "N") + " continuous, " +
          number(info.max_stiffness_n_per_m, "N/m") + ", " + number(info.rate_hz, "Hz");
  if (info.drives_rotation())
    text += "; torque about " + axes_of(info.torque_axes) + ", " +
            number(info.peak_torque_nm, "N m") + " peak, " +
            number(info.continuous_torque_nm, "N m") + " continuous";
  return text;
}

bool is_emulated(const Driver& driver) {
  return std::string(driver.name).starts_with("virtual") || std::string(driver.name) == "null";
}

}  // namespace

Findings device_findings(std::span<const Driver> table) {
  Findings out;
  for (const Driver& driver : table) {
    const auto devices = driver.list();
    if (!devices)
      out.push_back({FindingLevel::kNote, driver.name, devices.error().what, devices.error().todo});
    const std::vector<std::string> reasons =
        driver.unusable ? driver.unusable() : std::vector<std::string>{};
    if (devices)
      for (const DeviceInfo& info : *devices)
        out.push_back({FindingLevel::kGood, driver.name, describe_device(info), {}});
    for (const std::string& reason : reasons)
      out.push_back({FindingLevel::kNote, driver.name, reason, {}});
    if (devices && devices->empty() && reasons.empty())
      out.push_back({FindingLevel::kNote, driver.name, "none is plugged in", {}});
  }
  return out;
}

bool has_force_device(std::span<const Driver> table) {
  for (const Driver& driver : table) {
    if (is_emulated(driver)) continue;
    if (const auto devices = driver.list())
      for (const DeviceInfo& info : *devices)
        if (info.peak_force_n > 0) return true;
  }
  return false;
}

}  // namespace osteon
