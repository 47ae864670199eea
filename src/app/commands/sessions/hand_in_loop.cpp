#include "commands/sessions/hand_in_loop.h"

#include <algorithm>

#include "loops/path_player.h"
#include "osteon/device/drivers.h"
#include "osteon/device/safety.h"

namespace osteon {
namespace {

class FreeHand : public HandInLoop {
 public:
  FreeHand(const ProbePath& path, const HandParams& hand, double tick_s)
      : path_(path), hand_(hand), tick_s_(tick_s) {
    hand_.reset(path_.at(0).X_WD);
  }

  ToolInput move() override {
    const double t = static_cast<double>(ticks_++) * tick_s_;
    const PathSample wanted = path_.at(t);
    // What the path asks for between this tick and the next.
    const Vec3 v_W = (path_.at(t + tick_s_).X_WD.p - path_.at(t).X_WD.p) / tick_s_;
    hand_.step(tick_s_, wanted.X_WD, v_W, force_W_);
    return {hand_.pose(), hand_.velocity(), hand_.angular_velocity(), wanted.button ? 1u : 0u};
  }
  void feel(const Vec3& force_W) override { force_W_ = force_W; }

 private:
  ProbePath path_;
  VirtualHand hand_;
  double tick_s_;
  std::uint64_t ticks_ = 0;
  Vec3 force_W_ = Vec3::Zero();
};

// The gate sees World, and the device leaves away what its own axes do not drive.
DeviceInfo about_all_axes(DeviceInfo info) {
  if (info.drives_rotation()) info.torque_axes = {true, true, true};
  return info;
}

class DeviceHand : public HandInLoop {
 public:
  DeviceHand(std::unique_ptr<PathPlayer> player, double tick_s)
      : player_(std::move(player)), gate_(about_all_axes(player_->info())), tick_s_(tick_s) {}
  ~DeviceHand() override {
    player_->write_force(Vec3::Zero());
    player_->close();
  }

  // The hand waits at the start: a run is not to begin with half a force.
  void arm() {
    gate_.enable();
    for (double t = 0; t < 2 * SafetyParams{}.ramp_in_s; t += tick_s_) {
      sample_ = player_->read_at_start();
      player_->write_force(gate_.filter(Vec3::Zero(), sample_, 0, tick_s_));
    }
  }

  ToolInput move() override {
    sample_ = player_->read();
    return {sample_.X_VD, sample_.v_V, sample_.w_V, sample_.buttons};
  }
  bool drives_rotation() const override { return player_->info().drives_rotation(); }
  void turn(const Vec3& torque_W) override { torque_W_ = torque_W; }
  void feel(const Vec3& force_W) override {
    player_->write(gate_.filter(DeviceWrench{force_W, torque_W_}, sample_, 0, tick_s_));
  }
  std::string complaint() const override {
    return gate_.enabled() ? std::string() : describe(gate_.cause());
  }

 private:
  std::unique_ptr<PathPlayer> player_;
  SafetyGate gate_;
  double tick_s_;
  DeviceSample sample_;
  Vec3 torque_W_ = Vec3::Zero();
};

void keep_within(const DeviceInfo& info, double scale, HapticParams& haptic) {
  if (info.max_stiffness_n_per_m > 0)
    haptic.stiffness_n_per_m =
        std::min(haptic.stiffness_n_per_m, info.max_stiffness_n_per_m / scale);
  if (info.peak_force_n > 0) haptic.max_force_n = std::min(haptic.max_force_n, info.peak_force_n);
  if (info.max_slew_n_per_s > 0)
    haptic.max_slew_n_per_s = std::min(haptic.max_slew_n_per_s, info.max_slew_n_per_s);
}

}  // namespace

std::unique_ptr<HandInLoop> free_hand(const ProbePath& path, const HandParams& hand,
                                      double tick_s) {
  return std::make_unique<FreeHand>(path, hand, tick_s);
}

Result<std::unique_ptr<HandInLoop>> hand_on_device(const std::string& driver, const ProbePath& path,
                                                   HapticParams& haptic) {
  auto device = open_device(driver);
  if (!device) return tl::unexpected(device.error());
  auto player = PathPlayer::make(std::move(*device), path);
  if (!player) return tl::unexpected(player.error());
  keep_within((*player)->info(), (*player)->scale(), haptic);
  auto hand = std::make_unique<DeviceHand>(std::move(*player), haptic.tick_s);
  hand->arm();
  return hand;
}

}  // namespace osteon
