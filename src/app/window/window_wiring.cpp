// What the panels show, gathered from the controllers, and what the user asked for, handed to them.
#include <algorithm>
#include <system_error>

#include "cases/xdg.h"
#include "osteon/render/anatomical_view.h"
#include "osteon/scene/tool_moment.h"
#include "ui/label.h"
#include "ui/screenshot.h"
#include "window/window_app.h"

namespace osteon {
namespace {

std::string title_of(const Case& the_case) {
  std::string title = label_of(the_case.name);
  if (!the_case.side.empty() && title.find(the_case.side) == std::string::npos)
    title += ", " + the_case.side;
  return title;
}

void describe_case(const Case& the_case, UiModel& model) {
  model.case_title = title_of(the_case);
  model.is_knee = the_case.find("femur").valid();
  model.is_box = !anatomical_frame(the_case).from_bones;
  for (const Bone& bone : the_case.bones) {
    model.bone_labels.push_back(label_of(bone.name));
    model.bone_felt.push_back(bone.felt);
  }
  for (const SoftPart& soft : the_case.softs) model.soft_labels.push_back(label_of(soft.name));
}

// Forces of the contacts with one bone, added up.
std::vector<ContactRow> contact_rows(const ToolState& tool) {
  std::vector<ContactRow> rows;
  for (std::uint32_t i = 0; i < std::min<std::uint32_t>(tool.contact_count, kMaxContacts); ++i) {
    const Contact& contact = tool.contacts[i];
    const double force_n = contact.force_on_tool_W.norm();
    const auto same = std::find_if(rows.begin(), rows.end(),
                                   [&](const ContactRow& row) { return row.bone == contact.bone; });
    if (same != rows.end())
      same->force_n += force_n;
    else
      rows.push_back(
          {contact.bone, force_n, contact.depth_m * 1e3, (tool.status & kTickSticking) != 0});
  }
  return rows;
}

// What that hand presses and pulls of the soft parts, and what of them has been cut.
std::vector<SoftRow> soft_rows(const SoftPushes& pushes, std::size_t hand) {
  std::vector<SoftRow> rows;
  for (std::uint32_t i = 0; i < pushes.load_count; ++i) {
    const SoftLoad& load = pushes.loads[i];
    const double force_n = load.force_n[hand];
    if (force_n > 0 || load.left < 1)
      rows.push_back({load.soft, force_n, load.tension_n, load.left});
  }
  return rows;
}

// What the instrument that the picture shows bears at its grip.
void tell_torque(const ToolState& state, const Tray& tray, std::span<const Portal> portals,
                 HandModel& hand) {
  if (state.instrument >= tray.size()) return;
  const Tool& tool = *tray[state.instrument];
  hand.has_lever = tool.shaft.radius > 0;
  hand.torque_nm = moment_at_grip(state, tool, portals).norm();
}

}  // namespace

UiModel WindowApp::build_model() {
  UiModel model;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  model.width = size.x;
  model.height = size.y;
  model.scale = host_.ui->scale();
  model.exercise = exercise_.model();
  host_.exercise_runs = model.exercise.page == ExercisePage::kRunning ||
                        model.exercise.page == ExercisePage::kJudging;
  model.left_card = host_.left_card();
  model.toasts = host_.toasts.shown();
  model.panels_open = host_.settings.panels_open;
  model.help_open = help_open_;
  model.browser = browser_.model();
  model.first_run_hint = !host_.settings.hint_dismissed && !replay_.on() && host_.order.frames == 0;
  if (!cases_.ready()) {
    cases_.describe_loading(model);
    return model;
  }
  describe_case(*scene_.the_case, model);
  sight_.describe(model);
  live_.describe(model);
  replay_.describe(model);
  cases_.describe(model);
  marks_.update();
  run_news_.update();
  model.timeline.marks = marks_.all();
  model.contacts = contact_rows(sight_.shown().tool);
  model.soft_rows = live_.run() ? soft_rows(live_.run()->pushes(), live_.run()->active())
                                : soft_rows(replay_.pushes(), 0);
  tell_torque(sight_.shown().tool, replay_.on() ? replay_.replay()->tray : live_.tray().run().tools,
              replay_.on() ? replay_.replay()->portals : scene_.portals, model.hand);
  model.checkup = checkup_.model();
  model.edit = edit_.model();
  model.patient = patient_.model();
  model.joints = bend_.model();
  model.can_bend = may_change_case();
  model.notes = notes_.model(may_change_case());
  model.hands = hands_.model(!checkup_.running(), exercise_.used_by_active_hand());
  model.views = views_.model();
  model.views.film = film_.model();
  model.views.sound = sound_.model();
  model.hand.picture_hz = frames_.rate_hz();
  return model;
}

// Neither a replay, a recording, an edit nor a check-up needs it as it is.
bool WindowApp::may_change_case() const {
  return live_.run() && !live_.recording() && !edit_.on() && !checkup_.running();
}

void WindowApp::apply(const UiRequests& requests) {
  apply_window(requests);
  if (requests.cancel_loading) cases_.cancel();
  if (requests.retry_loading) cases_.open({"builtin:wrist", {}, nullptr});
  browser_.apply(requests.browser);
  if (requests.segment_scan) browser_.go_to_segmentation();
  checkup_.apply(requests);
  patient_.apply(requests.patient);
  if (cases_.ready()) apply_scene(requests);
}

void WindowApp::apply_window(const UiRequests& requests) {
  AppSettings& settings = host_.settings;
  if (requests.toggle_panels) settings.panels_open = !settings.panels_open;
  if (requests.toggle_help) help_open_ = !help_open_;
  if (requests.toggle_fullscreen) host_.window->toggle_fullscreen();
  if (requests.left_card)
    settings.left_card = std::clamp(*requests.left_card, static_cast<double>(kLeastLeftCard),
                                    static_cast<double>(kMostLeftCard));
  if (requests.force_off) {
    help_open_ = false;
    browser_.close();
    checkup_.close();
    patient_.close();
    hands_.close_tray();
    notes_.stop_placing();
    exercise_.close_page();
    exercise_.forget_force();
  }
  if (requests.quit) host_.window->close();
  if (requests.dismiss_hint) settings.hint_dismissed = true;
  if (requests.dismiss_toast) host_.toasts.dismiss(*requests.dismiss_toast);
  if (requests.zoom_interface)
    settings.interface_zoom =
        std::clamp(settings.interface_zoom * *requests.zoom_interface, 0.75, 2.5);
}

// A controller may begin to open another case: those after it then act on the one still on show.
void WindowApp::apply_scene(const UiRequests& requests) {
  exercise_.apply(requests.exercise);
  sight_.apply(requests);
  views_.apply(requests.views);
  if (requests.views.toggle_film) film_.toggle();
  sound_.apply(requests.views);
  if (requests.felt) cases_.choose_felt(*requests.felt);
  if (requests.bend && may_change_case()) bend_.apply(*requests.bend);
  notes_.apply(requests.notes, may_change_case());
  edit_.apply(requests.edit);
  live_.apply_feel(requests, !bend_.on() && !exercise_.paused());
  if (!checkup_.running()) {  // it may have the device
    if (requests.toggle_record && exercise_.running())
      exercise_.ask_to_end();
    else if (requests.toggle_record)
      live_.toggle_recording();
    live_.apply_device(requests);
  }
  if (hands_.apply(requests.hands, !checkup_.running() && !edit_.on())) exercise_.count_undo();
  if (replay_.apply(requests)) {
    replay_.end();
    scene_.renderer->clear_cubes();
    live_.start(host_.settings.device);
  }
  if (requests.screenshot_window) save_screenshot(true);
  if (requests.screenshot_picture) save_screenshot(false);
}

void WindowApp::save_screenshot(bool whole_window) {
  const std::filesystem::path folder = data_home_dir() / "pictures";
  std::error_code ec;
  std::filesystem::create_directories(folder, ec);
  const std::filesystem::path file = dated_file(folder, "osteon", ".png");
  const auto size = host_.pixels();
  const Viewport v = sight_.viewport();
  const Image image = whole_window ? read_framebuffer(size.width, size.height)
                                   : scene_.renderer->draw_image(sight_.shown(), picture_view(),
                                                                 2 * v.width, 2 * v.height);
  const Result<void> saved = save_png(image, file);
  if (saved)
    host_.note(ToastKind::kInfo, "Saved as " + file.string());
  else
    host_.note(ToastKind::kError, saved.error().message());
}

}  // namespace osteon
