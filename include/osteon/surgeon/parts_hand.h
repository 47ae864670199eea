#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "osteon/scene/path.h"
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

/// A hand whose later parts depend on what the earlier ones did: each is planned as it begins, from
/// where the hand then is. A part that cannot be planned within three seconds ends it.
class PartsHand : public HandPlayer {
 public:
  using Plan = std::function<std::optional<HandPart>(const Pose& from)>;
  /// `first` is played to its end before the parts.
  PartsHand(std::unique_ptr<HandPlayer> first, std::vector<Plan> parts);
  /// `tray`: names of the session's instruments; one that is not among them is not taken.
  void set_tray(std::vector<std::string> tray) { tray_ = std::move(tray); }

  Pose start() const override { return first_->start(); }
  Pose step(double dt_s) override;
  void feel(const Vec3& force_W) override { first_->feel(force_W); }
  bool done() const override { return first_->done() && at_ >= parts_.size(); }
  Command command() override { return next_; }
  Vec3 tip_W() const override { return X_.p; }
  std::size_t touched() const override { return at_; }
  const std::vector<std::string>& unreachable() const override { return first_->unreachable(); }

 private:
  void begin_part(double dt_s);
  Command said();

  std::unique_ptr<HandPlayer> first_;
  std::vector<Plan> parts_;
  std::vector<std::string> tray_;
  std::optional<HandPart> part_;
  std::size_t at_ = 0, order_ = 0;
  double time_s_ = 0, waited_s_ = 0;
  Pose X_;
  std::string held_;
  double power_ = 0, jaw_ = 0;
  Command next_;
};

}  // namespace osteon
