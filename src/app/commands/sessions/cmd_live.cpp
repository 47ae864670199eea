#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>
#include "commands/support/parser.h"

#include "cases/open_case.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/force_order.h"
#include "commands/support/number_check.h"
#include "commands/support/session_options.h"
#include "loops/device_log.h"
#include "loops/runtime.h"
#include "loops/stop_signal.h"
#include "osteon/physics/soft_setup.h"
#include "osteon/scene/carve_events.h"
#include "runs/hands/device_choices.h"
#include "runs/hands/hand_order.h"
#include "runs/hands/live_run.h"
#include "runs/hands/tray.h"
#include "runs/replays/demo_path.h"
#include "runs/replays/path_orders.h"

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
  double power = 0;
  std::string portals = "all";
  std::string soft;
  bool structures = false;
  double guided_n = 0, irrigation_ml_per_min = 0;
  MappingSettings mapping;
};

// "force.csv" of the second hand is "force-2.csv".
fs::path numbered(const std::string& file, std::size_t hand) {
  const fs::path path = file;
  if (hand == 0) return path;
  return path.parent_path() /
         (path.stem().string() + "-" + std::to_string(hand + 1) + path.extension().string());
}

// The hands of a run: each with its device, all in one world.
struct LiveHands {
  std::vector<HandOrder> hands;
  std::vector<DeviceChoice> choices;
  std::vector<DeviceLog*> logs;  ///< of the runtime's devices
  std::vector<HandPlan> plans;
  RunPlan run;
  std::vector<std::optional<PathOrders>> orders;  ///< none: nobody follows a path there
  std::unique_ptr<Runtime> runtime;
};

// Hands lie side by side, so that two devices begin apart.
DeviceMapping mapping_for(const DeviceChoice& choice, const LiveOptions& options,
                          const Case& the_case, std::size_t hand) {
  constexpr double kApart_m = 0.020;
  DeviceMapping mapping;
  if (plays_demo(choice)) return mapping;
  // The middle of the workspace is above the middle of the case.
  const Aabb bounds = the_case.bounds_W();
  mapping.X_WV.p = bounds.center() + Vec3(0, 0, 0.5 * bounds.extent().z());
  mapping.X_WV.p.x() += kApart_m * (static_cast<double>(hand) -
                                    0.5 * static_cast<double>(options.devices.size() - 1));
  mapping.X_WV.q = patient_axes();
  mapping.scale = options.mapping.scale;
  return mapping;
}

Result<std::unique_ptr<RecordFeed>> feed_for(const LiveOptions& options, const RunPlan& plan,
                                             const Tray& tray) {
  if (options.record.empty()) return std::unique_ptr<RecordFeed>();
  RecordingHeader header =
      recording_header(*plan.the_case, plan.settings, options.case_spec, OSTEON_VERSION, tray);
  header.case_path = absolute_case_path(options.case_spec);
  auto writer = RecordingWriter::create(options.record, header);
  if (!writer) return tl::unexpected(writer.error());
  return std::make_unique<RecordFeed>(std::move(*writer), 8.0, plan.settings.hands.size());
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

Result<void> add_hand(const LiveOptions& options, const ProbePath& path, std::size_t index,
                      LiveHands& live) {
  live.hands.push_back(parse_hand_order(options.devices[index]));
  auto choice = choice_of(live.hands.back(), live.choices);
  if (!choice) return tl::unexpected(choice.error());
  auto device = open_choice(*choice, path);
  if (!device) return tl::unexpected(device.error());
  if (auto ready = wait_for_calibration(**device); !ready) return tl::unexpected(ready.error());
  FeelSettings feel;
  feel.bones_held = !options.free_bones;
  // A list may know less than the open device, which has said what it is.
  const SessionSettings settings = settings_for((*device)->info(), feel, options.mapping.scale);
  if (index == 0) live.run.settings = settings;
  keep_to_weakest(settings.haptic, live.run.settings.haptic);
  auto log = std::make_unique<DeviceLog>(std::move(*device));
  live.logs.push_back(log.get());
  HandPlan plan;
  plan.device = std::move(log);
  plan.mapping = mapping_for(*choice, options, *live.run.the_case, index);
  plan.mapping_settings = options.mapping;
  plan.freezes = !plays_demo(*choice);
  live.plans.push_back(std::move(plan));
  live.choices.push_back(std::move(*choice));
  return {};
}

// A hand takes what it was told to, else what its path names first, else the wrist probe.
std::vector<std::string> instruments_for(const HandOrder& order, const ProbePath* path) {
  if (!order.instrument.empty()) return {order.instrument};
  if (!path || !path->with_instruments) return {kWristProbe};
  return instruments_of(*path);
}

std::uint32_t place_in(std::vector<std::string>& tray, const std::string& name) {
  auto place = std::find(tray.begin(), tray.end(), name);
  if (place == tray.end()) place = tray.insert(place, name);
  return static_cast<std::uint32_t>(place - tray.begin());
}

// Who follows a path is told by it what to hold, and how the pedal stands.
void give_orders(LiveHands& live, const ProbePath& path) {
  const SessionSettings& settings = live.run.settings;
  for (std::size_t h = 0; h < live.hands.size(); ++h) {
    live.orders.emplace_back();
    if (!plays_demo(live.choices[h]) || !path.with_instruments) continue;
    const bool told = !live.hands[h].instrument.empty();
    live.orders.back().emplace(told ? without_instruments(path) : path, settings.tray,
                               settings.haptic.tick_s);
  }
}

Result<Tray> give_instruments(LiveHands& live, const ProbePath& path) {
  SessionSettings& settings = live.run.settings;
  settings.hands.clear();
  for (std::size_t h = 0; h < live.hands.size(); ++h) {
    const HandOrder& order = live.hands[h];
    const ProbePath* follows = plays_demo(live.choices[h]) ? &path : nullptr;
    const std::vector<std::string> names = instruments_for(order, follows);
    for (const std::string& name : names) (void)place_in(settings.tray, name);
    settings.hands.push_back(
        {name_of_hand(order, h, live.hands.size()), place_in(settings.tray, names.front())});
  }
  give_orders(live, path);
  if (settings.tray == std::vector<std::string>{kWristProbe}) settings.tray.clear();
  settings.carve.on = can_carve(*live.run.the_case, settings.tray);
  if (auto sound = check_settings(settings); !sound) return tl::unexpected(sound.error());
  return make_tray(settings.tray, settings.probe_radius_m);
}

Result<LiveHands> make_hands(const LiveOptions& options, std::shared_ptr<const Case> the_case,
                             const ProbePath& path) {
  LiveHands live;
  live.run.the_case = std::move(the_case);
  if (options.devices.size() > kMaxHands)
    return fail("a session has at most four hands", "--device", "Give fewer");
  for (std::size_t i = 0; i < options.devices.size(); ++i)
    if (auto done = add_hand(options, path, i, live); !done) return tl::unexpected(done.error());
  auto tray = give_instruments(live, path);
  if (!tray) return tl::unexpected(tray.error());
  if (auto open = open_in_skin(options.portals, live.run.settings); !open)
    return tl::unexpected(open.error());
  if (auto portals = open_portals(*live.run.the_case, live.run.settings); !portals)
    return tl::unexpected(portals.error());
  live.run.settings.soft = softs_named(options.soft);
  live.run.settings.soft_structures = !live.run.the_case->softs.empty();
  auto softs = softs_for(*live.run.the_case, live.run.settings);
  if (!softs) return tl::unexpected(softs.error());
  if (*softs) live.run.settings.soft_hash = (*softs)->hash;
  live.run.softs = std::move(*softs);
  live.run.settings.carve.guided_n = options.guided_n;
  live.run.settings.carve.irrigation_ml_per_min = options.irrigation_ml_per_min;
  auto carving = carving_for(*live.run.the_case, live.run.settings);
  if (!carving) return tl::unexpected(carving.error());
  live.run.carving = std::move(*carving);
  auto feed = feed_for(options, live.run, *tray);
  if (!feed) return tl::unexpected(feed.error());
  live.runtime = std::make_unique<Runtime>(live.run, std::move(live.plans), std::move(*feed),
                                           std::move(*tray));
  return live;
}

std::vector<std::string> names_of(const LiveHands& live) {
  std::vector<std::string> names;
  for (const HandSettings& hand : live.run.settings.hands) names.push_back(hand.name);
  return names;
}

// What the user types. A fault latches: a hand's force comes back by the user's word alone.
void obey_line(LiveHands& live, const std::string& line) {
  if (line.find_first_not_of(" \t\r") == std::string::npos) return;
  const auto order = parse_force_order(line, names_of(live));
  if (!order) {
    std::printf("%s\n", order.error().message().c_str());
  } else if (order->hand) {
    live.runtime->set_force_enabled(order->on, *order->hand);
  } else {
    live.runtime->set_force_enabled(order->on);
  }
  std::fflush(stdout);
}

// "left (PHANToM Omni)"; a hand alone has its device's name.
std::string told_name(const LiveHands& live, std::size_t hand) {
  const std::string& device = live.choices[hand].info.name;
  const std::string& name = live.run.settings.hands[hand].name;
  return name.empty() ? device : name + " (" + device + ")";
}

// What happens to bone; the rest is in the recording.
void tell_carving(LiveHands& live, std::size_t hand) {
  const SessionSettings& settings = live.run.settings;
  Event event;
  while (live.runtime->pop_event(event, hand)) {
    const int code = static_cast<int>(event.kind);
    const EventKindRow* row = find_event_kind(event.kind);
    const bool carving = code >= static_cast<int>(kCutBegin) && code < 300;
    if (!row || !carving || event.subject >= live.run.the_case->bones.size()) continue;
    const std::string& name = settings.hands[hand].name;
    std::printf("%6.2f s  %s%s%s %s\n", static_cast<double>(event.tick) * settings.haptic.tick_s,
                name.c_str(), name.empty() ? "" : ": ", std::string(row->text).c_str(),
                live.run.the_case->bones[event.subject].name.c_str());
    std::fflush(stdout);
  }
}

void send_orders(LiveHands& live, std::size_t hand) {
  const std::uint64_t tick = live.runtime->snapshot(hand).tool.tick;
  if (!live.orders[hand] || tick == 0) return;
  if (const auto command = live.orders[hand]->at(tick)) (void)live.runtime->send(*command, hand);
}

// Until the time is over or a signal asks for the end; what goes wrong meanwhile is told.
void watch(LiveHands& live, double seconds) {
  const auto start = std::chrono::steady_clock::now();
  Runtime& runtime = *live.runtime;
  std::vector<ForceOff> told(runtime.hands(), ForceOff::kSoftware);
  InputLines lines;
  while (!stop_requested()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    if (seconds > 0 && passed.count() >= seconds) return;
    if (const auto line = lines.next()) obey_line(live, *line);
    for (std::size_t i = 0; i < runtime.hands(); ++i) {
      const DeviceStatus& status = runtime.device_status(i);
      send_orders(live, i);
      tell_carving(live, i);
      Telemetry point;
      while (runtime.pop_telemetry(point, i)) {
      }
      if (status.cause == told[i]) continue;
      told[i] = status.cause;
      std::printf("%6.2f s  %s: %s\n", passed.count(), told_name(live, i).c_str(),
                  describe(status.cause));
      std::fflush(stdout);
    }
  }
}

void print_summary(LiveHands& live, std::size_t hand) {
  const LoopStats& stats = live.runtime->haptic_stats(hand);
  const DeviceStatus& status = live.runtime->device_status(hand);
  std::printf(
      "%s: %llu ticks at %.0f Hz, p50 %.0f us, p99 %.0f us, longest %.0f us, missed %llu; "
      "energy %.2f mJ, stiffness share %.2f\n",
      live.choices[hand].info.name.c_str(), static_cast<unsigned long long>(stats.ticks),
      stats.rate_hz, stats.p50_us, stats.p99_us, stats.max_us,
      static_cast<unsigned long long>(stats.missed), status.safety.passivity.energy_j * 1e3,
      status.safety.passivity.stiffness_share);
}

// Stops every hand before any error is told.
Result<void> stop_all(LiveHands& live, const std::string& force_log) {
  Result<void> outcome = live.runtime->stop();
  for (std::size_t i = 0; i < live.logs.size(); ++i) {
    print_summary(live, i);
    live.logs[i]->close();
    if (force_log.empty()) continue;
    if (auto saved = live.logs[i]->save(numbered(force_log, i)); !saved) outcome = saved;
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
  auto the_case = open_and_show_progress(
      options.case_spec,
      options.soft.empty() && !options.structures ? CaseParts::kFelt : CaseParts::kAll);
  if (!the_case) return report_error(the_case.error());
  const auto path = path_of(options, **the_case);
  if (!path) return report_error(path.error());
  auto live = make_hands(options, *the_case, *path);
  if (!live) return report_error(live.error());
  live->runtime->start();
  if (options.power > 0)
    for (std::size_t h = 0; h < live->runtime->hands(); ++h)
      (void)live->runtime->send({CommandKind::kPower, options.power}, h);
  std::printf("running; Ctrl-C switches the force off and ends the run\n");
  std::printf("If the force switches off, type `on` and Enter to switch it on again%s\n",
              live->runtime->hands() > 1 ? ", or `on left`, `on right` for one hand" : "");
  std::fflush(stdout);
  watch(*live, options.seconds);
  const Result<void> ended = stop_all(*live, options.force_log);
  if (!ended) return report_error(ended.error());
  return stop_signal() ? 128 + stop_signal() : kExitDone;
}

}  // namespace

void add_live_command(cli::App& app, int& exit_code) {
  const auto options = std::make_shared<LiveOptions>();
  cli::App* command = app.add_subcommand(
      "live", "Run devices on a case in real time, without a window, through the safety stages");
  command
      ->add_option("--device", options->devices,
                   "driver, driver:serial or driver:left (right, third, fourth), then =INSTRUMENT; "
                   "may be given for up to four hands")
      ->capture_default_str();
  command->add_option("--case", options->case_spec, "a case folder, builtin:wrist or builtin:knee")
      ->capture_default_str();
  command->add_option("--path", options->path, "probe path for the virtual hand (CSV)");
  command->add_option("--seconds", options->seconds, "length of the run, s; 0: until Ctrl-C")
      ->check(refuse_negative);
  command->add_option("--record", options->record, "write a recording (.osr)");
  command->add_option("--force-log", options->force_log,
                      "write the last 20 s of the device's positions and forces (CSV)");
  command
      ->add_option("--scale", options->mapping.scale,
                   "movement of the tool per movement of the hand")
      ->check(cli::Range(kMinScale, kMaxScale));
  command
      ->add_option("--clutch-button", options->mapping.clutch_button,
                   "number of the button that lets the device move without the tool")
      ->check(cli::Range(0, 31));
  add_portals_option(*command, options->portals);
  add_soft_option(*command, options->soft);
  add_structures_option(*command, options->structures);
  add_guided_option(*command, options->guided_n);
  add_irrigation_option(*command, options->irrigation_ml_per_min);
  command
      ->add_option("--power", options->power,
                   "power of the hands' instruments from the start, 0 to 1; a path sets its own")
      ->check(cli::Range(0.0, 1.0));
  command->add_flag("--free-bones", options->free_bones, "bones move on springs");
  command->callback([options, &exit_code] { exit_code = run_live(*options); });
}

}  // namespace osteon
