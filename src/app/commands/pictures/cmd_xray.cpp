#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>
#include <vector>
#include "commands/support/parser.h"

#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/render_options.h"
#include "osteon/image/dicom_xray.h"
#include "osteon/render/renderer.h"
#include "runs/pictures/xray_shot.h"

namespace osteon {
namespace {

struct XrayCommand {
  XraySceneOrder scene;
  XrayShotOrder shot;
  std::string view = "ap", arm, size = "512x512", noise = "on", out, raw;
  std::vector<double> isocenter_mm;
  double pulse_ms = 10;
  bool inverted = false, json = false;
};

Result<void> set_arm(XrayCommand& command, const XrayScene& scene) {
  const auto size = parse_picture_size(command.size);
  if (!size) return tl::unexpected(size.error());
  CArm arm;
  arm.width_px = size->width;
  arm.height_px = size->height;
  arm.isocenter_W = scene.isocenter_W;
  if (command.isocenter_mm.size() == 3) arm.isocenter_W = 0.001 * Vec3(command.isocenter_mm.data());
  if (command.view == "lateral") arm.orbit_rad = std::numbers::pi / 2;
  const auto parsed = parse_c_arm(command.arm, arm);
  if (!parsed) return tl::unexpected(parsed.error());
  command.shot.arm = *parsed;
  return {};
}

XrayFilm film_of(const XrayShot& shot, const CArm& arm, bool inverted) {
  XrayFilm film{shot.view.width, shot.view.height, shot.grey};
  if (inverted)
    for (float& grey : film.grey) grey = 1 - grey;
  film.kv = shot.exposure.kv;
  film.mas = shot.exposure.mas;
  film.exposure_s = shot.exposure.pulse_s;
  film.source_detector_m = arm.source_detector_m;
  film.source_isocenter_m = arm.source_isocenter_m;
  film.pixel_m = shot.view.pixel_m;
  film.orbit_rad = arm.orbit_rad;
  film.angulation_rad = arm.angulation_rad;
  film.kerma_area_mgy_cm2 = shot.dose.kerma_area_mgy_cm2;
  return film;
}

Result<void> write_out(const XrayCommand& command, const XrayShot& shot) {
  if (command.out.empty()) return {};
  if (std::filesystem::path(command.out).extension() == ".png")
    return save_png(grey_image(shot, command.inverted), command.out);
  XrayFilmOptions options;
  options.seed = command.shot.seed;
  return write_dicom_xray(film_of(shot, command.shot.arm, command.inverted), command.out, options);
}

Result<void> check_files(const XrayCommand& command) {
  if (command.out.empty() && command.raw.empty())
    return fail("no output is given", "osteon xray", "Give --out or --raw");
  const auto kind = std::filesystem::path(command.out).extension();
  if (!command.out.empty() && kind != ".png" && kind != ".dcm")
    return fail("must end in .png or .dcm", command.out);
  return {};
}

Result<XrayShot> run(XrayCommand& command) {
  if (auto ok = check_files(command); !ok) return tl::unexpected(ok.error());
  const auto scene = open_xray_scene(command.scene);
  if (!scene) return tl::unexpected(scene.error());
  if (auto ok = set_arm(command, *scene); !ok) return tl::unexpected(ok.error());
  command.shot.noise = command.noise == "on";
  command.shot.pulse_s = command.pulse_ms / 1000;
  auto shot = take_shot(*scene, command.shot);
  if (!shot) return shot;
  if (auto ok = write_out(command, *shot); !ok) return tl::unexpected(ok.error());
  if (!command.raw.empty())
    if (auto ok = write_raw_density(*shot, command.raw); !ok) return tl::unexpected(ok.error());
  return shot;
}

int run_xray(XrayCommand& command) {
  const auto shot = run(command);
  if (!shot) return report_error(shot.error());
  if (command.json) {
    std::fputs(to_json(*shot).c_str(), stdout);
    return kExitDone;
  }
  std::printf("%s: %g kV, %.3g mAs, air kerma %.3g mGy at 750 mm, %.3g mGy cm2, %d shots, %g s\n",
              command.scene.source.c_str(), shot->exposure.kv, shot->exposure.mas,
              shot->dose.air_kerma_mgy, shot->dose.kerma_area_mgy_cm2, shot->dose.shots,
              shot->dose.seconds);
  for (std::size_t h = 0; h < shot->hands.size(); ++h) {
    const HandDose& hand = shot->hands[h];
    std::printf("hand %zu, %s the beam: %.3g mGy (%.3g direct, %.3g scattered)\n", h,
                hand.in_beam ? "in" : "beside", hand.total_mgy(), hand.direct_mgy,
                hand.scattered_mgy);
  }
  return kExitDone;
}

void add_beam_options(cli::App& xray, XrayCommand& c) {
  xray.add_option("--kv", c.shot.kv, "voltage of the tube, 40 to 120 kV")->capture_default_str();
  xray.add_option("--mas", c.shot.mas,
                  "tube current times exposure time of a shot, mAs; default: automatic");
  xray.add_option("--shots", c.shot.shots, "number of shots or pulses, for the dose")
      ->capture_default_str();
  xray.add_option("--pulse", c.pulse_ms, "length of each shot or pulse, ms")->capture_default_str();
  xray.add_option("--noise", c.noise, "noise of the detector, on or off")
      ->check(cli::IsMember({"on", "off"}))
      ->capture_default_str();
  xray.add_option("--seed", c.shot.seed, "seed of the noise: the same seed gives the same noise")
      ->capture_default_str();
}

void add_place_options(cli::App& xray, XrayCommand& c) {
  xray.add_option("--view", c.view, "ap or lateral")
      ->check(cli::IsMember({"ap", "lateral"}))
      ->capture_default_str();
  xray.add_option(
      "--c-arm", c.arm,
      "turn the C-arm away from --view: orbit=DEG,angulation=DEG. Move it, in mm: lift=, "
      "distance= (source to detector), source= (source to isocentre), field= (width of "
      "the detector)");
  xray.add_option("--isocenter", c.isocenter_mm,
                  "point that the C-arm turns about: x,y,z in World, mm; default: the joint")
      ->delimiter(',')
      ->expected(3);
  xray.add_option("--size", c.size, "width x height in pixels")->capture_default_str();
  xray.add_option("--at", c.scene.at_s,
                  "time in a recording, seconds from its start; default: its end");
  xray.add_option("--flexion", c.scene.flexion_deg, "flexion of a generated knee, degrees");
}

}  // namespace

void add_xray_command(cli::App& app, int& exit_code) {
  auto command = std::make_shared<XrayCommand>();
  cli::App* xray =
      app.add_subcommand("xray", "Take an X-ray picture of a case, or of a moment of a recording");
  xray->add_option("case", command->scene.source,
                   "a case folder, builtin:wrist, builtin:knee or a recording (.osr)")
      ->required();
  add_place_options(*xray, *command);
  add_beam_options(*xray, *command);
  xray->add_option(
      "--hu", command->scene.body.bones_hu,
      "make every bone of one material with this CT value (HU) and leave out everything else");
  xray->add_flag("--invert", command->inverted, "show bone bright, as on a film");
  xray->add_option("--out", command->out, "picture to write: .png or .dcm (DICOM XA)");
  xray->add_option("--raw", command->raw,
                   "file to write the mass along each ray to, g/cm2: 32-bit floats, described in "
                   "FILE.json");
  xray->add_flag("--json", command->json, "print geometry, exposure and dose as JSON");
  xray->callback([command, &exit_code] { exit_code = run_xray(*command); });
}

}  // namespace osteon
