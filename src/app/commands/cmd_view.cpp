#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>
#include "commands/parser.h"

#include "cases/felt_choice.h"
#include "cases/open_case.h"
#include "commands/cli_support.h"
#include "commands/commands.h"
#include "commands/render_options.h"
#include "osteon/base/file.h"
#include "osteon/render/anatomical_view.h"
#include "osteon/render/joint_room.h"
#include "osteon/render/scope_renderer.h"
#include "osteon/scene/build_case.h"

namespace osteon {
namespace {

struct ViewCommand {
  std::string case_spec, scope = "knee_30", size = "720x720", out;
  std::vector<double> at_mm, toward_mm, up;
  double post_deg = 0;
  std::optional<double> flexion_deg;
};

/// The case as it is seen: what is felt of it does not matter, and takes longest to make.
Result<Case> open_scoped_case(const ViewCommand& command) {
  auto spec = Result<std::string>(command.case_spec);
  if (command.flexion_deg) spec = bent_spec(*spec, "flexion", *command.flexion_deg);
  if (!spec) return tl::unexpected(spec.error());
  auto def = open_case_def(*spec);
  if (!def) return tl::unexpected(def.error());
  for (BoneDef& bone : def->bones) bone.felt = Felt::kHull;
  return build_case(std::move(*def));
}

Result<ScopePose> pose_of(const ViewCommand& command, const Case& the_case) {
  const auto place = [](const std::vector<double>& v) { return Vec3(v[0], v[1], v[2]); };
  ScopePose pose;
  pose.at_W = 0.001 * place(command.at_mm);
  pose.toward_W = 0.001 * place(command.toward_mm);
  pose.up_W = command.up.empty() ? anatomical_frame(the_case).distal_W : place(command.up);
  pose.post_rad = command.post_deg * std::numbers::pi / 180;
  for (const Vec3& v : {pose.at_W, pose.toward_W, pose.up_W})
    if (!is_finite(v)) return fail("is not finite", "a position of the scope");
  if (!std::isfinite(pose.post_rad)) return fail("is not finite", "--post");
  if ((pose.toward_W - pose.at_W).norm() < 1e-6)
    return fail("--at and --toward are the same point", "the scope",
                "--toward is the point that its shaft points to");
  return pose;
}

Result<void> draw_view(const ViewCommand& command) {
  const auto size = parse_picture_size(command.size);
  if (!size) return tl::unexpected(size.error());
  const auto scope = load_scope(command.scope);
  if (!scope) return tl::unexpected(scope.error());
  const auto the_case = open_scoped_case(command);
  if (!the_case) return tl::unexpected(the_case.error());
  const auto pose = pose_of(command, *the_case);
  if (!pose) return tl::unexpected(pose.error());
  const auto data_dir = find_data_dir();
  if (!data_dir) return tl::unexpected(data_dir.error());
  const auto context = OffscreenContext::create();
  if (!context) return tl::unexpected(context.error());
  auto renderer = ScopeRenderer::create(*the_case, *data_dir, prepare_case(*the_case));
  if (!renderer) return tl::unexpected(renderer.error());
  const auto wall = JointRoom(*the_case).wall(rest_snapshot(*the_case), pose->at_W);
  if (!wall) return tl::unexpected(wall.error());
  renderer->set_wall(*wall);
  const Image image = renderer->draw_image(ScopeCamera(*scope, *pose), size->width, size->height);
  if (image.rgb.empty())
    return fail("the graphics driver has no memory for the picture", command.out,
                "choose a smaller --size");
  return save_png(image, command.out);
}

int run_view(const ViewCommand& command) {
  if (const auto done = draw_view(command); !done) return report_error(done.error());
  std::printf("%s in %s, %s pixels -> %s\n", command.scope.c_str(), command.case_spec.c_str(),
              command.size.c_str(), command.out.c_str());
  return kExitDone;
}

}  // namespace

void add_view_command(cli::App& app, int& exit_code) {
  auto command = std::make_shared<ViewCommand>();
  cli::App* sub = app.add_subcommand("view", "Save the picture that an arthroscope shows");
  sub->add_option("case", command->case_spec, "a case folder, builtin:wrist or builtin:knee")
      ->required();
  sub->add_option("--scope", command->scope, "knee_0, knee_30, knee_70, wrist_30 or wrist_30_small")
      ->capture_default_str();
  sub->add_option("--at", command->at_mm, "position of the tip: x,y,z in World, mm")
      ->delimiter(',')
      ->expected(3)
      ->required();
  sub->add_option("--toward", command->toward_mm,
                  "point that the shaft points to: x,y,z in World, mm")
      ->delimiter(',')
      ->expected(3)
      ->required();
  sub->add_option(
         "--post", command->post_deg,
         "rotation of the light post, degrees: at 0 the scope looks up in the picture, at 90 "
         "to the right")
      ->capture_default_str();
  sub->add_option(
         "--up", command->up,
         "direction that is up in the picture: x,y,z in World (default: towards the hip, or "
         "the fingers)")
      ->delimiter(',')
      ->expected(3);
  sub->add_option("--flexion", command->flexion_deg, "flexion of a grown knee, degrees");
  sub->add_option("--size", command->size, "width x height in pixels")->capture_default_str();
  sub->add_option("--out", command->out, "PNG file to write")->required();
  sub->callback([command, &exit_code] { exit_code = run_view(*command); });
}

}  // namespace osteon
