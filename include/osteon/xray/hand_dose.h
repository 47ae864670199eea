#pragma once

#include <vector>

#include "osteon/base/result.h"
#include "osteon/xray/areal_density.h"
#include "osteon/xray/c_arm.h"
#include "osteon/xray/dose.h"

namespace osteon {

/// Air kerma that tissue scatters to a place 1 m off, as a share of the air kerma that 400 cm2 of
/// it are given: by the tube's voltage and by the angle between the beam and the way to the place
/// (0: onwards, away from the tube). NCRP report 49 (1976), table B-2, after Trout and Kelley
/// (Radiology 104:161, 1972): 50 to 125 kV, 30 to 135 degrees; straight between its values, and the
/// nearest beyond them.
double scatter_fraction(double kv, double angle_rad);
inline constexpr double kScatterArea_cm2 = 400;

/// A part of the patient that the beam goes through.
struct Irradiated {
  Vec3 p_W = Vec3::Zero();
  double kap_mgy_cm2 = 0;  ///< that it is given
};
/// Of a beam that covers the whole detector: places in the plane at right angles to the beam at
/// `depth_m` from the source, where rays meet tissue. `density`: that of the view.
std::vector<Irradiated> irradiated_parts(const XrayView& view, const ArealDensity& density,
                                         const XrayDose& dose, double depth_m);
/// Air kerma at a place that scatters from them: each by the inverse square of its distance. A
/// place nearer than kScatterNearest_m is taken as that far off: so near, tissue is no point.
double scattered_mgy(const std::vector<Irradiated>& parts, const XrayView& view, double kv,
                     const Vec3& p_W);
inline constexpr double kScatterNearest_m = 0.03;

/// What a hand is given, as air kerma in its middle.
struct HandDose {
  Vec3 hand_W = Vec3::Zero();
  bool in_beam = false;
  double direct_mgy = 0;     ///< of the beam, behind what of the patient lies before the hand
  double scattered_mgy = 0;  ///< from the patient, in the beam or out of it
  double total_mgy() const { return direct_mgy + scattered_mgy; }
};
/// `patient`: without the instruments, whose steel would hide the hand that holds them. `density`:
/// of the view. Fails on a place that is not finite or a voltage out of range.
Result<HandDose> hand_dose(const XrayBody& patient, const XrayView& view,
                           const ArealDensity& density, const XrayExposure& exposure,
                           const Vec3& hand_W, double depth_m);

}  // namespace osteon
