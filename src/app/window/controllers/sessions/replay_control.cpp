#include "window/controllers/sessions/replay_control.h"

#include <utility>

#include "runs/reports/force_history.h"
#include "window/jobs/replay_filling.h"
#include "window/ui_model.h"

namespace osteon {
namespace {

ReplayModel replay_of(const LoadedReplay& replay, const ReplayPlayer& player) {
  ReplayModel model;
  model.on = true;
  model.playing = player.playing();
  model.duration_s = replay.duration_s;
  model.position_s = player.position_s();
  model.speed = player.speed();
  model.file = replay.file.filename().string();
  model.identical = replay.identical;
  model.verdict = replay.identical
                      ? "Repeats exactly: all " + std::to_string(replay.ticks) + " ticks agree"
                      : "Differs from the recording from tick " +
                            std::to_string(replay.first_different_tick) + " on";
  if (replay.filling && !replay.filling->whole() && replay.identical)
    model.verdict = "Repeats exactly so far; checked: " +
                    std::to_string(static_cast<int>(100 * replay.filling->share())) + " %";
  return model;
}

}  // namespace

void ReplayControl::end() {
  replay_.reset();
  carved_.reset();
  carved_place_ = 0;
}

void ReplayControl::begin(LoadedReplay replay) {
  end();
  replay_ = std::move(replay);
  sight_.set_tray(replay_->instruments, replay_->tray);
  sight_.show_what_gives_way(replay_->softs.get());
  if (replay_->carving) carved_.emplace(replay_->carving);
  player_ = ReplayPlayer(replay_->duration_s);
  player_.seek(host_.order.at_s);
  // The ordered moment stands still.
  if (host_.order.frames > 0 && host_.order.at_s > 0) player_.toggle();
  if (!replay_->complete)
    host_.note(ToastKind::kWarning,
               "This recording was cut short by a crash or a power cut. Everything that was saved "
               "is here.");
}

void ReplayControl::advance(double dt_s) {
  if (!replay_) return;
  player_.advance(dt_s);
  if (replay_->filling)
    if (const auto filled = replay_->filling->poll(player_.position_s(), *replay_); !filled)
      host_.note(ToastKind::kError, filled.error().message());
  sight_.shown() = replay_->track.at(player_.position_s());
  force_ = replay_->track.force_until(player_.position_s(),
                                      static_cast<std::size_t>(8 * kForceHistoryHz));
}

bool ReplayControl::apply(const UiRequests& requests) {
  if (!replay_) return false;
  if (requests.toggle_play) player_.toggle();
  if (requests.seek_s) player_.seek(*requests.seek_s);
  if (requests.speed) player_.set_speed(*requests.speed);
  return requests.close_replay;
}

std::vector<ToolState> ReplayControl::others() const {
  std::vector<ToolState> tools;
  if (!replay_) return tools;
  for (const ReplayTrack& track : replay_->more)
    if (!track.empty()) tools.push_back(track.at(player_.position_s()).tool);
  return tools;
}

CarvedPicture* ReplayControl::carved() {
  if (!replay_ || !carved_) return nullptr;
  carved_place_ = replay_->cuts.show(player_.position_s(), carved_place_, *carved_);
  return &*carved_;
}

SoftPushes ReplayControl::pushes() const {
  return replay_ ? replay_->pushes.at(player_.position_s()) : SoftPushes{};
}

void ReplayControl::describe(UiModel& model) const {
  if (!replay_) return;
  model.replay = replay_of(*replay_, player_);
  model.force_history = force_;
  model.timeline = {model.replay.duration_s, replay_->track.contacts().spans(), {}};
  model.activity = "Replay of " + model.replay.file;
}

}  // namespace osteon
