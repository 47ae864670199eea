#include "runs/pictures/xray_shot.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string_view>

#include "cases/all_cores.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegree = std::numbers::pi / 180;

Json in_mm(const Vec3& v) { return {1000 * v.x(), 1000 * v.y(), 1000 * v.z()}; }
Json numbers(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json geometry(const XrayView& view) {
  return {{"width", view.width},
          {"height", view.height},
          {"pixel_mm", 1000 * view.pixel_m},
          {"source_mm", in_mm(view.source_W)},
          {"detector_center_mm", in_mm(view.detector_center_W)},
          {"u_axis", numbers(view.u_W)},
          {"v_axis", numbers(view.v_W)}};
}

/// Where "name=" writes its number, and what one of its units is.
struct ArmKey {
  std::string_view name;
  double CArm::*field;
  double unit;
};
constexpr ArmKey kArmKeys[] = {{"orbit", &CArm::orbit_rad, kDegree},
                               {"angulation", &CArm::angulation_rad, kDegree},
                               {"lift", &CArm::lift_m, 0.001},
                               {"distance", &CArm::source_detector_m, 0.001},
                               {"source", &CArm::source_isocenter_m, 0.001},
                               {"field", &CArm::detector_m, 0.001}};

Result<void> set_key(const std::string& item, CArm& arm) {
  const std::size_t equals = item.find('=');
  const std::string name = item.substr(0, equals);
  for (const ArmKey& key : kArmKeys) {
    if (name != key.name || equals == std::string::npos) continue;
    double value = 0;
    const char *first = item.data() + equals + 1, *last = item.data() + item.size();
    const auto [end, bad] = std::from_chars(first, last, value);
    if (bad != std::errc{} || end != last || !std::isfinite(value))
      return fail("is not a number: '" + item.substr(equals + 1) + "'", "--c-arm " + name);
    arm.*key.field = value * key.unit;
    return {};
  }
  return fail("does not know '" + item + "'", "--c-arm",
              "Write orbit=, angulation=, lift=, distance=, source= or field= and a number, "
              "separated by commas");
}

Result<void> check(const XrayShotOrder& order) {
  if (order.shots < 1 || order.shots > 100000)
    return fail("must be 1 to 100000", "the number of shots");
  if (!(order.pulse_s >= 0.0001 && order.pulse_s <= 10))
    return fail("must be 0.1 to 10000 ms", "the length of a pulse");
  if (order.mas && !(*order.mas > 0 && *order.mas <= 1000))
    return fail("must be above 0 and at most 1000 mAs", "the exposure");
  return {};
}

void on_all_cores(std::size_t count, const std::function<void(std::size_t)>& task) {
  run_on_all_cores(count, task, [](double) {});
}

}  // namespace

Result<CArm> parse_c_arm(const std::string& text, CArm arm) {
  std::istringstream items(text);
  for (std::string item; std::getline(items, item, ',');)
    if (auto ok = set_key(item, arm); !ok) return tl::unexpected(ok.error());
  return arm;
}

Result<XrayShot> take_shot(const XrayScene& scene, const XrayShotOrder& order) {
  if (auto ok = check(order); !ok) return tl::unexpected(ok.error());
  const auto view = xray_view(order.arm, scene.patient);
  if (!view) return tl::unexpected(view.error());
  const auto spectrum = tube_spectrum(order.kv);
  if (!spectrum) return tl::unexpected(spectrum.error());
  auto density = areal_density(scene.body, *view, on_all_cores);
  if (!density) return tl::unexpected(density.error());
  XrayShot shot;
  shot.view = *view;
  shot.density = std::move(*density);
  const std::vector<float> through = transmitted(shot.density, *spectrum);
  const double automatic = automatic_mas(mean_in_middle(through, view->width));
  shot.exposure = {order.kv, order.mas.value_or(automatic), order.shots, order.pulse_s};
  shot.dose = dose_of(shot.exposure, *view);
  for (const Vec3& hand_W : scene.hands_W) {
    const auto hand = hand_dose(scene.without_tools, *view, shot.density, shot.exposure, hand_W,
                                order.arm.source_isocenter_m);
    if (!hand) return tl::unexpected(hand.error());
    shot.hands.push_back(*hand);
  }
  XrayDetector detector;
  detector.photons *= shot.exposure.mas / automatic;
  detector.noise = order.noise;
  detector.seed = order.seed;
  const std::vector<float> signal = detected(through, view->width, detector);
  shot.window = automatic_window(signal, shot.density);
  shot.grey = shown(signal, shot.window);
  return shot;
}

Image grey_image(const XrayShot& shot, bool inverted) {
  Image image{shot.view.width, shot.view.height, {}};
  image.rgb.reserve(3 * shot.grey.size());
  for (const float grey : shot.grey) {
    const auto byte = static_cast<std::uint8_t>(std::lround(255 * (inverted ? 1 - grey : grey)));
    image.rgb.insert(image.rgb.end(), 3, byte);
  }
  return image;
}

Result<void> write_raw_density(const XrayShot& shot, const std::string& file) {
  std::string bytes;
  for (const float value : shot.density.total()) {
    const auto word = std::bit_cast<std::uint32_t>(value);
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(word >> shift & 0xff);
  }
  if (auto ok = write_file_atomic(file, bytes); !ok) return ok;
  return write_file_atomic(file + ".json", geometry(shot.view).dump(2) + "\n");
}

namespace {

Json hands_json(const std::vector<HandDose>& hands) {
  Json out = Json::array();
  for (const HandDose& hand : hands)
    out.push_back({{"hand", out.size()},
                   {"at_mm", in_mm(hand.hand_W)},
                   {"in_beam", hand.in_beam},
                   {"direct_mgy", hand.direct_mgy},
                   {"scattered_mgy", hand.scattered_mgy},
                   {"total_mgy", hand.total_mgy()}});
  return out;
}

}  // namespace

std::string to_json(const XrayShot& shot) {
  Json json = geometry(shot.view);
  json["kv"] = shot.exposure.kv;
  json["mas"] = shot.exposure.mas;
  json["ma"] = shot.exposure.mas / shot.exposure.pulse_s;
  json["window"] = {{"dark", shot.window.dark}, {"bright", shot.window.bright}};
  json["dose"] = {{"air_kerma_mgy", shot.dose.air_kerma_mgy},
                  {"at_mm", 1000 * kDoseDistance_m},
                  {"beam_area_cm2", shot.dose.beam_area_cm2},
                  {"kap_mgy_cm2", shot.dose.kerma_area_mgy_cm2},
                  {"shots", shot.dose.shots},
                  {"seconds", shot.dose.seconds},
                  {"hands", hands_json(shot.hands)}};
  return json.dump(2) + "\n";
}

}  // namespace osteon
