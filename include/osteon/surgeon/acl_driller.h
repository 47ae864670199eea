#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "osteon/surgeon/hand_player.h"
#include "osteon/surgeon/skill.h"

namespace osteon {

/// One thing that a hand with drills does.
struct AclMove {
  enum class Kind : std::uint8_t {
    kGo,     ///< to a pose, at a speed
    kPress,  ///< along the tool's axis with a force until the tip is at the pose, or time is over;
             ///< where that goes no farther for long, drawn back and pressed again
    kLean,   ///< stand on bone with a force against `out_W`, until the tip is on the line through
             ///< the pose along it, or time is over
    kWait,   ///< until the attempt is so old
    kTake,   ///< an instrument
    kPower,
    kJaw
  };
  Kind kind = Kind::kGo;
  Pose X_WT;              ///< kGo, kPress
  double m_per_s = 0.05;  ///< kGo; kPress: the fastest
  double force_n = 2;     ///< kPress, kLean
  /// kWait: s; kPress, kLean: gives up after so many s, kPress after two more tries from far back;
  /// kPower, kJaw: 0 to 1
  double value = 0;
  std::string instrument = {};  ///< kTake, as a tray names it
  bool exact = false;           ///< kPress: with less force as the end comes near
  Vec3 out_W = Vec3::UnitZ();   ///< kLean: unit, away from the bone
};

/// Somebody who drives pins and drills: presses by what is felt, and knows where the tip is from
/// how far the hand's grip and the tool's coupling give. A function of (moves, skill, forces).
class AclDriller : public HandPlayer {
 public:
  /// `tray`: names of the session's instruments; an instrument that is not among them is not taken.
  /// The hand begins where the first kGo ends.
  AclDriller(std::vector<AclMove> moves, const Skill& skill);
  void set_tray(std::vector<std::string> tray) { tray_ = std::move(tray); }

  Pose start() const override { return {p_W_, q_}; }
  Pose step(double dt_s) override;
  void feel(const Vec3& force_W) override;
  bool done() const override { return at_ >= moves_.size(); }
  Command command() override;
  Vec3 tip_W() const override { return p_W_; }
  std::size_t touched() const override { return at_; }
  const std::vector<std::string>& unreachable() const override { return unreachable_; }
  /// Presses that were given up: their tip was not where it should be in time.
  std::size_t given_up() const { return given_up_; }

 private:
  void move(double dt_s);
  void go(const AclMove& move, double dt_s);
  void press(const AclMove& move, double dt_s);
  bool is_stuck(double left_m, double dt_s);
  bool tries_again(const AclMove& move, double left_m);
  void lean(const AclMove& move, double dt_s);
  void next();

  std::vector<AclMove> moves_;
  std::vector<std::string> tray_, unreachable_;
  Skill skill_;
  std::size_t at_ = 0, given_up_ = 0;
  double time_s_ = 0, in_move_s_ = 0, settled_s_ = 0;
  Vec3 p_W_ = Vec3::Zero(), force_W_ = Vec3::Zero();
  Quat q_ = Quat::Identity(), q_from_ = Quat::Identity();
  double way_m_ = 0, turn_rad_ = 0;  ///< of the kGo that goes on
  /// Of the kPress that goes on: what was left at its best, for how long it has been no better, how
  /// far it is still to be drawn back, and how often it was.
  double least_left_m_ = 0, stuck_s_ = 0, back_m_ = 0;
  int drawn_back_ = 0, last_tries_ = 0;
  double longer_s_ = 0;  ///< than it was to take, for those
  Command next_;
  std::array<double, 3> phases_{};
};

}  // namespace osteon
