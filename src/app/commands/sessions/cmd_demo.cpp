#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include "commands/support/parser.h"

#include "cases/open_case.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/headless.h"
#include "osteon/base/file.h"
#include "osteon/base/log.h"
#include "osteon/render/renderer.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

// The moment of the largest force is the one worth a picture.
struct BestMoment {
  RenderSnapshot snapshot;
  double force_n = -1;

  void consider(const ToolState& tool, const BoneSnapshot& bones) {
    const double force = tool.force_W.norm();
    if (force <= force_n) return;
    force_n = force;
    snapshot = {bones, tool};
  }
};

Result<void> draw_moment(const Case& the_case, const RenderSnapshot& snapshot, const fs::path& data,
                         const fs::path& file) {
  auto context = OffscreenContext::create();
  if (!context) return tl::unexpected(context.error());
  auto renderer = Renderer::create(the_case, make_wrist_probe(), data);
  if (!renderer) return tl::unexpected(renderer.error());
  return save_png(renderer->draw_image(snapshot, default_view(the_case), 1280, 720), file);
}

int run_demo(const fs::path& out) {
  std::error_code ec;
  fs::create_directories(out, ec);
  if (ec) return report_error({"cannot be made (" + ec.message() + ")", out.string(), ""});
  auto data = find_data_dir();
  if (!data) return report_error(data.error());
  std::printf("generating the built-in wrist ...\n");
  auto the_case = open_and_show_progress("builtin:wrist", CaseParts::kFelt);
  if (!the_case) return report_error(the_case.error());
  auto path = load_path(*data / "assets/paths/wrist_survey.csv");
  if (!path) return report_error(path.error());
  std::printf("playing %.0f s of probing ...\n", path->duration_s());
  BestMoment best;
  HeadlessRun run;
  run.the_case = *the_case;
  run.path = std::move(*path);
  run.on_tick = [&](const ToolState& tool, const BoneSnapshot& bones) {
    best.consider(tool, bones);
  };
  const auto report = simulate(run);
  if (!report) return report_error(report.error());
  std::fputs(to_text(*report).c_str(), stdout);
  if (auto ok = save_report(*report, out / "report.json"); !ok) return report_error(ok.error());
  std::printf("wrote %s\n", (out / "report.json").string().c_str());
  if (auto ok = draw_moment(**the_case, best.snapshot, *data, out / "wrist.png"); !ok)
    return report_error(ok.error());
  std::printf("wrote %s\n", (out / "wrist.png").string().c_str());
  return kExitDone;
}

}  // namespace

void add_demo_command(cli::App& app, int& exit_code) {
  auto out = std::make_shared<std::string>("out");
  cli::App* command = app.add_subcommand(
      "demo", "Play the bundled probe path on the built-in wrist: report and picture, no window");
  command->add_option("--out", *out, "folder for wrist.png and report.json")->capture_default_str();
  command->callback([out, &exit_code] { exit_code = run_demo(*out); });
}

}  // namespace osteon
