#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "cases/open_case.h"
#include "commands/cli_support.h"
#include "commands/commands.h"
#include "commands/number_check.h"
#include "loops/device_log.h"
#include "loops/runtime.h"
#include "loops/stop_signal.h"
#include "runs/demo_path.h"
#include "runs/device_choices.h"
#include "runs/live_run.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

struct LiveOptions {
  std::vector<std::string> devices = {"virtual"};
  std::string case_spec = "builtin:wrist";
  std::string path;
  std::string record;
  std::string force_log;
  double seconds = 0;
  bool free_bones = false;
  MappingSettings mapping;
};

// "phantom" or "phantom:serial".
Result<DeviceChoice> choice_named(const std::string& name) {
  const auto colon = name.find(':');
  const std::string driver = name.substr(0, colon);
  const std::string serial = colon == std::string::npos ? "" : name.substr(colon + 1);
  std::vector<std::string> problems;
  for (const DeviceChoice& choice : list_device_choices(&problems))
    if (choice.driver == driver && (serial.empty() || choice.info.serial == serial)) return choice;
  std::string why;
  for (const std::string& problem : problems) why += "; " + problem;
  return fail("there is no such device" + why, name, "See `osteon devices`");
}

// "run.osr" of the second hand is "run-2.osr".
fs::path numbered(const std::string& file, std::size_t hand) {
  const fs::path path = file;
  if (hand == 0) return path;
  return path.parent_path() /
         (path.stem().string() + "-" + std::to_string(hand + 1) + path.extension().string());
}

// One device with its session, its loops and its thread.
struct Hand {
  DeviceChoice choice;
  DeviceLog* log = nullptr;  ///< of the runtime's device
  std::unique_ptr<Runtime> runtime;
};

DeviceMapping mapping_for(const DeviceChoice& choice, const LiveOptions& options,
                          const Case& the_case) {
  DeviceMapping mapping;
  if (plays_demo(choice)) return mapping;
  // The middle of the workspace is above the middle of the case.
  const Aabb bounds = the_case.bounds_W();
  mapping.X_WV.p = bounds.center() + Vec3(0, 0, 0.5 * bounds.extent().z());
  mapping.X_WV.q = patient_axes();
  mapping.scale = options.mapping.scale;
  return mapping;
}

Result<std::unique_ptr<RecordFeed>> feed_for(const LiveOptions& options, const RunPlan& plan,
                                             std::size_t hand) {
  if (options.record.empty()) return std::unique_ptr<RecordFeed>();
  auto writer = RecordingWriter::create(
      numbered(options.record, hand),
      recording_header(*plan.the_case, plan.settings, options.case_spec, OSTEON_VERSION));
  if (!writer) return tl::unexpected(writer.error());
  return std::make_unique<RecordFeed>(std::move(*writer));
}

// A device that must be calibrated or homed gives no force before, and a gate that trips for it
// stays off: the user follows the device's advice first, without force.
Result<void> wait_for_calibration(HapticDevice& device) {
  const char* told = "";
  bool asked = false;
  for (DeviceSample sample = device.read(); !sample.calibrated && !stop_requested();
       sample = device.read()) {
    if (!sample.connected) return fail(describe(ForceOff::kDisconnect), device.info().name);
    const DeviceHealth health = device.health();
    if (health.calibration == Calibration::kNeeded && !asked) device.calibrate();
    asked = asked || health.calibration == Calibration::kNeeded;
    device.write_force(Vec3::Zero());
    if (*health.advice != 0 && std::strcmp(health.advice, told) != 0) {
      std::printf("%s: %s\n", device.info().name.c_str(), health.advice);
      std::fflush(stdout);
      told = health.advice;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return {};
}

Result<Hand> make_hand(const LiveOptions& options, std::shared_ptr<const Case> the_case,
                       const ProbePath& path, std::size_t index) {
  auto choice = choice_named(options.devices[index]);
  if (!choice) return tl::unexpected(choice.error());
  RunPlan plan;
  plan.the_case = the_case;
  FeelSettings feel;
  feel.bones_held = !options.free_bones;
  auto device = open_choice(*choice, path);
  if (!device) return tl::unexpected(device.error());
  if (auto ready = wait_for_calibration(**device); !ready) return tl::unexpected(ready.error());
  // A list may know less than the open device, which has said what it is.
  plan.settings = settings_for((*device)->info(), feel, options.mapping.scale);
  plan.mapping = mapping_for(*choice, options, *the_case);
  plan.mapping_settings = options.mapping;
  auto feed = feed_for(options, plan, index);
  if (!feed) return tl::unexpected(feed.error());
  Hand hand;
  hand.choice = std::move(*choice);
  auto log = std::make_unique<DeviceLog>(std::move(*device));
  hand.log = log.get();
  hand.runtime = std::make_unique<Runtime>(plan, std::move(log), std::move(*feed));
  return hand;
}

// Until the time is over or a signal asks for the end; what goes wrong meanwhile is told.
void watch(std::vector<Hand>& hands, double seconds) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<ForceOff> told(hands.size(), ForceOff::kSoftware);
  while (!stop_requested()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    if (seconds > 0 && passed.count() >= seconds) return;
    for (std::size_t i = 0; i < hands.size(); ++i) {
      const DeviceStatus& status = hands[i].runtime->device_status();
      Telemetry point;
      while (hands[i].runtime->pop_telemetry(point)) {
      }
      if (status.cause == told[i]) continue;
      told[i] = status.cause;
      std::printf("%6.2f s  %s: %s\n", passed.count(), hands[i].choice.info.name.c_str(),
                  describe(status.cause));
      std::fflush(stdout);
    }
  }
}

void print_summary(const Hand& hand) {
  const LoopStats& stats = hand.runtime->haptic_stats();
  const DeviceStatus& status = hand.runtime->device_status();
  std::printf(
      "%s: %llu ticks at %.0f Hz, p50 %.0f us, p99 %.0f us, longest %.0f us, missed %llu; "
      "energy %.2f mJ, stiffness share %.2f\n",
      hand.choice.info.name.c_str(), static_cast<unsigned long long>(stats.ticks), stats.rate_hz,
      stats.p50_us, stats.p99_us, stats.max_us, static_cast<unsigned long long>(stats.missed),
      status.safety.passivity.energy_j * 1e3, status.safety.passivity.stiffness_share);
}

// Stops every hand before any error is told.
Result<void> stop_all(std::vector<Hand>& hands, const std::string& force_log) {
  Result<void> outcome;
  for (std::size_t i = 0; i < hands.size(); ++i) {
    if (auto stopped = hands[i].runtime->stop(); !stopped) outcome = stopped;
    print_summary(hands[i]);
    hands[i].log->close();
    if (force_log.empty()) continue;
    if (auto saved = hands[i].log->save(numbered(force_log, i)); !saved) outcome = saved;
  }
  return outcome;
}

Result<ProbePath> path_of(const LiveOptions& options, const Case& the_case) {
  if (!options.path.empty()) return load_path(options.path);
  return demo_path(the_case, options.case_spec);
}

int run_live(LiveOptions options) {
  const StopSignals signals;
  options.mapping.axes = MappingAxes::kPatient;
  auto the_case = open_and_show_progress(options.case_spec, CaseParts::kFelt);
  if (!the_case) return report_error(the_case.error());
  const auto path = path_of(options, **the_case);
  if (!path) return report_error(path.error());
  std::vector<Hand> hands;
  for (std::size_t i = 0; i < options.devices.size(); ++i) {
    auto hand = make_hand(options, *the_case, *path, i);
    if (!hand) return report_error(hand.error());
    hands.push_back(std::move(*hand));
  }
  for (Hand& hand : hands) hand.runtime->start();
  std::printf("running; Ctrl-C ends it with the force at zero\n");
  std::fflush(stdout);
  watch(hands, options.seconds);
  const Result<void> ended = stop_all(hands, options.force_log);
  if (!ended) return report_error(ended.error());
  return stop_signal() ? 128 + stop_signal() : kExitDone;
}

}  // namespace

void add_live_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<LiveOptions>();
  CLI::App* command = app.add_subcommand(
      "live", "Run devices on a case in real time, without a window, through the safety stages");
  command
      ->add_option("--device", options->devices,
                   "driver, or driver:serial; give it twice for two hands, each with a session "
                   "and a thread of its own")
      ->capture_default_str();
  command->add_option("--case", options->case_spec, "a case folder, builtin:wrist or builtin:knee")
      ->capture_default_str();
  command->add_option("--path", options->path, "what the virtual hand follows (CSV)");
  command->add_option("--seconds", options->seconds, "then end; 0: until Ctrl-C")
      ->check(refuse_negative);
  command->add_option("--record", options->record, "write a recording (.osr)");
  command->add_option("--force-log", options->force_log,
                      "write the last 20 s of the device's positions and forces (CSV)");
  command->add_option("--scale", options->mapping.scale, "way of the tool for a way of the hand")
      ->check(CLI::Range(kMinScale, kMaxScale));
  command
      ->add_option("--clutch-button", options->mapping.clutch_button,
                   "while it is held the device moves without the tool")
      ->check(CLI::Range(0, 31));
  command->add_flag("--free-bones", options->free_bones, "bones move on springs");
  command->callback([options, &exit_code] { exit_code = run_live(*options); });
}

}  // namespace osteon
