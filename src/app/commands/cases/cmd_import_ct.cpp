#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include "commands/support/parser.h"

#include "cases/import_ct.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/progress_line.h"
#include "commands/support/text_table.h"
#include "osteon/base/file.h"
#include "osteon/scene/case_io.h"

namespace osteon {
namespace {

struct ImportCtCommand {
  ImportCtOptions options;
  std::string source, out, json;
  std::vector<double> spacing_mm;
  double threshold_hu = 0, smooth_mm = 0;
  bool has_threshold = false;
};

std::string size_text(const GridFrame& frame) {
  const Vec3 mm = frame.spacing_m * 1000;
  char text[96];
  std::snprintf(text, sizeof text, "%d x %d x %d voxels of %.3g x %.3g x %.3g mm", frame.size[0],
                frame.size[1], frame.size[2], mm.x(), mm.y(), mm.z());
  return text;
}

void print_result(const ImportCtResult& result, const std::string& out) {
  TextTable table({"bone", "FMA", "volume cm3", "triangles", "closed"});
  for (std::size_t n = 0; n < result.bones.size(); ++n) {
    const ImportedCtBone& bone = result.bones[n];
    const int fma = result.def.bones[n].fma_id;
    table.add({bone.name, fma == 0 ? "-" : std::to_string(fma), fixed(bone.volume_m3 * 1e6, 3),
               std::to_string(bone.triangles), bone.closed ? "yes" : "no"});
  }
  std::fputs(table.text().c_str(), stdout);
  if (result.recognised)
    std::printf("a %s wrist; its bones are %s mm from the built-in ones on average\n",
                result.def.side.c_str(), fixed(result.fit_residual_m * 1000, 2).c_str());
  else
    std::printf("note: not recognised as a wrist, so bones are only numbered\n");
  if (result.parted) std::printf("note: split %d regions of joined bones\n", result.parted);
  if (result.gained + result.lost > 0)
    std::printf("note: contours added %zu voxels and removed %zu\n", result.gained, result.lost);
  if (result.outside)
    std::printf(
        "note: left out %zu part%s outside the body, such as a head rest (--keep-outside)\n",
        result.outside, result.outside == 1 ? "" : "s");
  if (result.left_out) std::printf("note: left out %zu smaller pieces (--most)\n", result.left_out);
  for (const std::string& finding : check_case(result.def))
    std::printf("note: %s\n", finding.c_str());
  std::printf("%zu bones above %.0f HU -> %s\n", result.bones.size(), result.threshold_hu,
              out.c_str());
}

std::string json_text(const ImportCtResult& result) {
  nlohmann::ordered_json json;
  json["voxels"] = result.frame.size;
  json["spacing_mm"] = {result.frame.spacing_m.x() * 1000, result.frame.spacing_m.y() * 1000,
                        result.frame.spacing_m.z() * 1000};
  json["threshold_hu"] = result.threshold_hu;
  json["soft_hu"] = result.soft_hu;
  json["recognised"] = result.recognised ? "wrist" : "";
  json["side"] = result.def.side;
  if (result.recognised) json["fit_residual_mm"] = result.fit_residual_m * 1000;
  const Pose& X = result.X_WP;
  json["world_from_patient"] = {{"position_m", {X.p.x(), X.p.y(), X.p.z()}},
                                {"rotation_wxyz", {X.q.w(), X.q.x(), X.q.y(), X.q.z()}}};
  json["parted_regions"] = result.parted;
  json["joined_regions"] = result.joined;
  json["left_out"] = result.left_out;
  json["outside_body"] = result.outside;
  json["contours"] = {{"gained_voxels", result.gained}, {"lost_voxels", result.lost}};
  for (const ImportedCtBone& bone : result.bones)
    json["bones"][bone.name] = {{"volume_mm3", bone.volume_m3 * 1e9},
                                {"triangles", bone.triangles},
                                {"closed", bone.closed}};
  return json.dump(2) + "\n";
}

int run_import_ct(ImportCtCommand command) {
  ImportCtOptions& options = command.options;
  options.source = command.source;
  options.out = command.out;
  options.smooth_m = command.smooth_mm / 1000;
  if (command.has_threshold) options.threshold_hu = command.threshold_hu;
  if (!command.spacing_mm.empty())
    options.spacing_m =
        Vec3(command.spacing_mm[0], command.spacing_mm[1], command.spacing_mm[2]) / 1000;
  options.announce = [](const GridFrame& frame, double bytes) {
    std::fprintf(stderr, "%s; up to %.1f GB of memory\n", size_text(frame).c_str(), bytes / 1e9);
    return true;
  };
  Result<ImportCtResult> result = fail("not run");
  {
    ProgressLine line;
    options.progress = line.callback();
    result = import_ct(options);
  }
  if (!result) return report_error(result.error());
  print_result(*result, command.out);
  if (command.json.empty()) return kExitDone;
  const auto saved = write_file_atomic(command.json, json_text(*result));
  return saved ? kExitDone : report_error(saved.error());
}

}  // namespace

void add_import_ct_command(cli::App& app, int& exit_code) {
  cli::App* ct = app.get_subcommand("import")->add_subcommand(
      "ct", "Make a case from a CT scan: find, separate and name the bones");
  auto command = std::make_shared<ImportCtCommand>();
  ct->add_option("source", command->source,
                 "a DICOM folder or file, .nrrd, .nii, .nii.gz, .mhd, .mha, .inv3, or a folder of "
                 "PNG or TIFF slices")
      ->required();
  ct->add_option("--out", command->out, "the case folder to make")->required();
  ct->add_option("--name", command->options.name, "name of the case; default: the folder's name");
  ct->add_option("--side", command->options.side,
                 "left or right; default: the side that is recognised")
      ->check(cli::IsMember({"left", "right"}));
  ct->add_option("--series", command->options.series,
                 "number or UID of the series, where a folder has several");
  auto* threshold = ct->add_option("--threshold", command->threshold_hu,
                                   "threshold of bone, HU; default: estimated from the scan");
  ct->add_option("--spacing", command->spacing_mm,
                 "distances X,Y,Z between voxels, mm, for PNG and TIFF slices")
      ->delimiter(',')
      ->expected(3);
  ct->add_option("--smooth", command->smooth_mm, "blur against noise, mm")
      ->check(cli::Range(0.0, 5.0));
  ct->add_option("--contours", command->options.contour_steps,
                 "steps of active contours, which move the bones' outlines onto the edges in each "
                 "slice; 15 is usual")
      ->check(cli::Range(0, 1000))
      ->capture_default_str();
  ct->add_option("--most", command->options.most_bones, "keep this many of the largest bones")
      ->check(cli::Range(std::size_t{1}, kMaxBones))
      ->capture_default_str();
  ct->add_flag("--keep-outside", command->options.outside,
               "keep bright parts outside the body too, such as a head rest or a cast");
  ct->add_option("--json", command->json, "write the findings to this JSON file");
  ct->callback([command, threshold, &exit_code] {
    command->has_threshold = threshold->count() > 0;
    exit_code = run_import_ct(*command);
  });
}

}  // namespace osteon
