#pragma once

#include <cstdint>

namespace osteon {

/// Share of the force in [0, 1] that time allows: rises in a line after `restart`, falls while the
/// simulation's data grow old.
class ForceRamp {
 public:
  ForceRamp(double ramp_in_s, double stale_after_s, double stale_decay_s)
      : ramp_in_s_(ramp_in_s), stale_after_s_(stale_after_s), stale_decay_s_(stale_decay_s) {}
  void restart() { gain_ = 0; }
  /// After `dt_s`, with simulation data that are `age_s` old.
  double advance(double age_s, double dt_s);
  double gain() const { return gain_; }
  /// Data of this age have had their whole decay: the watchdog's case.
  bool too_old(double age_s) const { return age_s >= stale_after_s_ + stale_decay_s_; }

 private:
  double ramp_in_s_, stale_after_s_, stale_decay_s_;
  double gain_ = 0;
};

/// How long a device has sent nothing new, by the time of its readings. Time that goes back is
/// nothing new.
class SilenceWatch {
 public:
  /// The next reading counts as new, whatever its time.
  void restart();
  void see(std::int64_t reading_time_ns, double dt_s);
  double silent_s() const { return silent_s_; }

 private:
  std::int64_t newest_ns_ = 0;
  bool seen_ = false;
  double silent_s_ = 0;
};

}  // namespace osteon
