#pragma once

#include <vector>

#include "osteon/base/result.h"
#include "osteon/xray/c_arm.h"

namespace osteon {

/// How a tube was driven.
struct XrayExposure {
  double kv = 60;         ///< 40 to 120
  double mas = 0.05;      ///< charge of one shot, mA s
  int shots = 1;          ///< or pulses
  double pulse_s = 0.01;  ///< time of beam of each
};

/// What the patient is given, without scatter back from the body.
struct XrayDose {
  double air_kerma_mgy = 0;       ///< at kDoseDistance_m from the focus
  double kerma_area_mgy_cm2 = 0;  ///< air kerma times the area of the beam; the same at every
                                  ///< distance
  double beam_area_cm2 = 0;       ///< at kDoseDistance_m
  double seconds = 0;             ///< of beam
  int shots = 0;
};
inline constexpr double kDoseDistance_m = 0.75;

/// Air kerma at 750 mm, mGy for each mAs: 0.069 at 60 kV, 0.138 at 90, 0.224 at 120 (estimated);
/// straight between and beyond them in log-log.
double kerma_mgy_per_mas(double kv);
/// Of a beam that covers the whole detector.
XrayDose dose_of(const XrayExposure& exposure, const XrayView& view);

/// What automatic exposure drives the tube with: `clear_mas` when nothing is in the way, more as
/// less comes through, so that the middle of the detector gets as much light; at most `most_mas`.
/// `share` is the mean share that comes through there.
double automatic_mas(double share, double clear_mas = 0.02, double most_mas = 5);
/// Mean over the middle quarter of the picture.
double mean_in_middle(const std::vector<float>& values, int width);

}  // namespace osteon
