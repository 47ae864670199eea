#pragma once

namespace osteon {

/// Position, speed and pause of a replay. Reads no clock.
class ReplayPlayer {
 public:
  static constexpr double kSlowest = 0.1, kFastest = 4.0;
  explicit ReplayPlayer(double duration_s) : duration_s_(duration_s) {}
  void advance(double dt_s);
  /// At the end, playing starts again from the beginning.
  void toggle();
  void seek(double position_s);
  void set_speed(double speed);
  bool playing() const { return playing_; }
  double position_s() const { return position_s_; }
  double speed() const { return speed_; }

 private:
  double duration_s_;
  double position_s_ = 0;
  double speed_ = 1;
  bool playing_ = true;
};

}  // namespace osteon
