#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "osteon/carve/carved_field.h"
#include "osteon/scene/state.h"
#include "osteon/tissue/cut_cells.h"

namespace osteon {

/// What was cut out of one solid.
struct SolidCutState {
  CarveState cuts;
  /// Its stiffness is that of these cells; none: of the whole solid. It follows the cuts, made
  /// anew over some hundred steps.
  std::vector<CutCell> felt;
  std::vector<CutCell> next;       ///< of these it is being made; none: of nothing
  std::uint64_t worked = 0;        ///< steps of that work that are done
  std::uint64_t looked = 0;        ///< step of the cuts at which pieces were last looked for
  std::uint32_t pieces = 0;        ///< that came off
  std::uint32_t told_percent = 0;  ///< of a stump: the last that an event told to be cleared
};

/// What a hand's instrument does to solids.
struct SolidCutHand {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::uint32_t solid = kNone;  ///< that it cuts
  bool jaw_open = false;
  Pose X_BC;               ///< of the cutter, where it last cut
  std::uint32_t idle = 0;  ///< steps since it cut
};

/// All that cutting changes: a value.
struct SoftCutState {
  std::vector<SolidCutState> solids;
  std::array<SolidCutHand, kMaxHands> hands{};
};

}  // namespace osteon
