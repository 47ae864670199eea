#include "checkup/checkup.h"

#include <utility>

namespace osteon {
namespace {

void append(Findings& out, Findings more) {
  for (Finding& f : more) out.push_back(std::move(f));
}

Findings try_ordered(CheckupOrder& order, const std::function<bool()>& cancelled) {
  DeviceTrial trial;
  trial.read_s = order.read_s;
  trial.push = order.push;
  trial.cancelled = cancelled;
  if (order.device) return try_device(*order.device, trial);
  return order.driver ? try_device(*order.driver, order.info, trial) : Findings{};
}

}  // namespace

CheckupReport run_checkup(CheckupOrder& order, std::span<const Driver> table,
                          const CheckupProgress& progress, const std::function<bool()>& cancelled) {
  CheckupReport report;
  const bool tries = order.device || order.driver;
  const auto go_on = [&](const char* what, double fraction) {
    report.ended_early = report.ended_early || cancelled();
    if (!report.ended_early) progress(what, fraction);
    return !report.ended_early;
  };
  // The device first: a hand is on it.
  if (tries && go_on(order.push ? "The device pushes gently" : "Reading the device", 0))
    append(report.findings, try_ordered(order, cancelled));
  if (go_on("Looking for devices", 0.4)) append(report.findings, device_findings(table));
  report.udev = udev_rule();
  append(report.findings, usb_findings());
  if (go_on("Measuring the 1 kHz loop", 0.6))
    append(report.findings, realtime_findings(order.loop_s, cancelled));
  report.findings.push_back(order.graphics);
  report.ended_early = report.ended_early || cancelled();
  report.verdict = report.ended_early ? "The check-up was stopped before it was complete."
                                      : verdict(report.findings, tries || has_force_device(table));
  progress("Done", 1);
  return report;
}

}  // namespace osteon
