#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "osteon/scene/event.h"

namespace osteon {

// Codes of events that who watches tunnels being located makes; the session makes none of them.
/// A tool presses next to a landmark: {distance mm; force N; 0}.
inline constexpr EventKind kMarkFelt{431};
/// The line of a tunnel is about to be fixed; told of every landmark.
inline constexpr EventKind kTunnelBegun{432};
/// The line of a tunnel in a bone is fixed: {its length mm; 0; 0}.
inline constexpr EventKind kTunnelLocated{433};
/// What was measured, of the hand itself: {a TunnelValue; the value; 0}.
inline constexpr EventKind kTunnelMeasured{434};
/// A graft between both tunnels was tested, of the hand itself: {Lachman beyond that of the whole
/// knee, mm; 0; 0}.
inline constexpr EventKind kGraftTested{435};

/// A tunnel was drilled, and measured from the bone that is left: {its length mm; its width mm; 1
/// where it opens on both sides, else 0}.
inline constexpr EventKind kTunnelDrilled{441};
/// The same of a socket: {its depth mm; its width mm; width mm of a narrower channel that goes on
/// to the far side, 0: none}.
inline constexpr EventKind kSocketDrilled{442};
/// A drill works in a bone without a pin that leads it: {how deep mm; 0; 0}.
inline constexpr EventKind kDrilledFree{443};
/// A drill under power has gone beyond a bone's far side: {how far mm; 0; 0}.
inline constexpr EventKind kDrillPlunged{444};
/// A drill has gone 3 mm into a bone, with a pin or without; once for each bone: {0; 0; 0}.
inline constexpr EventKind kBoneDrilled{446};

/// What is measured of tunnels and of the graft between them.
enum class TunnelValue : std::uint8_t {
  kFemoralDepth,
  kFemoralHeight,
  kFemoralOff,
  kFemoralClock,
  kFemoralChannel,
  kFemoralSocket,
  kBackWall,
  kAmisJakob,
  kTibialMedial,
  kTibialLength,
  kBehindRoof,
  kExcursion,
  kLachman,
  kPivot,
  kFemoralToOld,  ///< bone between a new tunnel and one that was there before
  kTibialToOld
};
/// By TunnelValue: names with their units, each of a rule `outside_NAME` for errors.
inline constexpr std::array<std::string_view, 16> kTunnelValueNames{
    "femoral_depth_pct",     "femoral_height_pct",  "femoral_off_mm",    "femoral_from_roof_deg",
    "femoral_channel_mm",    "femoral_socket_mm",   "back_wall_mm",      "amis_jakob_pct",
    "tibial_medial_pct",     "tibial_length_mm",    "behind_roof_mm",    "graft_excursion_mm",
    "lachman_difference_mm", "pivot_difference_mm", "femoral_to_old_mm", "tibial_to_old_mm"};

}  // namespace osteon
