#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "commands/support/headless.h"
#include "loops/device_mapping.h"
#include "loops/hand_share.h"
#include "osteon/device/emulated_user.h"
#include "osteon/surgeon/hand_player.h"
#include "runs/replays/path_commands.h"

namespace osteon {

/// What a hand of a run wants, tick by tick: the will of its player, else its path.
class HandWill {
 public:
  HandWill(const HeadlessHand& hand, std::span<const std::string> tray);
  Pose start() const;
  /// After another `dt_s`.
  void step(double dt_s);
  const Pose& wanted() const { return X_; }
  std::uint32_t buttons() const { return buttons_; }
  /// Of the last step; kNone: nothing.
  const Command& said() const { return said_; }
  void feel(const Vec3& force_W);
  bool done() const;

 private:
  HandPlayer* player_;
  ProbePath path_;
  PathCommands commands_;
  double time_s_ = 0;
  Pose X_;
  std::uint32_t buttons_ = 0;
  Command said_;
};

/// A device with an emulated user who is led, for one hand or for several that take turns. Of the
/// thread that leads; the loops have the devices of `take`.
class LedHands {
 public:
  /// Fails when the device's user is a real one. `starts_W`: where its hands begin, the first of
  /// them with the device in hand.
  static Result<LedHands> make(std::unique_ptr<HapticDevice> device, std::string label,
                               std::span<const Pose> starts_W);
  /// Brings the user to where its first hand begins; before `take`. `step` as play_live has it.
  Result<void> go_to_start(const std::function<void()>& step);
  const DeviceInfo& info() const { return info_; }
  const DeviceMapping& mapping() const { return mapping_; }
  const std::string& label() const { return label_; }
  /// The device of its hand of this number, for the loop.
  std::unique_ptr<HapticDevice> take(std::size_t hand);

  /// Where a hand is wanted now, `dt_s` after the last. The device goes over to a hand that begins
  /// to move when the one that has it rests; one that moves beside it is moved without it.
  void lead(std::size_t hand, const HandWill& will, double dt_s);
  /// The device is on its way to another hand: nobody is to move meanwhile.
  bool is_changing() const;
  std::uint64_t turns() const { return turns_; }

 private:
  struct One {
    Pose X_W;            ///< wanted last
    double rests_s = 0;  ///< for so long
  };
  LedHands() = default;
  void point_device(std::size_t hand, const Vec3& v_W, std::uint32_t buttons);

  std::string label_;
  DeviceInfo info_;
  EmulatedUser* user_ = nullptr;
  std::unique_ptr<HapticDevice> device_;  ///< until it is taken
  std::shared_ptr<HandShare> share_;      ///< of several hands
  DeviceMapping mapping_;
  std::vector<One> hands_;
  std::size_t owner_ = 0;
  std::uint64_t turns_ = 0;
};

}  // namespace osteon
