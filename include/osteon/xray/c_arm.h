#pragma once

#include <optional>

#include "osteon/base/result.h"
#include "osteon/base/types.h"

namespace osteon {

/// Which way a patient lies in World: unit, at right angles to each other.
struct PatientAxes {
  Vec3 up_W = Vec3::UnitY();        ///< upwards in every picture: a hand's fingers, a leg's hip
  Vec3 front_W = Vec3::UnitZ();     ///< out of the back of a hand, out of the front of a knee
  Vec3 outside_W = -Vec3::UnitX();  ///< to a hand's thumb, to the outer side of a knee
};

/// A source and a flat detector that face each other on an arm, which turns about the isocentre.
/// Orbit and angulation 0: the source stands in front (AP); orbit 90 degrees: on the outer side
/// (lateral); a positive angulation tips the source towards `up_W`.
struct CArm {
  double orbit_rad = 0;
  double angulation_rad = 0;
  double lift_m = 0;                    ///< of the whole arm, along World's z
  double source_detector_m = 1.0;       ///< from the focus to the middle of the detector
  double source_isocenter_m = 0.6;      ///< shorter than the above
  Vec3 isocenter_W = Vec3::Zero();      ///< at a lift of 0
  double detector_m = 0.23;             ///< width of the detector; a pixel is square
  int width_px = 512, height_px = 512;  ///< 1 to kMaxXraySide
};
inline constexpr int kMaxXraySide = 4096;

/// Where an X-ray picture is taken: pixel (column, row) has its middle at
/// detector_center + pixel (column - (width - 1) / 2) u + pixel (row - (height - 1) / 2) v.
struct XrayView {
  Vec3 source_W = Vec3::Zero();
  Vec3 detector_center_W = Vec3::UnitZ();
  Vec3 u_W = Vec3::UnitX();  ///< unit, to the picture's right
  Vec3 v_W = Vec3::UnitY();  ///< unit, down the picture; at right angles to u
  double pixel_m = 0.00045;  ///< at the detector
  int width = 512, height = 512;

  /// Unit, from the source to the detector.
  Vec3 normal_W() const { return u_W.cross(v_W); }
  double source_detector_m() const { return (detector_center_W - source_W).dot(normal_W()); }
  Vec3 pixel_W(double column, double row) const;
};

struct XrayPixel {
  double column = 0, row = 0;
};
/// Where a point of World falls on the picture, in pixels, whose middles are whole numbers; nothing
/// when it is not finite or does not lie in front of the source.
std::optional<XrayPixel> project(const XrayView& view, const Vec3& p_W);

/// Fails on a number that is not finite or out of range, and says which.
Result<XrayView> xray_view(const CArm& arm, const PatientAxes& patient);

}  // namespace osteon
