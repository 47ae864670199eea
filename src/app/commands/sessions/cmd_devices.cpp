#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include "commands/support/parser.h"

#include "checkup/device_findings.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"

namespace osteon {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const DeviceInfo& info) {
  return {{"name", info.name},
          {"driver", info.driver},
          {"serial", info.serial},
          {"force_axes", info.force_axes},
          {"torque_axes", info.torque_axes},
          {"peak_force_n", info.peak_force_n},
          {"continuous_force_n", info.continuous_force_n},
          {"peak_torque_nm", info.peak_torque_nm},
          {"continuous_torque_nm", info.continuous_torque_nm},
          {"max_stiffness_n_per_m", info.max_stiffness_n_per_m},
          {"workspace_mm",
           {info.workspace_m.x() * 1e3, info.workspace_m.y() * 1e3, info.workspace_m.z() * 1e3}},
          {"rate_hz", info.rate_hz},
          {"has_dead_man", info.has_dead_man}};
}

Json to_json(const Driver& driver) {
  Json json = {{"driver", driver.name},
               {"description", driver.description},
               {"devices", Json::array()},
               {"unusable", Json::array()}};
  if (const auto devices = driver.list()) {
    for (const DeviceInfo& info : *devices) json["devices"].push_back(to_json(info));
  } else {
    json["unusable"].push_back(devices.error().message());
  }
  if (driver.unusable)
    for (const std::string& reason : driver.unusable()) json["unusable"].push_back(reason);
  return json;
}

int run_devices(bool as_json) {
  if (!as_json) {
    std::fputs(to_text(device_findings(drivers())).c_str(), stdout);
    return kExitDone;
  }
  Json json = Json::array();
  for (const Driver& driver : drivers()) json.push_back(to_json(driver));
  std::puts(json.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
  return kExitDone;
}

}  // namespace

void add_devices_command(cli::App& app, int& exit_code) {
  const auto as_json = std::make_shared<bool>(false);
  cli::App* command =
      app.add_subcommand("devices", "List the input devices, and say why one cannot be used");
  command->add_flag("--json", *as_json, "print JSON");
  command->callback([as_json, &exit_code] { exit_code = run_devices(*as_json); });
}

}  // namespace osteon
