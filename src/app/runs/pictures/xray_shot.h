#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/render/renderer.h"
#include "osteon/scene/tool.h"
#include "osteon/xray/case_body.h"
#include "osteon/xray/dose.h"
#include "osteon/xray/hand_dose.h"
#include "osteon/xray/picture.h"

namespace osteon {

/// What stands in the beam.
struct XrayScene {
  XrayBody body;
  XrayBody without_tools;     ///< the same without instruments
  std::vector<Vec3> hands_W;  ///< middles of the hands that hold instruments, in their order
  PatientAxes patient;
  Vec3 isocenter_W = Vec3::Zero();  ///< the middle of the joint
};

/// A case by its name, bent where asked for, or a recording (a file that ends in .osr) as it stood
/// `at_s` after its begin, at its end without: with the instrument, which is of steel.
struct XraySceneOrder {
  std::string source;
  std::optional<double> at_s, flexion_deg;
  CaseBodyOptions body;
};
Result<XrayScene> open_xray_scene(const XraySceneOrder& order);

struct XrayShotOrder {
  CArm arm;
  double kv = 60;
  std::optional<double> mas;  ///< none: automatic
  double pulse_s = 0.01;
  int shots = 1;
  bool noise = true;
  std::uint64_t seed = 1;
};

/// A picture with all that is known of it.
struct XrayShot {
  XrayView view;
  ArealDensity density;
  std::vector<float> grey;  ///< 0..1, bone dark
  XrayWindow window;
  XrayExposure exposure;
  XrayDose dose;
  std::vector<HandDose> hands;  ///< of XrayScene::hands_W
};
/// Fails on an arm, a voltage or a count out of range.
Result<XrayShot> take_shot(const XrayScene& scene, const XrayShotOrder& order);

/// 8 bits, bone dark unless `inverted`.
Image grey_image(const XrayShot& shot, bool inverted = false);

/// Where the hand is that holds an instrument, in Tool: 50 mm from the far end of what is drawn,
/// but never nearer to the tip than half of it.
Vec3 hand_on(const Tool& tool);

/// "orbit=30,angulation=-10": degrees; lift, distance (source to detector), source (source to
/// isocentre) and field (width of the detector): millimetres. What is not named stays.
Result<CArm> parse_c_arm(const std::string& text, CArm arm);

/// Writes the areal density's rows as little-endian 32-bit floats, and beside them FILE.json with
/// where the picture lies in World.
Result<void> write_raw_density(const XrayShot& shot, const std::string& file);
/// Geometry, exposure, brightness and dose as JSON text.
std::string to_json(const XrayShot& shot);

}  // namespace osteon
