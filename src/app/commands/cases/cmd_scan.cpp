#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>
#include "commands/support/parser.h"

#include "cases/open_case.h"
#include "cases/whole_folder.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/progress_line.h"
#include "osteon/anatomy/virtual_scan.h"
#include "osteon/image/dicom.h"
#include "osteon/image/tissue.h"
#include "osteon/scene/case_io.h"

namespace osteon {
namespace {

struct ScanCommand {
  std::string spec, out;
  double spacing_mm = 0.5, slice_mm = 0.5, psf_mm = 0.6, cortical_mm = 1.2;
  bool bones_only = false;
  ScanOptions options;
};

Result<Volume> scan_case(const ScanCommand& command) {
  const auto def = open_case_def(command.spec);
  if (!def) return tl::unexpected(def.error());
  const auto tissues = load_default_tissues();
  if (!tissues) return tl::unexpected(tissues.error());
  std::vector<ScannedBone> bones;
  for (const BoneDef& bone : def->bones) bones.push_back({&bone.mesh, bone.X_WB});
  std::vector<ScannedSoft> softs;
  if (!command.bones_only)
    for (const SoftDef& soft : def->softs)
      softs.push_back({soft.name, soft.kind, soft.tissue, &soft.mesh_W});
  return virtual_scan({bones, softs}, *tissues, command.options);
}

Result<void> write_into(const std::filesystem::path& part, const Volume& volume,
                        const DicomWriteOptions& options) {
  std::error_code ec;
  std::filesystem::create_directories(part, ec);
  if (ec) return fail("cannot be made (" + ec.message() + ")", part.string(), "Choose another");
  return write_dicom(volume, part, options);
}

int run_scan(ScanCommand command) {
  const auto out = plain_folder(command.out);
  if (const auto free = refuse_existing(out); !free) return report_error(free.error());
  command.options.spacing_m = command.spacing_mm / 1000;
  command.options.slice_m = command.slice_mm / 1000;
  command.options.psf_m = command.psf_mm / 1000;
  command.options.cortical_m = command.cortical_mm / 1000;
  std::array<int, 3> size{};
  {
    ProgressLine line;
    command.options.progress = line.callback();
    const auto volume = scan_case(command);
    if (!volume) return report_error(volume.error());
    size = volume->frame.size;
    DicomWriteOptions write;
    write.seed = command.options.seed;
    write.progress = line.callback();
    const auto written = write_whole_folder(
        out, [&](const std::filesystem::path& part) { return write_into(part, *volume, write); });
    if (!written) return report_error(written.error());
  }
  std::printf("%d slices of %d x %d -> %s\n", size[2], size[0], size[1], out.string().c_str());
  return kExitDone;
}

}  // namespace

void add_scan_command(cli::App& app, int& exit_code) {
  cli::App* scan = app.add_subcommand(
      "scan",
      "Make a CT series (DICOM) of a case with a virtual scanner, as a reference with known bones");
  auto command = std::make_shared<ScanCommand>();
  scan->add_option("case", command->spec, "a case folder, builtin:wrist or builtin:knee")
      ->required();
  scan->add_option("--out", command->out, "the folder to make")->required();
  scan->add_option("--spacing", command->spacing_mm, "distance between pixels, mm")
      ->capture_default_str();
  scan->add_option("--slice", command->slice_mm, "distance between slices, mm")
      ->capture_default_str();
  scan->add_option("--noise", command->options.noise_hu, "standard deviation of the noise, HU")
      ->capture_default_str()
      ->check(cli::Range(0.0, 1000.0));
  scan->add_option("--psf", command->psf_mm, "point spread, full width at half maximum, mm")
      ->capture_default_str();
  scan->add_option("--cortical", command->cortical_mm, "thickness of the cortical shell, mm")
      ->capture_default_str();
  scan->add_flag("--bones-only", command->bones_only,
                 "leave the soft parts out: bones in 8 mm of muscle");
  scan->add_option("--seed", command->options.seed, "seed of the noise")->capture_default_str();
  scan->callback([command, &exit_code] { exit_code = run_scan(*command); });
}

}  // namespace osteon
