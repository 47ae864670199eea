#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "osteon/surgeon/scripted_hand.h"

namespace osteon {

/// A hand whose later parts depend on what the earlier ones did: each is planned as it begins, from
/// where the hand then is. A part that cannot be planned in time ends it.
class PartsHand : public HandPlayer {
 public:
  using Plan = std::function<std::optional<HandPart>(const Pose& from)>;
  /// `first` are played one after the other to their ends, each from where the one before ends,
  /// then the parts. There is one at least.
  PartsHand(std::vector<std::unique_ptr<HandPlayer>> first, std::vector<Plan> parts);
  PartsHand(std::unique_ptr<HandPlayer> first, std::vector<Plan> parts);
  /// `tray`: names of the session's instruments; one that is not among them is not taken.
  void set_tray(std::vector<std::string> tray) { tray_ = std::move(tray); }

  /// For how long a part may wait to be planned, s: more than three where measuring takes its time.
  void set_patience(double patience_s) { patience_s_ = patience_s; }

  Pose start() const override { return first_.front()->start(); }
  Pose step(double dt_s) override;
  void feel(const Vec3& force_W) override;
  bool done() const override { return now_ >= first_.size() && at_ >= parts_.size(); }
  Command command() override { return next_; }
  Vec3 tip_W() const override { return X_.p; }
  std::size_t touched() const override { return at_; }
  const std::vector<std::string>& unreachable() const override {
    return first_.back()->unreachable();
  }

 private:
  void begin_part(double dt_s);

  std::vector<std::unique_ptr<HandPlayer>> first_;
  std::vector<Plan> parts_;
  std::vector<std::string> tray_;
  std::optional<ScriptedHand> part_;
  std::size_t now_ = 0, at_ = 0;  ///< of those that are played first, and of the parts
  double waited_s_ = 0, patience_s_ = 3;
  Pose X_;
  Command next_;
};

}  // namespace osteon
