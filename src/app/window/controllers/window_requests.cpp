#include <algorithm>
#include <system_error>

#include "cases/xdg.h"
#include "ui/screenshot.h"
#include "window/controllers/pedal_poll.h"
#include "window/window_app.h"

namespace osteon {
namespace fs = std::filesystem;

void WindowApp::apply(const UiRequests& requests) {
  if (requests.toggle_panels) settings_.panels_open = !settings_.panels_open;
  if (requests.toggle_help) help_open_ = !help_open_;
  if (requests.toggle_fullscreen) window_->toggle_fullscreen();
  if (requests.left_card)
    settings_.left_card = std::clamp(*requests.left_card, static_cast<double>(kLeastLeftCard),
                                     static_cast<double>(kMostLeftCard));
  if (requests.force_off) browser_.close();
  if (requests.force_off) help_open_ = checkup_open_ = patient_open_ = tray_open_ = false;
  if (requests.quit) window_->close();
  if (requests.dismiss_hint) settings_.hint_dismissed = true;
  if (requests.dismiss_toast) toasts_.dismiss(*requests.dismiss_toast);
  if (requests.zoom_interface)
    settings_.interface_zoom =
        std::clamp(settings_.interface_zoom * *requests.zoom_interface, 0.75, 2.5);
  if (requests.cancel_loading && job_) job_->cancel();
  if (requests.retry_loading) open({"builtin:wrist", {}, nullptr});
  apply_browser(requests.browser);
  if (requests.segment_scan) go_to_segmentation();
  apply_checkup(requests);
  apply_patient(requests.patient);
  if (!ready()) return;
  apply_exercise(requests.exercise);
  apply_view(requests);
  apply_views(requests.views);
  if (requests.felt) choose_felt(*requests.felt);
  if (requests.bend) apply_bend(*requests.bend);
  apply_edit(requests.edit);
  apply_run(requests);
  apply_hands(requests.hands);
  apply_replay(requests);
  if (requests.screenshot_window) save_screenshot(true);
  if (requests.screenshot_picture) save_screenshot(false);
}

// A scan may need all memory, and a graphics context is current in one window: that one takes this
// one's place.
void WindowApp::go_to_segmentation() {
  if (live_ && live_->recording())
    return note(ToastKind::kWarning, "Stop the recording before segmenting a scan.");
  wants_segmentation_ = true;
  window_->close();
}

void WindowApp::apply_view(const UiRequests& requests) {
  hovered_row_ = requests.hovered_row;
  if (requests.view) {
    const Camera camera = view_.camera;
    view_ = *requests.view;
    view_.camera = camera;
  }
  if (requests.picked_row.valid())
    picked_ = picked_ == requests.picked_row ? BoneId{} : requests.picked_row;
  if (requests.preset)
    control_.fly_to(view_.camera,
                    preset_camera(*requests.preset, *case_, viewport().aspect(), covered_edges()));
  if (requests.close_up)
    control_.fly_to(view_.camera, close_up_camera(view_.camera, *case_, picked_,
                                                  viewport().aspect(), covered_edges()));
}

void WindowApp::apply_run(const UiRequests& requests) {
  if (!live_) return;
  for (const Command& command : requests.commands) live_->set_feel(command);
  if (requests.force_off) {
    probe_toggled_ = false;
    if (live_->choice().info.peak_force_n > 0) live_->set_force(false);
  }
  if (requests.force_on && !bend_) live_->resume();
  if (requests.toggle_probe) probe_toggled_ = !probe_toggled_;
  if (checkup_) return;  // it may have the device
  if (requests.toggle_record && exercise_.page() == ExercisePage::kRunning)
    end_exercise();
  else if (requests.toggle_record)
    toggle_recording();
  apply_device(requests);
  if (!requests.device || live_->recording()) return;
  const auto index = static_cast<std::size_t>(*requests.device);
  if (index >= choices_.size()) return;
  settings_.device = key_of(choices_[index]);
  start_live(settings_.device);
}

void WindowApp::apply_device(const UiRequests& requests) {
  if (requests.calibrate) live_->calibrate();
  if (requests.mapping && !live_->recording()) {
    settings_.mappings[mapping_key(live_->choice().info, case_->name)] = *requests.mapping;
    mapping_changed_s_ = now_s_;
  }
  // Takes effect with a new run, once the slider has come to rest.
  if (mapping_changed_s_ >= 0 && !ImGui::IsAnyMouseDown()) {
    mapping_changed_s_ = -1;
    const MappingSettings user =
        mapping_of(settings_.mappings, mapping_key(live_->choice().info, case_->name));
    const Result<void> changed = live_->change_mapping(user, view_.camera.q_WC);
    if (!changed) note(ToastKind::kError, changed.error().message());
  }
  if (requests.learn_pedal) {
    learning_pedal_ = *requests.learn_pedal;
    learning_from_ = read_pedals(window_->handle());
  }
  if (requests.forget_pedal) {
    settings_.pedals.erase(*requests.forget_pedal);
    pedals_.set_map(settings_.pedals);
  }
}

void WindowApp::learn_pedal(const PedalReadings& now) {
  if (learning_pedal_.empty()) return;
  const auto moved = moved_input(learning_from_, now);
  if (!moved) return;
  settings_.pedals[learning_pedal_] = *moved;
  pedals_.set_map(settings_.pedals);
  learning_pedal_.clear();
}

void WindowApp::apply_replay(const UiRequests& requests) {
  if (!player_) return;
  if (requests.toggle_play) player_->toggle();
  if (requests.seek_s) player_->seek(*requests.seek_s);
  if (requests.speed) player_->set_speed(*requests.speed);
  if (requests.close_replay) leave_replay();
}

void WindowApp::toggle_recording() {
  if (live_->recording()) {
    const fs::path file = live_->recording_file();
    const Result<void> stopped = live_->stop_recording();
    if (stopped)
      note(ToastKind::kInfo, "Saved as " + file.string());
    else
      note(ToastKind::kError, stopped.error().message());
    return;
  }
  const Result<void> started =
      live_->start_recording(dated_file(data_home_dir() / "recordings", "wrist", ".osr"));
  if (!started) note(ToastKind::kError, started.error().message());
}

void WindowApp::save_screenshot(bool whole_window) {
  const fs::path folder = data_home_dir() / "pictures";
  std::error_code ec;
  fs::create_directories(folder, ec);
  const fs::path file = dated_file(folder, "osteon", ".png");
  int width = 0, height = 0;
  window_->framebuffer_size(width, height);
  const Viewport v = viewport();
  const Image image =
      whole_window ? read_framebuffer(width, height)
                   : renderer_->draw_image(shown_, picture_view(), 2 * v.width, 2 * v.height);
  const Result<void> saved = save_png(image, file);
  if (saved)
    note(ToastKind::kInfo, "Saved as " + file.string());
  else
    note(ToastKind::kError, saved.error().message());
}

}  // namespace osteon
