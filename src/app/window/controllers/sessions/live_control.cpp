#include "window/controllers/sessions/live_control.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <utility>

#include "cases/xdg.h"
#include "osteon/base/file.h"
#include "runs/hands/hand_order.h"
#include "runs/replays/path_commands.h"
#include "window/controllers/views/scene_poll.h"

namespace osteon {
namespace {

constexpr double kApartOrdered_m = 0.025;  // between hands when they come in

// What hands are told to hold, and what the path that an emulated one plays takes.
std::vector<std::string> ordered_instruments(const WindowOrder& order) {
  std::vector<std::string> names;
  for (const std::string& device : order.devices)
    names.push_back(parse_hand_order(device).instrument);
  const auto path = order.path.empty() ? Result<ProbePath>(ProbePath{}) : load_path(order.path);
  if (path && path->with_instruments)
    for (const std::string& name : instruments_of(*path)) names.push_back(name);
  return names;
}

}  // namespace

void LiveControl::list_devices() {
  std::vector<std::string> problems;
  choices_ = list_device_choices(&problems);
  for (const std::string& problem : problems) host_.note(ToastKind::kWarning, problem);
  wanted_ = ordered_instruments(host_.order);
}

void LiveControl::make_tray() {
  const std::string region = region_of(*scene_.the_case);
  if (region != tray_region_ || wanted_ != tray_wanted_) take_tray(prepare_tray(region, wanted_));
  sight_.set_tray(tray_.run().names, tray_.run().tools, tray_.instruments());
}

void LiveControl::take_tray(PreparedTray tray) {
  if (!tray.problem.empty()) host_.note(ToastKind::kError, tray.problem);
  tray_ = std::move(tray.tray);
  tray_region_ = std::move(tray.region);
  tray_wanted_ = std::move(tray.wanted);
}

void LiveControl::make_run() {
  remember_feel();
  const AppSettings& settings = host_.settings;
  const FeelSettings feel{settings.stiffness_n_per_m, settings.friction_scale, settings.bones_held};
  RunTray tray = tray_.run();
  tray.carving = scene_.carving;
  tray.carve = scene_.carve;
  tray.softs = scene_.softs;
  run_ = std::make_unique<LiveRun>(scene_.the_case, scene_.source, tray_.sized(scene_.demo), feel,
                                   std::move(tray));
  ++runs_made_;
  run_->keep_force_log(host_.order.force_log);
  pedals_.begin();
}

void LiveControl::drop() {
  remember_feel();
  run_.reset();
}

void LiveControl::remember_feel() {
  if (!run_) return;
  host_.settings.stiffness_n_per_m = run_->feel().stiffness_n_per_m;
  host_.settings.friction_scale = run_->feel().friction_scale;
  host_.settings.bones_held = run_->feel().bones_held;
}

MappingSettings LiveControl::mapping_for(const DeviceChoice& choice) const {
  return mapping_of(host_.settings.mappings, mapping_key(choice.info, scene_.the_case->name));
}

void LiveControl::begin() {
  WindowOrder& order = host_.order;
  if (!order.path.empty()) {
    const auto path = load_path(order.path);
    if (path) scene_.demo = *path;
    if (!path) host_.note(ToastKind::kError, path.error().message());
  }
  const std::vector<std::string> devices = std::exchange(order.devices, {});
  if (devices.empty() || !start_ordered(devices))
    start(order.demo ? "virtual" : host_.settings.device);
  if (!run_ || order.record.empty()) return;
  const Result<void> started = run_->start_recording(std::exchange(order.record, {}));
  if (!started) host_.note(ToastKind::kError, started.error().message());
}

// As the command line orders them. False when one cannot be had: the reason is told.
bool LiveControl::start_ordered(const std::vector<std::string>& devices) {
  std::vector<HandOrder> orders;
  for (const std::string& text : devices) orders.push_back(parse_hand_order(text));
  make_tray();
  std::vector<LiveHandOrder> hands;
  std::vector<DeviceChoice> taken;
  std::vector<Pose> poses;
  const Camera& camera = sight_.view().camera;
  const Pose offered = offered_probe(camera, scene_.the_case->bounds_W());
  for (std::size_t i = 0; i < orders.size(); ++i) {
    auto choice = choice_of(orders[i], taken);
    if (!choice) {
      host_.note(ToastKind::kError, choice.error().message());
      return false;
    }
    taken.push_back(*choice);
    hands.push_back({*choice, name_of_hand(orders[i], i, orders.size()),
                     tray_.find(orders[i].instrument).value_or(0), mapping_for(*choice)});
    const double right_m =
        kApartOrdered_m * (static_cast<double>(i) - 0.5 * static_cast<double>(orders.size() - 1));
    poses.push_back({offered.p + right_m * (camera.q_WC * Vec3::UnitX()), offered.q});
  }
  make_run();
  const Result<void> started = run_->start(hands, poses, camera.q_WC);
  if (!started) host_.note(ToastKind::kError, started.error().message());
  return started.has_value();
}

void LiveControl::start(const std::string& device) {
  if (choices_.empty() || !scene_.the_case) return;
  make_tray();
  make_run();
  const Camera& camera = sight_.view().camera;
  const DeviceChoice& choice = choices_[static_cast<std::size_t>(find_choice(choices_, device))];
  const Result<void> started = run_->start(
      choice, offered_probe(camera, scene_.the_case->bounds_W()), mapping_for(choice), camera.q_WC);
  if (!started) host_.note(ToastKind::kError, started.error().message());
}

Result<void> LiveControl::start_placed(const std::vector<PlacedHand>& hands) {
  make_tray();
  make_run();
  const int chosen = find_choice(choices_, host_.settings.device);
  const DeviceChoice& choice = choices_[static_cast<std::size_t>(chosen)];
  const std::size_t at_once = choice.driver == "mouse" ? hands.size() : 1;
  std::vector<LiveHandOrder> orders;
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < at_once; ++i) {
    orders.push_back({choice, hands.size() > 1 ? hands[i].name : std::string(),
                      tray_.find(hands[i].instrument).value_or(0), mapping_for(choice)});
    poses.push_back(hands[i].X_WD);
  }
  auto started = run_->start(orders, poses, sight_.view().camera.q_WC);
  for (std::size_t i = at_once; i < hands.size() && started; ++i)
    started = run_->add_hand(hands[i].X_WD, tray_.find(hands[i].instrument).value_or(0));
  return started;
}

void LiveControl::hold_probe(bool held) {
  if (held == probe_held_) return;
  probe_held_ = held;
  // The pointer must not stop at the window's edge while it moves the probe.
  glfwSetInputMode(host_.window->handle(), GLFW_CURSOR,
                   held ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
  host_.ui->take_pointer(held);
}

void LiveControl::update(bool power_key, double dt_s) {
  const Camera& camera = sight_.view().camera;
  run_->move_pad(read_gamepad(), camera, dt_s);
  run_->tell_hand(pedals_.poll(), camera);
  run_->drive(std::max(power_key ? 1.0 : 0.0, pedals_.power()));
  run_->update();
  sight_.shown() = run_->snapshot();
  if (const std::string why = run_->take_recording_failure(); !why.empty())
    host_.note(ToastKind::kError, why);
  // Who holds no instrument did nothing: a patient was being opened, or a key brought the hand.
  if (const std::string why = run_->take_harmless_trip(); !why.empty() && probe_held())
    host_.note(ToastKind::kInfo, why);
}

void LiveControl::apply_feel(const UiRequests& requests, bool may_resume) {
  if (!run_) return;
  for (const Command& command : requests.commands) run_->set_feel(command);
  if (requests.force_off) {
    probe_toggled_ = false;
    if (run_->choice().info.peak_force_n > 0) run_->set_force(false);
  }
  if (requests.force_on && may_resume) run_->resume();
  if (!requests.toggle_probe) return;
  probe_toggled_ = !probe_toggled_;
  if (probe_toggled_) bring_into_picture();
}

// Whoever takes an instrument that the picture does not show could not tell where it went.
void LiveControl::bring_into_picture() {
  const Camera& camera = sight_.view().camera;
  if (!run_->by_mouse() || !(sight_.hand_camera() == camera)) return;
  if (!shows(camera, sight_.hand_viewport().aspect(), run_->snapshot().tool.X_WP.p))
    run_->bring(probe_in_picture(camera, scene_.the_case->bounds_W()));
}

void LiveControl::apply_device(const UiRequests& requests) {
  if (!run_) return;
  if (requests.calibrate) run_->calibrate();
  apply_mapping(requests);
  pedals_.apply(requests);
  if (!requests.device || run_->recording()) return;
  const auto index = static_cast<std::size_t>(*requests.device);
  if (index >= choices_.size()) return;
  host_.settings.device = key_of(choices_[index]);
  start(host_.settings.device);
}

// Takes effect with a new run, once the slider has come to rest.
void LiveControl::apply_mapping(const UiRequests& requests) {
  const std::string key = mapping_key(run_->choice().info, scene_.the_case->name);
  if (requests.mapping && !run_->recording()) {
    host_.settings.mappings[key] = *requests.mapping;
    mapping_changed_s_ = host_.now_s;
  }
  if (mapping_changed_s_ < 0 || ImGui::IsAnyMouseDown()) return;
  mapping_changed_s_ = -1;
  const MappingSettings user = mapping_of(host_.settings.mappings, key);
  const Result<void> changed = run_->change_mapping(user, sight_.view().camera.q_WC);
  if (!changed) host_.note(ToastKind::kError, changed.error().message());
}

void LiveControl::toggle_recording() {
  if (!run_) return;
  if (run_->recording()) {
    const std::filesystem::path file = run_->recording_file();
    const Result<void> stopped = run_->stop_recording();
    if (stopped)
      host_.note(ToastKind::kInfo, "Saved as " + file.string());
    else
      host_.note(ToastKind::kError, stopped.error().message());
    return;
  }
  const Result<void> started =
      run_->start_recording(dated_file(data_home_dir() / "recordings", "wrist", ".osr"));
  if (!started) host_.note(ToastKind::kError, started.error().message());
}

}  // namespace osteon
