#include "osteon/xray/c_arm.h"

#include <cmath>
#include <numbers>
#include <string>

namespace osteon {
namespace {

Result<void> check_arm(const CArm& arm) {
  const std::string where = "the C-arm";
  for (const double angle : {arm.orbit_rad, arm.angulation_rad})
    if (!(std::abs(angle) <= 2 * std::numbers::pi))
      return fail("orbit and angulation must lie between -360 and 360 degrees", where);
  if (!(std::abs(arm.lift_m) <= 2)) return fail("the lift must lie within 2 m", where);
  if (!(arm.source_detector_m >= 0.1 && arm.source_detector_m <= 5))
    return fail("the distance from source to detector must be 0.1 to 5 m", where);
  if (!(arm.source_isocenter_m > 0 && arm.source_isocenter_m < arm.source_detector_m))
    return fail("the isocentre must lie between source and detector", where,
                "Give it a distance to the source above 0 and below that of the detector");
  if (!is_finite(arm.isocenter_W) || !(arm.isocenter_W.cwiseAbs().maxCoeff() <= 100))
    return fail("the isocentre must lie within 100 m of World's origin", where);
  if (!(arm.detector_m >= 0.01 && arm.detector_m <= 1))
    return fail("the detector must be 10 to 1000 mm wide", where);
  for (const int side : {arm.width_px, arm.height_px})
    if (side < 1 || side > kMaxXraySide)
      return fail("a picture must have 1 to " + std::to_string(kMaxXraySide) + " pixels a side",
                  where);
  return {};
}

}  // namespace

Vec3 XrayView::pixel_W(double column, double row) const {
  return detector_center_W + pixel_m * (column - 0.5 * (width - 1)) * u_W +
         pixel_m * (row - 0.5 * (height - 1)) * v_W;
}

std::optional<XrayPixel> project(const XrayView& view, const Vec3& p_W) {
  if (!is_finite(p_W)) return std::nullopt;
  const Vec3 from_source = p_W - view.source_W;
  const Vec3 n = view.normal_W();
  const double share = from_source.dot(n) / view.source_detector_m();
  if (!(share > 0)) return std::nullopt;
  const Vec3 on_detector = from_source / share - (view.detector_center_W - view.source_W);
  return XrayPixel{on_detector.dot(view.u_W) / view.pixel_m + 0.5 * (view.width - 1),
                   on_detector.dot(view.v_W) / view.pixel_m + 0.5 * (view.height - 1)};
}

Result<XrayView> xray_view(const CArm& arm, const PatientAxes& patient) {
  if (auto ok = check_arm(arm); !ok) return tl::unexpected(ok.error());
  const double o = arm.orbit_rad, a = arm.angulation_rad;
  const Vec3 around_W = std::cos(o) * patient.front_W + std::sin(o) * patient.outside_W;
  const Vec3 to_source_W = std::cos(a) * around_W + std::sin(a) * patient.up_W;
  const Vec3 isocenter_W = arm.isocenter_W + arm.lift_m * Vec3::UnitZ();
  XrayView view;
  view.source_W = isocenter_W + arm.source_isocenter_m * to_source_W;
  view.detector_center_W = view.source_W - arm.source_detector_m * to_source_W;
  view.u_W = patient.up_W.cross(around_W).normalized();
  view.v_W = view.u_W.cross(to_source_W).normalized();
  view.pixel_m = arm.detector_m / arm.width_px;
  view.width = arm.width_px;
  view.height = arm.height_px;
  return view;
}

}  // namespace osteon
