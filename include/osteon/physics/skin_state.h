#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "osteon/physics/skin_bare.h"
#include "osteon/physics/soft_state.h"
#include "osteon/scene/made_portal.h"
#include "osteon/scene/state.h"
#include "osteon/tissue/sheet_pierce.h"
#include "osteon/tissue/skin_sheet.h"

namespace osteon {

/// What cuts have changed of a sheet; nothing else is kept.
struct SkinCuts {
  struct Moved {
    std::uint32_t vertex = 0;
    SheetPoint p = SheetPoint::Zero();
    bool operator==(const Moved&) const = default;
  };
  struct Cut {
    std::uint32_t edge = 0;
    double depth_m = 0;
    bool operator==(const Cut&) const = default;
  };
  std::vector<Moved> moved;
  std::vector<Cut> cut;
  bool blade_in = false;
  std::uint32_t blade_at = 0;
  bool operator==(const SkinCuts&) const = default;
};
SkinCuts cuts_to_keep(const SkinSheet& sheet, const SheetCuts& cuts);
/// Whether they can be those of the sheet.
bool fits(const SkinSheet& sheet, const SkinCuts& cuts);
SheetCuts kept_cuts(const SkinSheet& sheet, const SkinCuts& cuts);

/// A hole that holds shafts as a portal.
struct SkinPortal {
  SheetPoint at = SheetPoint::Zero();  ///< in the sheet at rest
  double hole_m = 0;                   ///< radius at rest: what goes in there without a peak
  bool pierced = false;                ///< else a cut let the shaft in
};

struct SkinPatchState {
  SkinCuts cuts;
  SkinCuts felt;         ///< its stiffness is that of these
  bool working = false;  ///< the stiffness of `next` is being made
  SkinCuts next;
  std::uint64_t worked = 0;  ///< pieces of that work that are done
  bool has_lips = false;     ///< the lips of `lips_of` can be held open
  SkinCuts lips_of;
  std::uint64_t lips_worked = 0;  ///< pieces that are done of those of `felt`
  double cut_m = 0;               ///< length that is open
  std::uint32_t holes = 0;        ///< that trocars have made
  std::uint32_t made_count = 0;
  std::array<SkinPortal, kMadePerPatch> made{};
};

/// A hand's tool on a patch, from step to step.
struct SkinHand {
  bool near = false;
  /// It came about under the skin, or through a portal: not felt before it has been out.
  bool barred = false;
  std::uint32_t instrument = 0;
  SkinContact contact;                 ///< of the part that is deepest
  SheetPoint p = SheetPoint::Zero();   ///< where it presses, in the sheet at rest
  double radius_m = 0;                 ///< of the round tip as which it presses
  double yields_n_per_m = 0;           ///< of a slight push there; follows what is cut in 20 ms
  double entered_m = 0;                ///< of an edge: so far it has gone in
  bool cutting = false;                ///< the stroke in the sheet is this hand's
  std::uint64_t since_step = 0;        ///< of the stroke, or of the hole
  double stroke_m = 0, deepest_m = 0;  ///< of the stroke; how deep the shaft has been
  PierceState pierce;                  ///< of a tool that goes through
  double slit_m = 0;                   ///< in which it was set
  SheetPoint hole = SheetPoint::Zero();
  double pull_n = 0;             ///< most that the hole has held it back with
  bool in_wound = false;         ///< it stands between the lips of a cut that is held open
  std::uint32_t held_steps = 0;  ///< in which a portal has held it since it went through
  BandTouch touch;
};

/// All that happens to patches of skin: a value.
struct SkinState {
  std::vector<SkinPatchState> patches;
  std::array<std::array<SkinHand, kMaxSkins>, kMaxHands> hands{};
  SkinBare bares = SkinBare::kNone;
};

}  // namespace osteon
