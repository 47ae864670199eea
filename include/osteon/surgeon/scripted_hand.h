#pragma once

#include <string>
#include <vector>

#include "osteon/scene/path_drive.h"
#include "osteon/surgeon/hand_player.h"

namespace osteon {

/// What somebody says while a path goes on: at a time of the path.
struct TimedCommand {
  double at_s = 0;
  Command command;
};
/// A part of an operation: a path, and what is asked for beside it.
struct HandPart {
  ProbePath path;
  std::vector<TimedCommand> orders;  ///< times rising
};

/// A hand that follows a path: one command a tick; what is asked for beside it waits while the hand
/// itself does something.
class ScriptedHand : public HandPlayer {
 public:
  /// The hand holds what the path begins with, unpowered, its jaws shut.
  explicit ScriptedHand(HandPart part);
  /// `tray`: names of the session's instruments; one that is not among them is not taken.
  void set_tray(std::vector<std::string> tray) { tray_ = std::move(tray); }

  Pose start() const override;
  Pose step(double dt_s) override;
  void feel(const Vec3&) override {}
  bool done() const override;
  Command command() override { return next_; }
  Vec3 tip_W() const override { return X_.p; }
  const std::vector<std::string>& unreachable() const override { return none_; }

 private:
  Command said();

  HandPart part_;
  std::vector<std::string> tray_, none_;
  std::size_t order_ = 0;
  double time_s_ = 0;
  PathDrive drive_;
  std::string held_;
  Pose X_;
  Command next_;
};

}  // namespace osteon
