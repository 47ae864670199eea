#include "arm_models.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace osteon {
namespace {

struct NamedModel {
  const char* part;  ///< of the name, in small letters
  ArmModel model;
};

// The first that fits counts: "touch x" stands before "touch".
constexpr std::array<NamedModel, 7> kModels{{
    {"premium 3", {"phantom_premium_3.toml", false}},
    {"premium", {"phantom_premium_1_5.toml", false}},
    {"desktop", {"phantom_desktop.toml", true}},
    {"touch x", {"phantom_desktop.toml", true}},
    {"touchx", {"phantom_desktop.toml", true}},
    {"omni", {"phantom_touch.toml", false}},
    {"touch", {"phantom_touch.toml", false}},
}};

// Of both lengths, which differ in reach alone.
constexpr ArmModel kSixDof{"phantom_premium_6dof.toml", false};

double lower(double profile, double reported) {
  return reported > 0 ? std::min(profile, reported) : profile;
}

}  // namespace

ArmModel arm_model(std::string_view model_name, int output_dof) {
  std::string name(model_name);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (output_dof >= 6 && name.find("premium") != std::string::npos) return kSixDof;
  for (const NamedModel& known : kModels)
    if (name.find(known.part) != std::string::npos) return known.model;
  return kModels.back().model;
}

DeviceInfo limited_by(const DeviceInfo& profile, const ArmReport& report) {
  DeviceInfo info = profile;
  info.peak_force_n = lower(profile.peak_force_n, report.max_force_n);
  info.continuous_force_n =
      std::min(info.peak_force_n, lower(profile.continuous_force_n, report.max_continuous_force_n));
  info.max_stiffness_n_per_m = lower(profile.max_stiffness_n_per_m, report.max_stiffness_n_per_m);
  info.peak_torque_nm = lower(profile.peak_torque_nm, report.max_torque_nm);
  info.continuous_torque_nm = std::min(
      info.peak_torque_nm, lower(profile.continuous_torque_nm, report.max_continuous_torque_nm));
  if (report.output_dof < 6) info.torque_axes = {false, false, false};
  if (report.rate_hz > 0) info.rate_hz = report.rate_hz;
  if (!report.workspace_m.empty()) info.workspace_m = report.workspace_m.extent();
  return info;
}

}  // namespace osteon
