#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "osteon/scene/soft_band.h"
#include "osteon/scene/soft_hold.h"
#include "osteon/scene/state.h"

namespace osteon {

struct FallenPiecesState;
struct SoftCutState;
struct SkinState;

/// A part of a tool near a band, from step to step.
struct NearBand {
  BandContact contact;
  bool touching = false;
  /// It came about inside the band, or went too deep: not felt before it has been out of it.
  bool barred = false;
  bool behind = false;  ///< another part presses from the same side, deeper: that one is felt
  double deep_m = 0;    ///< how far it has come over the surface of the band at rest
  double taken_m = 0;   ///< length of the string's path that it takes
  /// How it bends the string there, and how far along the straight way.
  Vec3 bend_W = Vec3::Zero();
  double at_share = 0.5;
};

/// A hand on a band: for the events.
struct BandTouch {
  bool on = false, over = false;
  std::uint64_t first_step = 0, last_step = 0;
  double peak_n = 0, deepest_m = 0;
};

struct SoftHandState {
  std::uint32_t instrument = 0, count = 0;
  std::array<NearBand, kMaxBandContacts> near{};
  std::array<BandTouch, kMaxBands> touches{};
};

/// A part of a tool near a solid, from step to step.
struct SolidNear {
  SolidContact contact;
  /// Where the middle of the part's axis would be, were the solid rigid: it stays outside of it, on
  /// the side where the part came.
  Vec3 outside_B = Vec3::Zero();
  Vec3 slid_B = Vec3::Zero();  ///< the way of that place in this step
  bool touching = false;
  bool barred = false;  ///< as of NearBand
  bool behind = false;  ///< another part of the tool presses the same place deeper
  double deep_m = 0, force_n = 0;
  double entered_m = 0;  ///< of a blade: so far its edge has gone in
};

/// A hand on the solids: which parts are near, and for the events.
struct SolidHandState {
  std::uint32_t instrument = 0, count = 0;
  std::array<SolidNear, kMaxSolidContacts> near{};
  std::array<BandTouch, kMaxSolids> touches{};
};

struct BandState {
  bool torn = false;
  std::uint64_t gone = 0;   ///< strands that are cut or torn (band_strands.h)
  double torn_share = 0.5;  ///< where it first lost one: of the way from its first end to its last
  bool lost = false;        ///< it could not be solved
};

/// What a hand's jaws hold, from step to step.
struct SoftGrip {
  bool jaw_open = false;  ///< they have been wide open since they last shut
  SoftHold hold;
  std::uint64_t first_step = 0;    ///< since when they hold it
  double force_n = 0;              ///< on the soft part in the last step
  double taken_m = 0;              ///< of a band: by so much its path is longer
  Vec3 against_B = Vec3::UnitZ();  ///< of a solid: unit, against the way that it is pulled
  double peak_n = 0, most_m = 0;   ///< since then; how far the jaws have gone with it
  Vec3 bend_W = Vec3::Zero();      ///< of a band: from its straight way to the held place
  bool operator==(const SoftGrip&) const = default;
};

/// All that a step of the soft parts leaves to the next: of fixed size.
struct SoftState {
  bool on = false;  ///< the session has soft parts
  std::array<BandState, kMaxBands> bands{};
  std::array<SoftHandState, kMaxHands> hands{};
  std::array<bool, kMaxSolids> solid_lost{};  ///< it could not be solved
  std::array<SolidHandState, kMaxHands> solid_hands{};
  std::array<SoftGrip, kMaxHands> grips{};
  std::shared_ptr<const SoftCutState> cut;  ///< of the solids; null: nothing cuts them
  std::shared_ptr<const SkinState> skin;    ///< null: no patch of skin is felt
  /// Of the solids, that lie loose; null: none does.
  std::shared_ptr<const FallenPiecesState> pieces;
};

}  // namespace osteon
