#include "runs/replays/replay_player.h"

#include <algorithm>

namespace osteon {

void ReplayPlayer::advance(double dt_s) {
  if (!playing_) return;
  position_s_ += dt_s * speed_;
  if (position_s_ < duration_s_) return;
  position_s_ = duration_s_;
  playing_ = false;
}

void ReplayPlayer::toggle() {
  if (!playing_ && position_s_ >= duration_s_) position_s_ = 0;
  playing_ = !playing_;
}

void ReplayPlayer::seek(double position_s) {
  position_s_ = std::clamp(position_s, 0.0, duration_s_);
}

void ReplayPlayer::set_speed(double speed) { speed_ = std::clamp(speed, kSlowest, kFastest); }

}  // namespace osteon
