#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include "commands/support/parser.h"

#include "checkup/computer_findings.h"
#include "checkup/device_findings.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "loops/stop_signal.h"
#include "osteon/base/file.h"
#include "osteon/device/udev_rules.h"

namespace osteon {
namespace {

struct DoctorOptions {
  std::string device;
  bool force_test = false;
  bool yes = false;
  bool install_udev = false;
  bool print_udev = false;
  std::string udev_folder = kUdevFolder;
  double seconds = 2;
  bool as_json = false;
};

int print_udev_rule() {
  const auto data = find_data_dir();
  if (!data) return report_error(data.error());
  std::fputs(udev_rules(known_usb_devices(*data / "assets" / "devices")).c_str(), stdout);
  return kExitDone;
}

// A motor shall move nobody's hand unasked.
bool consents(const DeviceInfo& info) {
  std::printf("%s will push gently (0.5 N) on each of its axes. Hold it loosely. Continue? [y/N] ",
              info.name.c_str());
  std::fflush(stdout);
  std::string answer;
  std::getline(std::cin, answer);
  return answer == "y" || answer == "Y" || answer == "yes";
}

// Tries the device that was asked for; else each real one that gives force.
Findings device_trials(const DoctorOptions& options) {
  Findings out;
  bool found = false;
  for (const Driver& driver : drivers()) {
    const bool asked = options.device == driver.name;
    const auto devices = driver.list();
    if (!asked || !devices) continue;
    for (const DeviceInfo& info : *devices) {
      found = true;
      DeviceTrial trial;
      trial.push = options.force_test && (options.yes || consents(info));
      for (Finding& f : try_device(driver, info, trial)) out.push_back(std::move(f));
    }
  }
  if (!options.device.empty() && !found)
    out.push_back(
        {FindingLevel::kBad, options.device, "there is no such device", "See `osteon devices`"});
  return out;
}

void append(Findings& out, Findings more) {
  for (Finding& f : more) out.push_back(std::move(f));
}

int run_doctor(const DoctorOptions& options) {
  if (options.print_udev) return print_udev_rule();
  const StopSignals signals;  // so that an interrupted force test leaves the motors at zero
  Findings findings;
  if (options.install_udev) findings.push_back(install_udev_rule(options.udev_folder));
  append(findings, device_findings(drivers()));
  if (!options.install_udev) append(findings, usb_findings());
  append(findings, device_trials(options));
  if (stop_requested()) return 128 + stop_signal();
  append(findings, realtime_findings(options.seconds));
  findings.push_back(gl_finding());
  std::fputs((options.as_json ? to_json(findings) : to_text(findings)).c_str(), stdout);
  const bool force_device = has_force_device(drivers()) || !options.device.empty();
  if (!options.as_json) std::printf("\n%s\n", verdict(findings, force_device).c_str());
  return worst(findings) == FindingLevel::kBad ? kExitNo : kExitDone;
}

}  // namespace

void add_doctor_command(cli::App& app, int& exit_code) {
  const auto options = std::make_shared<DoctorOptions>();
  cli::App* command = app.add_subcommand(
      "doctor", "Check devices, permissions, timing and graphics. Exit code: 0 ready, 1 not ready");
  command->add_option("--device", options->device,
                      "driver of the devices to test: calibration, rate, jitter, health");
  command->add_flag("--force-test", options->force_test,
                    "with --device: push gently along each axis, after asking");
  command->add_flag("--yes", options->yes, "run the force test without asking");
  command->add_flag("--udev-rule", options->print_udev, "print the udev rule and exit");
  command->add_flag(
      "--install-udev", options->install_udev,
      "install the udev rule, so that logged-in users may open the devices (as root)");
  command->add_option("--udev-folder", options->udev_folder, "folder for the rule")
      ->capture_default_str();
  command->add_option("--seconds", options->seconds, "how long the 1 kHz loop is measured, s")
      ->check(cli::Range(0.1, 600.0))
      ->capture_default_str();
  command->add_flag("--json", options->as_json, "print JSON");
  command->callback([options, &exit_code] { exit_code = run_doctor(*options); });
}

}  // namespace osteon
