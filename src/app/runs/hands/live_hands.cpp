// What moves the hands of a live run, what they hold, and the way back to a restore point.
#include <algorithm>
#include <cmath>

#include "osteon/device/mouse_device.h"
#include "runs/hands/live_run.h"
#include "runs/hands/shaft_place.h"

namespace osteon {
namespace {

// In contact the mouse's hand stays this near to the probe: else a long drag into bone would have
// to be undone all the way before the probe comes off.
constexpr double kTether_m = 0.015;
constexpr double kTwice_s = 2;  // undo again within this goes one restore point further back

Quat about(const Vec3& axis, double angle_rad) { return Quat(Eigen::AngleAxisd(angle_rad, axis)); }

}  // namespace

Result<void> LiveRun::add_hand(const Pose& X_WD_start, std::uint32_t instrument) {
  if (recording_) return fail("stop the recording before adding a second hand");
  if (hands_.size() >= kMaxHands) return fail("a session has at most four hands");
  std::vector<Pose> poses = poses_now();
  poses.push_back(X_WD_start);
  end_run();
  if (hands_.size() == 1) hands_[0].name = "right";
  LiveHand hand;
  hand.choice = hands_[0].choice;
  hand.user = hands_[0].user;
  hand.name = "left";
  hand.instrument = instrument;
  hand.snapshot.bones = rest_snapshot(*case_);
  shared_ = hand.choice.driver != "mouse";
  hands_.push_back(std::move(hand));
  active_ = hands_.size() - 1;
  return start_run(poses, nullptr);
}

bool LiveRun::change_hands() {
  if (hands_.size() < 2) return false;
  const ForceOff cause = now().status.cause;
  const bool fault = cause != ForceOff::kNone && cause != ForceOff::kSoftware;
  if (share_ && fault) return false;
  // Who is let go of rests where it is.
  if (share_ && now().snapshot.tool.tick > 0) now().X_WD_wanted = now().snapshot.tool.X_WD;
  active_ = (active_ + 1) % hands_.size();
  if (share_) share_->give(active_);
  return true;
}

bool LiveRun::rests(std::size_t i) const {
  if (i >= hands_.size() || i == active_) return false;
  return share_ != nullptr || hands_[i].mouse != nullptr;
}

// The shaft runs from the tip along +z of Tool: inwards is -z.
void LiveRun::nudge(std::size_t i, double in_m, double about_rad, double pitch_rad, double yaw_rad,
                    const Quat& q_WC) {
  if (!rests(i)) return;
  LiveHand& hand = hands_[i];
  Pose& X = hand.X_WD_wanted;
  X.p -= in_m * (X.q * Vec3::UnitZ());
  const Quat tilt =
      q_WC * about(Vec3::UnitX(), pitch_rad) * about(Vec3::UnitY(), yaw_rad) * q_WC.conjugate();
  X.q = (tilt * X.q * about(Vec3::UnitZ(), about_rad)).normalized();
  if (hand.mouse)
    hand.mouse->set_target(hand.mapping.to_device(X), 0);
  else
    share_->set_rest(i, hand.mapping.to_device(X));
}

void LiveRun::take(std::uint32_t place) {
  if (runtime_ && place < tray_.tools.size())
    runtime_->send({CommandKind::kTake, static_cast<double>(place)}, active_);
}

// A motor runs while somebody holds its key or pedal: not in a hand that was left, or that a
// restore point or another run has given back running. Jaws keep what they hold.
void LiveRun::stop_left_motors() {
  for (std::size_t i = 0; runtime_ && i < hands_.size(); ++i) {
    const ToolState& tool = hands_[i].snapshot.tool;
    const bool left = i != active_ && !hands_[i].orders && tool.tick > 0 && tool.power > 0;
    if (left && tool.instrument < tray_.driven.size() && tray_.driven[tool.instrument].power)
      (void)runtime_->send({CommandKind::kPower, 0}, i);
  }
}

// What differs from what the hand was last seen to have is sent again.
void LiveRun::drive(double pedal) {
  stop_left_motors();
  const ToolState& tool = now().snapshot.tool;
  if (!runtime_ || tool.tick == 0 || now().orders || tool.instrument >= tray_.driven.size()) return;
  constexpr double kSteps = 20;
  const double wanted = std::round(std::clamp(pedal, 0.0, 1.0) * kSteps) / kSteps;
  const RunTray::Driven driven = tray_.driven[tool.instrument];
  if (driven.power && tool.power != wanted)
    (void)runtime_->send({CommandKind::kPower, wanted}, active_);
  if (driven.jaws && tool.jaw != 1 - wanted)
    (void)runtime_->send({CommandKind::kJaw, 1 - wanted}, active_);
}

std::uint32_t LiveRun::mark() {
  if (!runtime_) return 0;
  const std::uint32_t number = next_mark_++ % kMaxMarks;
  runtime_->send({CommandKind::kMark, static_cast<double>(number)});
  std::erase(marks_, number);
  marks_.push_back(number);
  mark_news_.push_back({number, false});
  return number;
}

bool LiveRun::go_back(std::uint32_t number) {
  const bool kept = std::find(marks_.begin(), marks_.end(), number) != marks_.end();
  if (!runtime_ || !kept) return false;
  const bool sent = runtime_->send({CommandKind::kRestore, static_cast<double>(number)});
  if (sent) mark_news_.push_back({number, true});
  return sent;
}

bool LiveRun::undo() {
  if (!runtime_ || marks_.empty()) return false;
  const double time_s = now().snapshot.tool.time_s;
  if (time_s - undone_at_s_ < kTwice_s && marks_.size() > 1) marks_.pop_back();
  undone_at_s_ = time_s;
  return go_back(marks_.back());
}

std::vector<ToolState> LiveRun::others() const {
  std::vector<ToolState> tools;
  for (std::size_t i = 0; i < hands_.size(); ++i)
    if (i != active_ && hands_[i].snapshot.tool.tick > 0) tools.push_back(hands_[i].snapshot.tool);
  return tools;
}

void LiveRun::bring(const Pose& X_WD) {
  LiveHand& hand = now();
  if (!hand.mouse || !is_finite(X_WD)) return;
  hand.X_WD_wanted = X_WD;
  hand.mouse->set_target(hand.mapping.to_device(X_WD), 0);
}

void LiveRun::move_hand(const ProbeMotion& motion, const Camera& camera, const Viewport& viewport,
                        double dt_s, const Vec3* through_W) {
  LiveHand& hand = now();
  if (!hand.mouse) return;
  ProbeMotion free = motion;
  if (through_W) free.wheel = 0;
  hand.X_WD_wanted = drag_probe(hand.X_WD_wanted, free, camera, viewport, dt_s);
  const ToolState& tool = hand.snapshot.tool;
  const Tray& tools = tray_.tools;
  const Vec3 beside_T = tool.instrument < tools.size() ? shaft_beside_tip(*tools[tool.instrument])
                                                       : Vec3(Vec3::Zero());
  if (through_W)
    hand.X_WD_wanted = slid_through(hand.X_WD_wanted, beside_T, *through_W, motion.wheel);
  const Vec3 away = hand.X_WD_wanted.p - tool.X_WP.p;
  if (tool.contact_count > 0 && away.norm() > kTether_m)
    hand.X_WD_wanted.p = tool.X_WP.p + away.normalized() * kTether_m;
  hand.mouse->set_target(hand.mapping.to_device(hand.X_WD_wanted), 0);
}

void LiveRun::move_pad(const PadSticks& sticks, const Camera& camera, double dt_s) {
  if (!runtime_) return;
  PadDevice* const pad = now().pad;
  if (hands_.size() > 1 && (!pad || sticks.for_rested)) {
    const RestNudge by = pad_nudge(sticks.axes_C, dt_s);
    if (by.moves())
      nudge((active_ + 1) % hands_.size(), by.in_m, by.about_rad, by.pitch_rad, by.yaw_rad,
            camera.q_WC);
  }
  if (!pad) return;
  const Quat q_VC = now().mapping.X_WV.q.conjugate() * camera.q_WC;
  PadAxes axes_V = sticks.for_rested ? at_rest(sticks.axes_C) : sticks.axes_C;
  axes_V.move_V = q_VC * axes_V.move_V;
  axes_V.turn_V = q_VC * axes_V.turn_V;
  pad->set_axes(axes_V);
}

}  // namespace osteon
