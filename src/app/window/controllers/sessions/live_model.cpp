// What the panels show of a live run.
#include <algorithm>

#include "window/controllers/sessions/live_control.h"
#include "window/ui_model.h"

namespace osteon {
namespace {

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

}  // namespace

void LiveControl::describe(UiModel& model) const {
  if (run_) {
    model.hand = hand_of(*run_);
    pedals_.describe(model.hand);
    if (mapping_changed_s_ >= 0) model.hand.mapping.settings = mapping_for(run_->choice());
    model.force_history = run_->force().values();
    model.timeline = {run_->contacts().end_s(), run_->contacts().spans(), {}};
    model.record = {run_->recording(), sight_.shown().tool.time_s,
                    run_->recording_file().filename().string()};
    model.activity = run_->choice().driver == "virtual" ? "Demonstration" : "Exploring";
    if (model.record.on) model.activity = "Recording to " + model.record.file;
    model.hand.device = find_choice(choices_, key_of(run_->choice()));
  }
  for (const DeviceChoice& choice : choices_) model.hand.devices.push_back(choice.label);
  model.hand.force_n = sight_.shown().tool.force_W.norm();
  model.hand.probe_in_hand = probe_held_;
}

}  // namespace osteon
