#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/haptic/haptic.h"
#include "osteon/haptic/haptic_state.h"
#include "osteon/physics/ring_state.h"
#include "osteon/physics/soft_state.h"
#include "osteon/scene/command.h"
#include "osteon/scene/event.h"
#include "osteon/scene/inside.h"
#include "osteon/scene/state.h"

namespace osteon {

struct CarvingState;

/// What was told of how the knee gives, number by number; null: nothing.
using ToldKnee = std::shared_ptr<const std::vector<double>>;

/// What a hand keeps at a restore point: where the device is stays the hand's own business.
struct HandMark {
  bool set = false;
  std::uint32_t instrument = 0;
  double power = 0;
  double jaw = 0;
};

/// A bone that the hand touches, or has let go a moment ago.
struct Touch {
  std::uint64_t first_tick = 0;
  std::uint64_t last_tick = 0;
  double peak_force_n = 0;
  double deepest_m = 0;
};

/// What the events of a hand remember from tick to tick.
struct WatchState {
  std::uint64_t touched = 0;  ///< bit i: touches[i] has begun
  std::array<Touch, kMaxBones> touches{};
  std::uint64_t over_since = 0;  ///< tick; 0: the force is within its limit
  std::uint32_t over_bone = kNoSubject;
  std::array<std::uint64_t, kMaxBones>
      seen{};           ///< tick, of each bone: in the middle of its scope's picture; 0: never
  InsideList inside{};  ///< what its tip was in, as the last snapshot said
};

/// All that one hand's ticks leave to the next.
struct HandState {
  HapticState haptic;  ///< of the instrument that it holds
  HapticParams params;
  std::uint64_t bone_step = 0;   ///< of the snapshot that the last tick consumed
  std::uint64_t first_tick = 1;  ///< that consumed that one
  ToolState before;              ///< of the tick before the last: physics may be so late
  OtherTools seen{};             ///< of other hands, that the next tick may consume
  WatchState watch;
  std::array<HandMark, kMaxMarks> marks{};
};

/// The world at a restore point.
struct WorldMark {
  bool set = false;
  bool hold = false;
  BoneSnapshot bones;
  std::shared_ptr<const CarvingState> carved;  ///< null: no bone is carved
  SoftState softs;                             ///< off: nothing is soft
  RingsState rings;                            ///< off: no rings lie loose
  ToldKnee knee;
};

/// All that one physics step leaves to the next.
struct WorldState {
  BoneSnapshot bones;
  bool hold = true;
  std::shared_ptr<const CarvingState> carved;  ///< null: no bone is carved
  SoftState softs;                             ///< off: nothing is soft
  RingsState rings;                            ///< off: no rings lie loose
  ToldKnee knee;
  std::array<WorldMark, kMaxMarks> marks{};
};

/// A whole session after a tick: copy it to save, compare or go back. Restored into a session of
/// the same case, settings and tray, the same inputs give the same bits again.
struct SessionState {
  std::vector<HandState> hands;
  WorldState world;
  Command for_next_step;  ///< of Session::tick
};

/// As little-endian words, for a recording; numbers keep every bit.
std::string to_bytes(const SessionState& state);
/// Refuses what is too short, too long, or holds a value that it cannot have.
Result<SessionState> state_from_bytes(std::string_view bytes);

}  // namespace osteon
