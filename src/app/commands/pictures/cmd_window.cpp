#include <filesystem>
#include <memory>
#include <string>
#include "commands/support/parser.h"

#include "commands/pictures/window_size.h"
#include "commands/pictures/windows_in_turn.h"
#include "commands/support/commands.h"
#include "commands/support/number_check.h"
#include "runs/hands/tray.h"

namespace osteon {
namespace {

// A recording keeps its case's source: a folder must be found again from anywhere.
std::string absolute_spec(const std::string& spec) {
  if (spec.starts_with("builtin:")) return spec;
  std::error_code ec;
  const std::filesystem::path path = std::filesystem::absolute(spec, ec);
  return ec ? spec : path.lexically_normal().string();
}

}  // namespace

void add_window_command(cli::App& app, int& exit_code) {
  cli::App* command = app.add_subcommand("window", "Open the simulator's window");
  const auto order = std::make_shared<WindowOrder>();
  const auto size = std::make_shared<std::string>(), layout = std::make_shared<std::string>(),
             observer = std::make_shared<std::string>();
  const auto mute = std::make_shared<bool>(false);
  command
      ->add_option("--case,case", order->case_spec, "Case: a folder, builtin:wrist or builtin:knee")
      ->capture_default_str();
  command->add_option("--replay", order->replay, "Recording to open");
  command->add_option("--size", *size, "Size of the window in pixels, e.g. 1280x720");
  command
      ->add_option("--ui-scale", order->interface_scale,
                   "Scale of the interface; default: the display's")
      ->check(cli::Range(0.5, 4.0));
  command
      ->add_option("--layout", *layout,
                   "What the picture shows: outside, scope, panorama, layout (scope, panorama "
                   "and outside), fluoro")
      ->check(cli::IsMember({"outside", "scope", "panorama", "layout", "fluoro"}));
  command
      ->add_option("--observer", *observer,
                   "Open a second window for observers that shows this; values as for --layout")
      ->check(cli::IsMember({"outside", "scope", "panorama", "layout", "fluoro"}));
  command->add_option("--film", order->film, "Film the window from the start to this file (.webm)");
  command->add_flag("--mute", *mute,
                    "Play nothing through the loudspeaker; films have their sound");
  command->add_flag(
      "--felt", order->felt,
      "Begin with the bones coloured by the distance of the felt surface from the visible one");
  const auto soft = std::make_shared<std::string>();
  cli::Option* const softs = command->add_option(
      "--soft", *soft,
      "Begin with the soft parts shown; with names, those are shown, felt and give way: ligaments "
      "and menisci (all that the case has), or some of them: "
      "acl,pcl,mcl,lcl,medial_meniscus,lateral_meniscus");
  softs->expected(0, 1);
  command->add_flag("--close-up", order->close_up, "Begin close up on the joint");
  command->add_flag("--demo", order->demo, "The virtual hand plays the case's path");
  command->add_option(
      "--device", order->devices,
      "For each hand, a driver or driver:serial (see `osteon devices`), or driver:left "
      "and driver:right; then =INSTRUMENT, e.g. mouse:left=wrist_arthroscope_2_7; default: as last "
      "time");
  command->add_option("--path", order->path, "Probe path for an emulated hand (CSV)");
  command->add_option("--record", order->record, "Record from the start to this file (.osr)");
  command->add_option("--force-log", order->force_log,
                      "Write the last 20 s of the device's positions and forces (CSV) when it is "
                      "closed");
  command->add_option("--edit", order->edit, "Begin editing the surface of this bone");
  command->add_flag("--check-up", order->checkup, "Begin with the check-up of computer and device");
  command->add_option("--exercise", order->exercise,
                      "Open the briefing of this exercise; see: osteon scenario list");
  command->add_option(
      "--ghost", order->ghost,
      "What an exercise shows as the expert's movement: FILE.osr (a recording of it on the same "
      "patient) or off; default: the virtual expert");
  command
      ->add_option("--ghost-strength", order->ghost_strength,
                   "Opacity of the expert's movement, 0 to 1; default: it fades as the learner's "
                   "results improve")
      ->check(cli::Range(0.0, 1.0));
  command->add_flag("--guide", order->guide,
                    "In exercises, let a device with motors lead the hand weakly along the "
                    "expert's path; the result says so");
  command->add_flag("--new-patient", order->new_patient,
                    "Begin with the panel that makes a patient");
  command->add_option("--screenshot", order->screenshot,
                      "Save a picture of the window (PNG), then exit");
  command
      ->add_option("--frames", order->frames,
                   "Draw this many pictures, print their timing, then exit")
      ->check(cli::Range(1, 1000000));
  command->add_flag("--at-once", order->at_once,
                    "With --frames: begin at once, as without it, and print when the first picture "
                    "of the bones and their felt shapes were ready");
  command
      ->add_option("--turn", order->turn_deg,
                   "With --frames: turn the camera by this many degrees each picture")
      ->check(cli::Range(-45.0, 45.0));
  command
      ->add_option("--at", order->at_s, "Begin counting --frames at this simulated time, seconds")
      ->check(refuse_negative);
  command->callback([order, size, layout, observer, mute, soft, softs, &exit_code] {
    order->give_way = softs_named(*soft);
    order->softs = softs->count() > 0 && order->give_way.empty();
    if (!size->empty() && !parse_window_size(*size, order->width, order->height))
      cli::refuse("--size", "give it as WIDTHxHEIGHT, at least 640x400");
    if (!layout->empty()) order->layout = *parse_picture_layout(*layout);
    if (!observer->empty()) order->observer = *parse_picture_layout(*observer);
    if (!order->screenshot.empty() && order->frames == 0) order->frames = 30;
    // A measured run shall give the same picture for everyone.
    order->fresh = order->frames > 0;
    order->sound = !*mute && order->frames == 0;
    order->case_spec = absolute_spec(order->case_spec);
    std::error_code ec;
    if (!order->ghost.empty() && order->ghost != "off" &&
        !std::filesystem::exists(order->ghost, ec))
      cli::refuse("--ghost", "there is no recording '" + order->ghost + "'");
    exit_code = run_windows(*order);
  });
}

}  // namespace osteon
