#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "runs/pictures/xray_tally.h"
#include "ui/ui_layout.h"

namespace osteon {

/// How the user has turned the C-arm, degrees; see CArm.
struct CArmTurn {
  double orbit_deg = 0, tilt_deg = 0;
  bool operator==(const CArmTurn&) const = default;
};
inline constexpr double kMostOrbit_deg = 90, kMostTilt_deg = 45;

/// An X-ray picture that is kept.
struct ShotModel {
  std::uintptr_t thumbnail = 0;  ///< OpenGL's texture, square
  int number = 1;                ///< since the examination began
  CArmTurn turn;
  XrayExposure exposure;
  XrayDose dose;
  double time_s = 0;  ///< of the run, when it was taken
};

struct XrayModel {
  CArmTurn turn;                 ///< of the next picture
  std::vector<ShotModel> shots;  ///< the oldest first
  std::size_t shown = 0;         ///< which of them is in the picture
  XrayTally total;               ///< also of those that are kept no longer
};

struct XrayRequests {
  std::optional<CArmTurn> turn;
  std::optional<std::size_t> show;  ///< by place in XrayModel::shots
  bool begin_again = false;         ///< a new examination: no pictures, no dose
};

/// What a large X-ray pane holds: the picture, and the desk with controls, dose and earlier
/// pictures: beside it where that leaves the picture larger, else under it. `scale` as of
/// make_layout.
struct XrayPlaces {
  UiRect picture, desk;
  bool beside = true;
  bool strip_below = false;  ///< under it and too narrow for pictures beside controls and dose
};
XrayPlaces xray_places(const UiRect& pane, float scale);

}  // namespace osteon
