#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "osteon/base/types.h"
#include "osteon/scene/loose_bone.h"
#include "osteon/scene/soft_band.h"
#include "osteon/scene/soft_solid.h"
#include "osteon/scene/state.h"

namespace osteon {

class PieceShape;
struct CarveState;
struct SkinCuts;

/// A dent of a patch of skin, where a part of a tool presses it.
struct SkinDent {
  std::uint32_t patch = 0;
  Eigen::Vector2d p = Eigen::Vector2d::Zero();  ///< in the sheet at rest
  double deep_m = 0;
  double radius_m = 0;  ///< of the round tip as which it presses
  bool operator==(const SkinDent&) const = default;
};

/// How a tool draws a lip of cut skin aside.
struct SkinLipPull {
  std::uint32_t patch = 0;
  Eigen::Vector2d p = Eigen::Vector2d::Zero();    ///< on the cut, in the sheet at rest
  Eigen::Vector2d out = Eigen::Vector2d::Zero();  ///< unit, from the groove into the skin
  double force_n = 0;
  bool operator==(const SkinLipPull&) const = default;
};

/// How a part of a tool bends a band now. The string goes in two straight legs from its ends to the
/// place that is pressed.
struct StringBend {
  std::uint32_t band = 0;
  double share = 0;              ///< of the way from the first end to the last: where it is pressed
  double bent_m = 0;             ///< against nhat_W, of the middle line there
  double dent_m = 0;             ///< of the surface, over that
  double round_m = 0;            ///< radius of the bend: of the part and the band together
  Vec3 nhat_W = Vec3::UnitZ();   ///< unit, from the band to the part
  Vec3 along_W = Vec3::UnitX();  ///< unit, from the first end to the last, as the bones stand
  bool operator==(const StringBend&) const = default;
};

/// A band that was cut in two or has torn.
struct BandBreak {
  std::uint32_t band = 0;
  double share = 0.5;  ///< of the way from the first end to the last
  bool operator==(const BandBreak&) const = default;
};

/// A band of which some strands are cut or have torn (physics/soft/band_strands.h).
struct BandNotch {
  std::uint32_t band = 0;
  double share = 0.5;  ///< of the way from the first end to the last
  std::uint64_t gone = 0;
  bool operator==(const BandNotch&) const = default;
};

/// A soft part that hands press or pull now, or of which some strands are gone.
struct SoftLoad {
  std::uint32_t soft = 0;                   ///< in Case::softs
  std::array<double, kMaxHands> force_n{};  ///< of each hand on it
  double tension_n = -1;                    ///< of a band; below 0: it is none
  double left = 1;                          ///< of a band, the share of its strands
  bool operator==(const SoftLoad&) const = default;
};

/// What presses the soft parts now and what is in two, for pictures: of every hand's parts.
struct SoftPushes {
  struct One {
    std::uint32_t solid = 0;
    Vec3 p_B = Vec3::Zero(), nhat_B = Vec3::UnitZ();
    double force_n = 0;  ///< against the normal
    bool operator==(const One&) const = default;
  };
  static constexpr std::size_t kMost = 4 * (kMaxSolidContacts + 1);  // jaws, too
  static constexpr std::size_t kMostBends = 4 * (kMaxBandContacts + 1);
  std::uint32_t count = 0;
  std::array<One, kMost> all{};
  std::uint32_t bend_count = 0;
  std::array<StringBend, kMostBends> bends{};
  std::uint32_t break_count = 0;
  std::array<BandBreak, kMaxBands> breaks{};
  std::uint32_t notch_count = 0;
  std::array<BandNotch, kMaxBands> notches{};
  static constexpr std::size_t kMostLoads = kMaxBands + kMaxSolids + kMaxSkins;
  std::uint32_t load_count = 0;
  std::array<SoftLoad, kMostLoads> loads{};
  /// What was cut out of each solid, anew when it changed; null: nothing.
  std::array<std::shared_ptr<const CarveState>, kMaxSolids> cuts{};
  /// Of each patch of skin, anew when it changed; null: none is felt.
  std::array<std::shared_ptr<const SkinCuts>, kMaxSkins> skin_cuts{};
  /// Pieces of solids that lie loose now; where they lie is in the bones' snapshot.
  std::uint32_t piece_count = 0;
  std::array<std::shared_ptr<const PieceShape>, kMaxLooseSofts> pieces{};
  MadePortals made{};  ///< holes in skin that hold shafts
  std::uint32_t skin_count = 0;
  std::array<SkinDent, 4 * kMaxSkins> skin_dents{};
  static constexpr std::size_t kMostLipPulls = 64;
  std::uint32_t lip_count = 0;
  std::array<SkinLipPull, kMostLipPulls> lip_pulls{};
  bool operator==(const SoftPushes&) const = default;
};

}  // namespace osteon
