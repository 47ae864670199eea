#include "commands/teaching/played_hand.h"

#include <memory>
#include <string>

#include "runs/hands/tray.h"

namespace osteon {
namespace {

// The surgeon's will moves an emulated hand with a mass and a grip, which yields to the force.
class SurgeonHand : public HandInLoop {
 public:
  SurgeonHand(HandPlayer& surgeon, const HandParams& hand, double tick_s)
      : surgeon_(surgeon), hand_(hand), wanted_(surgeon.start()), tick_s_(tick_s) {
    hand_.reset(wanted_);
  }

  ToolInput move() override {
    const Pose next = surgeon_.step(tick_s_);
    hand_.step(tick_s_, wanted_, (next.p - wanted_.p) / tick_s_, force_W_);
    wanted_ = next;
    return {hand_.pose(), hand_.velocity(), hand_.angular_velocity(), 0};
  }
  Command command() override { return surgeon_.command(); }
  void feel(const Vec3& force_W) override {
    force_W_ = force_W;
    surgeon_.feel(force_W);
  }

 private:
  HandPlayer& surgeon_;
  VirtualHand hand_;
  Pose wanted_;
  double tick_s_;
  Vec3 force_W_ = Vec3::Zero();
};

// Names what the hand holds first, and all that it may take.
ProbePath holding(const PlannedHand& hand) {
  ProbePath path;
  if (hand.instrument == kWristProbe) return path;
  path.samples.emplace_back(0.0, Pose{}, false);
  path.samples.back().instrument = hand.instrument;
  for (const std::string& other : hand.also) {
    path.samples.emplace_back(path.samples.back().time_s + 1, Pose{}, false);
    path.samples.back().instrument = other;
  }
  return path;
}

}  // namespace

HeadlessHand played_by(HandPlayer& player, const PlannedHand& hand, const HandParams& params) {
  return {hand.name, holding(hand),
          [&params, &player](double tick_s) {
            return std::make_unique<SurgeonHand>(player, params, tick_s);
          },
          &player};
}

}  // namespace osteon
