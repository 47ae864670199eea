#include "osteon/xray/hand_dose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "osteon/xray/picture.h"

namespace osteon {
namespace {

constexpr std::array<double, 4> kKv = {50, 70, 100, 125};
constexpr std::array<double, 6> kAngle_deg = {30, 45, 60, 90, 120, 135};
constexpr std::array<std::array<double, 6>, 4> kFraction = {{
    {0.0005, 0.0002, 0.00025, 0.00035, 0.0008, 0.0010},
    {0.00065, 0.00035, 0.00035, 0.0005, 0.0010, 0.0013},
    {0.0015, 0.0012, 0.0012, 0.0013, 0.0020, 0.0022},
    {0.0018, 0.0015, 0.0015, 0.0015, 0.0023, 0.0025},
}};

/// Between which two of a rising table's values x lies, and how far.
template <std::size_t N>
std::pair<std::size_t, double> place_in(const std::array<double, N>& table, double x) {
  std::size_t k = 0;
  while (k + 2 < N && x > table[k + 1]) ++k;
  return {k, std::clamp((x - table[k]) / (table[k + 1] - table[k]), 0.0, 1.0)};
}

bool is_in_beam(const XrayView& view, const Vec3& p_W) {
  const double along = (p_W - view.source_W).dot(view.normal_W());
  const auto pixel = project(view, p_W);
  return pixel && along < view.source_detector_m() && pixel->column >= -0.5 && pixel->row >= -0.5 &&
         pixel->column <= view.width - 0.5 && pixel->row <= view.height - 0.5;
}

/// A detector of one pixel in a place: what lies before it is what its ray meets.
XrayView view_of_place(const XrayView& view, const Vec3& p_W) {
  XrayView out;
  out.source_W = view.source_W;
  out.detector_center_W = p_W;
  const Vec3 along = (p_W - view.source_W).normalized();
  out.u_W = (view.u_W - along * along.dot(view.u_W)).normalized();
  out.v_W = along.cross(out.u_W);
  out.pixel_m = view.pixel_m;
  out.width = out.height = 1;
  return out;
}

Result<double> share_before(const XrayBody& patient, const XrayView& view, double kv,
                            const Vec3& p_W) {
  constexpr double kAtTheTube_m = 0.05;  // nothing lies before a hand there
  if (patient.layers.empty() || (p_W - view.source_W).norm() < kAtTheTube_m) return 1.0;
  const auto spectrum = tube_spectrum(kv);
  if (!spectrum) return tl::unexpected(spectrum.error());
  const auto density = areal_density(patient, view_of_place(view, p_W));
  if (!density) return tl::unexpected(density.error());
  return static_cast<double>(transmitted(*density, *spectrum).front());
}

}  // namespace

double scatter_fraction(double kv, double angle_rad) {
  const auto [row, down] = place_in(kKv, kv);
  const auto [column, across] = place_in(kAngle_deg, angle_rad * 180 / std::numbers::pi);
  const auto at = [&, column = column, across = across](std::size_t r) {
    return std::lerp(kFraction[r][column], kFraction[r][column + 1], across);
  };
  return std::lerp(at(row), at(row + 1), down);
}

std::vector<Irradiated> irradiated_parts(const XrayView& view, const ArealDensity& density,
                                         const XrayDose& dose, double depth_m) {
  constexpr int kAcross = 16;
  constexpr float kTissue_g_per_cm2 = 0.05f;  // half a millimetre of it
  const std::vector<float> mass = density.total();
  std::vector<double> covered(kAcross * kAcross, 0);
  for (int row = 0; row < view.height; ++row)
    for (int column = 0; column < view.width; ++column)
      if (mass[static_cast<std::size_t>(row) * static_cast<std::size_t>(view.width) +
               static_cast<std::size_t>(column)] > kTissue_g_per_cm2)
        covered[static_cast<std::size_t>(row * kAcross / view.height * kAcross +
                                         column * kAcross / view.width)] += 1;
  const double each_mgy_cm2 =
      dose.kerma_area_mgy_cm2 / (static_cast<double>(view.width) * view.height);
  std::vector<Irradiated> parts;
  for (int k = 0; k < kAcross * kAcross; ++k) {
    const double pixels = covered[static_cast<std::size_t>(k)];
    if (!(pixels > 0)) continue;
    const double column = (k % kAcross + 0.5) / kAcross * view.width - 0.5;
    const double row = (k / kAcross + 0.5) / kAcross * view.height - 0.5;
    const Vec3 way = view.pixel_W(column, row) - view.source_W;
    parts.push_back(
        {view.source_W + way * (depth_m / way.dot(view.normal_W())), pixels * each_mgy_cm2});
  }
  return parts;
}

double scattered_mgy(const std::vector<Irradiated>& parts, const XrayView& view, double kv,
                     const Vec3& p_W) {
  double sum = 0;
  for (const Irradiated& part : parts) {
    const Vec3 beam = part.p_W - view.source_W, way = p_W - part.p_W;
    const double distance_m = std::max(way.norm(), kScatterNearest_m);
    const double angle = std::atan2(beam.cross(way).norm(), beam.dot(way));
    sum += scatter_fraction(kv, angle) * part.kap_mgy_cm2 /
           (kScatterArea_cm2 * distance_m * distance_m);
  }
  return sum;
}

Result<HandDose> hand_dose(const XrayBody& patient, const XrayView& view,
                           const ArealDensity& density, const XrayExposure& exposure,
                           const Vec3& hand_W, double depth_m) {
  if (!is_finite(hand_W)) return fail("is not a position in World", "a hand");
  const XrayDose dose = dose_of(exposure, view);
  HandDose out;
  out.hand_W = hand_W;
  out.in_beam = is_in_beam(view, hand_W);
  out.scattered_mgy =
      scattered_mgy(irradiated_parts(view, density, dose, depth_m), view, exposure.kv, hand_W);
  if (!out.in_beam) return out;
  const auto share = share_before(patient, view, exposure.kv, hand_W);
  if (!share) return tl::unexpected(share.error());
  const double away = kDoseDistance_m / (hand_W - view.source_W).norm();
  out.direct_mgy = dose.air_kerma_mgy * away * away * *share;
  return out;
}

}  // namespace osteon
