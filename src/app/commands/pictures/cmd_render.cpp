#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>
#include "commands/support/parser.h"

#include "cases/felt_choice.h"
#include "cases/open_case.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/render_options.h"
#include "osteon/base/file.h"
#include "osteon/render/renderer.h"
#include "osteon/render/stereo.h"

namespace osteon {
namespace {

struct RenderOptions {
  std::string case_spec;
  std::string view = "dorsal";
  std::string size = "1280x720";
  std::vector<std::string> hidden;
  std::vector<std::string> softs;
  double skin_opacity = 0.28;
  bool hulls = false;
  bool joint = false;
  bool felt = false;
  std::optional<double> flexion_deg;
  std::string stereo;
  std::optional<double> eye_distance_mm, screen_depth_mm;
  std::string out;
};

Result<ViewState> make_view(const RenderOptions& options, const Case& the_case, double aspect) {
  const auto preset = parse_view_preset(options.view);
  if (!preset) return tl::unexpected(preset.error());
  ViewState view = default_view(the_case);
  view.camera = preset_camera(*preset, the_case, aspect);
  if (options.joint) view.camera = close_up_camera(view.camera, the_case, BoneId{}, aspect);
  view.quality = RenderQuality::kFine;
  view.show_hulls = options.hulls;
  view.show_felt = options.felt;
  view.show_proxy = view.show_force = view.show_hand_ghost = false;
  if (auto ok = hide_bones(the_case, options.hidden, view); !ok) return tl::unexpected(ok.error());
  if (auto ok = show_softs(the_case, options.softs, view); !ok) return tl::unexpected(ok.error());
  for (std::size_t i = 0; i < the_case.softs.size(); ++i)
    if (the_case.softs[i].kind == "skin")
      view.softs[i].opacity = static_cast<float>(options.skin_opacity);
  return view;
}

/// What is not given is what looks right of something at arm's length: the screen stands at what is
/// looked at, the eyes a fifteenth of that apart.
Result<StereoEyes> eyes_of(const RenderOptions& options, const Camera& camera) {
  StereoEyes eyes;
  eyes.screen_depth_m =
      options.screen_depth_mm ? 0.001 * *options.screen_depth_mm : camera.distance_m;
  eyes.distance_m =
      options.eye_distance_mm ? 0.001 * *options.eye_distance_mm : eyes.screen_depth_m / 15;
  if (auto ok = check(eyes, camera); !ok) return tl::unexpected(ok.error());
  return eyes;
}

Result<Image> draw_picture(const RenderOptions& options, const PictureSize& size,
                           const RenderSnapshot& snapshot, const ViewState& view,
                           Renderer& renderer) {
  const auto draw = [&](const Camera& camera) {
    ViewState seen = view;
    seen.camera = camera;
    return renderer.draw_image(snapshot, seen, size.width, size.height);
  };
  if (options.stereo.empty()) return draw(view.camera);
  const auto layout = parse_stereo_layout(options.stereo);
  if (!layout) return tl::unexpected(layout.error());
  const auto eyes = eyes_of(options, view.camera);
  if (!eyes) return tl::unexpected(eyes.error());
  const Image left = draw(left_eye(view.camera, *eyes));
  return join(left, draw(right_eye(view.camera, *eyes)), *layout);
}

Result<void> render(const RenderOptions& options) {
  const auto size = parse_picture_size(options.size);
  if (!size) return tl::unexpected(size.error());
  if (!options.stereo.empty())
    if (auto layout = parse_stereo_layout(options.stereo); !layout)
      return tl::unexpected(layout.error());
  auto spec = Result<std::string>(options.case_spec);
  if (options.flexion_deg) spec = bent_spec(*spec, "flexion", *options.flexion_deg);
  if (!spec) return tl::unexpected(spec.error());
  const auto opened = open_and_show_progress(
      *spec, options.hulls || options.felt ? CaseParts::kAll : CaseParts::kSeen);
  if (!opened) return tl::unexpected(opened.error());
  const Case& the_case = **opened;
  const auto view = make_view(options, the_case, static_cast<double>(size->width) / size->height);
  if (!view) return tl::unexpected(view.error());
  const auto data_dir = find_data_dir();
  if (!data_dir) return tl::unexpected(data_dir.error());
  const auto context = OffscreenContext::create();
  if (!context) return tl::unexpected(context.error());
  PreparedCase prepared = prepare_case(the_case);
  if (options.felt) prepare_felt(the_case, prepared);
  auto renderer = Renderer::create(the_case, Tool{}, *data_dir, prepared);
  if (!renderer) return tl::unexpected(renderer.error());
  RenderSnapshot snapshot;
  snapshot.bones = rest_snapshot(the_case);
  const auto image = draw_picture(options, *size, snapshot, *view, *renderer);
  if (!image) return tl::unexpected(image.error());
  if (image->rgb.empty())
    return fail("the graphics driver has no memory for the picture", renderer->device_name(),
                "Choose a smaller --size");
  return save_png(*image, options.out);
}

int run(const RenderOptions& options) {
  if (const auto done = render(options); !done) return report_error(done.error());
  std::printf("%s view of %s, %s pixels -> %s\n", options.view.c_str(), options.case_spec.c_str(),
              options.size.c_str(), options.out.c_str());
  return 0;
}

}  // namespace

void add_render_command(cli::App& app, int& exit_code) {
  auto options = std::make_shared<RenderOptions>();
  cli::App* command = app.add_subcommand("render", "Draw a picture of a case, without a window");
  command->add_option("--case", options->case_spec, "case folder, builtin:wrist or builtin:knee")
      ->required();
  command
      ->add_option(
          "--view", options->view,
          "dorsal, palmar, radial, ulnar, ap or lateral; for a knee front, back, outer, inner")
      ->capture_default_str();
  command->add_flag("--joint", options->joint, "close up: the carpal bones, or the knee's joint");
  command->add_option("--size", options->size, "width x height in pixels")->capture_default_str();
  command->add_flag("--hulls", options->hulls, "draw the convex pieces that the probe feels");
  command->add_flag("--felt", options->felt,
                    "colour the bones by the distance of the felt surface from the visible one: "
                    "orange 0.5 mm above it, blue 0.5 mm below it");
  command->add_option("--flexion", options->flexion_deg, "flexion of a generated knee, degrees");
  command->add_option("--hide", options->hidden, "names of bones to leave out")->delimiter(',');
  command
      ->add_option("--soft", options->softs,
                   "soft parts to draw: all, none, names, or kinds such as ligament; default: none")
      ->delimiter(',');
  command
      ->add_option("--skin-opacity", options->skin_opacity,
                   "opacity of the skin when it is drawn, 0 to 1")
      ->check(cli::Range(0.0, 1.0))
      ->capture_default_str();
  cli::Option* stereo = command->add_option(
      "--stereo", options->stereo, "side-by-side, over-under, interlaced or anaglyph (red-cyan)");
  command
      ->add_option("--eye-distance", options->eye_distance_mm,
                   "distance between the eyes, mm; default: a fifteenth of the screen's depth")
      ->needs(stereo);
  command
      ->add_option(
          "--screen-depth", options->screen_depth_mm,
          "distance at which both pictures coincide, mm; default: that of the centre of view")
      ->needs(stereo);
  command->add_option("--out", options->out, "PNG file to write")->required();
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace osteon
