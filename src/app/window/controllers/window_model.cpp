#include <algorithm>

#include "ui/label.h"
#include "window/window_app.h"

namespace osteon {
namespace {

std::string title_of(const Case& the_case) {
  std::string title = label_of(the_case.name);
  if (!the_case.side.empty() && title.find(the_case.side) == std::string::npos)
    title += ", " + the_case.side;
  return title;
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

HandModel hand_of(const LiveRun& live) {
  HandModel hand;
  hand.info = live.choice().info;
  hand.status = live.device_status();
  hand.force_limit_n = live.force_limit_n();
  hand.stiffness_n_per_m = live.feel().stiffness_n_per_m;
  if (hand.info.max_stiffness_n_per_m > 0)
    hand.stiffness_max_n_per_m = hand.info.max_stiffness_n_per_m;
  hand.stiffness_n_per_m = std::min(hand.stiffness_n_per_m, hand.stiffness_max_n_per_m);
  hand.friction_scale = live.feel().friction_scale;
  hand.bones_held = live.feel().bones_held;
  hand.haptic = live.haptic_stats();
  hand.physics = live.physics_stats();
  hand.realtime_warning = live.realtime_warning();
  hand.probe_by_mouse = live.by_mouse();
  hand.dead_man_held = hand.status.dead_man_held;
  hand.mapping.settable = live.by_real_device();
  hand.mapping.settings = live.mapping_settings();
  return hand;
}

std::string driver_of(const PedalMap& pedals, const char* name) {
  const auto pedal = pedals.find(name);
  return pedal == pedals.end() ? "none" : describe(pedal->second);
}

ReplayModel replay_of(const LoadedReplay& replay, const ReplayPlayer& player) {
  ReplayModel model;
  model.on = true;
  model.playing = player.playing();
  model.duration_s = replay.track.duration_s();
  model.position_s = player.position_s();
  model.speed = player.speed();
  model.file = replay.file.filename().string();
  model.identical = replay.identical;
  model.verdict = replay.identical
                      ? "Repeats exactly: all " + std::to_string(replay.ticks) + " ticks agree"
                      : "Differs from the recording from tick " +
                            std::to_string(replay.first_different_tick) + " on";
  return model;
}

}  // namespace

UiModel WindowApp::build_model() {
  UiModel model;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  model.width = size.x;
  model.height = size.y;
  model.scale = ui_->scale();
  model.left_card = static_cast<float>(settings_.left_card);
  model.toasts = toasts_.shown();
  model.panels_open = settings_.panels_open;
  model.help_open = help_open_;
  if (browser_.is_open()) model.browser = browser_.model();
  model.exercise = exercise_.model();
  model.first_run_hint = !settings_.hint_dismissed && !replay_ && order_.frames == 0;
  if (!ready()) {
    model.phase = load_failure_.empty() ? UiPhase::kLoading : UiPhase::kFailed;
    model.loading.failure = load_failure_;
    if (job_) {
      const LoadProgress progress = job_->progress();
      model.loading.what = progress.what;
      model.loading.fraction = progress.fraction;
      model.loading.seconds_left = progress.seconds_left;
      model.loading.can_cancel = true;
    }
    return model;
  }
  model.checkup = checkup_model();
  model.edit = edit_model();
  model.patient = patient_model();
  model.case_title = title_of(*case_);
  model.is_knee = case_->find("femur").valid();
  for (const Bone& bone : case_->bones) {
    model.bone_labels.push_back(label_of(bone.name));
    model.bone_felt.push_back(bone.felt);
  }
  for (const SoftPart& soft : case_->softs) model.soft_labels.push_back(label_of(soft.name));
  model.joints = joint_models();
  model.can_bend = can_bend();
  model.view = view_;
  if (felt_job_) model.felt_measured = felt_job_->progress().fraction;
  if (refining_ || lighting_) model.felt_measured = 0;
  model.hovered = hovered_;
  model.picked = picked_;
  const double ratio = window_->pixel_ratio();
  model.pointer_x = static_cast<float>(pointer_x_ / ratio);
  model.pointer_y = static_cast<float>(pointer_y_ / ratio);
  model.time_s = shown_.tool.time_s;
  model.contacts = contact_rows(shown_.tool);
  if (live_) {
    model.hand = hand_of(*live_);
    model.hand.has_dead_man = model.hand.info.has_dead_man || pedals_.has(kDeadManPedal);
    if (mapping_changed_s_ >= 0)
      model.hand.mapping.settings =
          mapping_of(settings_.mappings, mapping_key(live_->choice().info, case_->name));
    model.hand.learning_pedal = learning_pedal_;
    model.hand.mapping.dead_man = driver_of(settings_.pedals, kDeadManPedal);
    model.hand.mapping.clutch = driver_of(settings_.pedals, kClutchPedal);
    model.hand.mapping.power = driver_of(settings_.pedals, kPowerPedal);
    model.force_history = live_->force().values();
    model.timeline = {live_->contacts().end_s(), live_->contacts().spans(), marks_};
    model.record = {live_->recording(), shown_.tool.time_s,
                    live_->recording_file().filename().string()};
    model.activity = live_->choice().driver == "virtual" ? "Demonstration" : "Exploring";
    if (refining_)
      model.activity += "; bones felt as hulls, pieces " +
                        std::to_string(static_cast<int>(100 * share_refined())) + " %";
    if (model.record.on) model.activity = "Recording to " + model.record.file;
  }
  if (replay_ && player_) {
    model.replay = replay_of(*replay_, *player_);
    model.force_history = replay_force_;
    model.timeline = {model.replay.duration_s, replay_->track.contacts().spans(), marks_};
    model.activity = "Replay of " + model.replay.file;
  }
  model.hands = hands_model();
  model.views = views_model();
  model.hand.force_n = shown_.tool.force_W.norm();
  model.hand.picture_hz = frames_.rate_hz();
  model.hand.probe_in_hand = probe_held_;
  for (const DeviceChoice& choice : choices_) model.hand.devices.push_back(choice.label);
  model.hand.device = live_ ? find_choice(choices_, key_of(live_->choice())) : 0;
  return model;
}

}  // namespace osteon
