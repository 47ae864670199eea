#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include "commands/support/parser.h"

#include "commands/pictures/window_size.h"
#include "commands/pictures/windows_in_turn.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/number_check.h"
#include "exercises/result_files.h"
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
      ->add_option("--case,case", order->case_spec, "case: a folder, builtin:wrist or builtin:knee")
      ->capture_default_str();
  command->add_option("--replay", order->replay,
                      "recording to open, or the id of a stored attempt");
  command->add_option("--size", *size, "size of the window in pixels, e.g. 1280x720");
  command
      ->add_option("--ui-scale", order->interface_scale,
                   "scale of the interface; default: the display's")
      ->check(cli::Range(0.5, 4.0));
  command
      ->add_option("--layout", *layout,
                   "what the picture shows: outside, scope, panorama, layout (scope, panorama "
                   "and outside), fluoro")
      ->check(cli::IsMember({"outside", "scope", "panorama", "layout", "fluoro"}));
  command
      ->add_option("--observer", *observer,
                   "open a second window for observers that shows this; values as for --layout")
      ->check(cli::IsMember({"outside", "scope", "panorama", "layout", "fluoro"}));
  command->add_option("--film", order->film, "film the window from the start to this file (.webm)");
  command->add_flag("--mute", *mute,
                    "play nothing through the loudspeaker; films have their sound");
  command->add_flag(
      "--felt", order->felt,
      "begin with the bones coloured by the distance of the felt surface from the visible one");
  command->add_flag("--heat", order->heat,
                    "begin with carved bones coloured by the hottest temperature that they had");
  const auto soft = std::make_shared<std::string>();
  cli::Option* const softs = command->add_option(
      "--soft", *soft,
      "begin with the soft parts shown; with names, those are shown, felt and give way: ligaments "
      "and menisci (all that the case has), or some of them: "
      "acl,pcl,mcl,lcl,medial_meniscus,lateral_meniscus; of a wrist tfcc, too");
  softs->expected(0, 1);
  command->add_flag("--close-up", order->close_up, "begin close up on the joint");
  cli::Option* const eye = command->add_option(
      "--eye", order->eye_mm, "begin with the view from this point outside: x,y,z in World, mm");
  cli::Option* const toward = command->add_option(
      "--toward", order->toward_mm, "point in the middle of that view: x,y,z in World, mm");
  eye->delimiter(',')->expected(3)->needs(toward);
  toward->delimiter(',')->expected(3)->needs(eye);
  command->add_flag("--demo", order->demo, "the virtual hand plays the case's path");
  command->add_option(
      "--device", order->devices,
      "for each hand, a driver or driver:serial (see `osteon devices`), or driver:left "
      "and driver:right; then =INSTRUMENT, e.g. mouse:left=wrist_arthroscope_2_7; default: as last "
      "time");
  command->add_option("--path", order->path, "probe path for an emulated hand (CSV)");
  command->add_option("--record", order->record, "record from the start to this file (.osr)");
  command->add_option("--force-log", order->force_log,
                      "write the last 20 s of the device's positions and forces (CSV) when it is "
                      "closed");
  command->add_option("--edit", order->edit, "begin editing the surface of this bone");
  command->add_flag("--check-up", order->checkup, "begin with the check-up of computer and device");
  command->add_option("--exercise", order->exercise,
                      "open the briefing of this exercise; see: osteon scenario list");
  command->add_option("--graft", order->graft,
                      "with --exercise acl: a report of acl_graft; its graft is placed, and the "
                      "stages at the bench are left out");
  command->add_option("--portals", order->portals,
                      "with --exercise acl: a report of acl_puncture on the same patient; the "
                      "portals are where they were made");
  command->add_option("--from-stage", order->from_stage,
                      "with --exercise: the virtual expert does the stages before this one");
  command->add_option("--to-stage", order->to_stage,
                      "with --exercise: the attempt is over once this stage is done");
  command->add_option(
      "--ghost", order->ghost,
      "what an exercise shows as the expert's movement: FILE.osr (a recording of it on the same "
      "patient) or off; default: the virtual expert");
  command
      ->add_option("--ghost-strength", order->ghost_strength,
                   "opacity of the expert's movement, 0 to 1; default: it fades as the learner's "
                   "results improve")
      ->check(cli::Range(0.0, 1.0));
  command->add_flag("--guide", order->guide,
                    "in exercises, let a device with motors pull the hand weakly along the "
                    "expert's path; the result reports this");
  command->add_flag("--new-patient", order->new_patient,
                    "begin with the panel that makes a patient");
  command->add_option("--screenshot", order->screenshot,
                      "save a picture of the window (PNG), then exit");
  command
      ->add_option("--frames", order->frames,
                   "draw this many pictures, print their timing, then exit")
      ->check(cli::Range(1, 1000000));
  command->add_flag("--at-once", order->at_once,
                    "with --frames: do not wait for the felt shapes; print when the first picture "
                    "of the bones and when the felt shapes were ready");
  command
      ->add_option("--turn", order->turn_deg,
                   "with --frames: turn the camera by this many degrees each picture")
      ->check(cli::Range(-45.0, 45.0));
  command
      ->add_option("--at", order->at_s, "begin counting --frames at this simulated time, seconds")
      ->check(refuse_negative);
  command->callback([order, size, layout, observer, mute, soft, softs, &exit_code] {
    order->give_way = softs_named(*soft);
    order->softs = softs->count() > 0 && order->give_way.empty();
    if (!size->empty() && !parse_window_size(*size, order->width, order->height))
      cli::refuse("--size", "give it as WIDTHxHEIGHT, at least 640x400");
    if (!order->eye_mm.empty() && order->eye_mm == order->toward_mm)
      cli::refuse("--eye", "give a point other than --toward");
    if (!layout->empty()) order->layout = *parse_picture_layout(*layout);
    if (!observer->empty()) order->observer = *parse_picture_layout(*observer);
    for (const auto& [option, file] :
         {std::pair<const char*, std::filesystem::path>{"--graft", order->graft},
          {"--portals", order->portals}}) {
      if (file.empty()) continue;
      if (order->exercise.empty()) cli::refuse(option, "give --exercise, too");
      if (!std::filesystem::exists(file))
        cli::refuse(option, "there is no report '" + file.string() + "'");
    }
    for (const auto& [option, stage] :
         {std::pair{"--from-stage", order->from_stage}, std::pair{"--to-stage", order->to_stage}})
      if (!stage.empty() && order->exercise.empty()) cli::refuse(option, "give --exercise, too");
    if (!order->screenshot.empty() && order->frames == 0) order->frames = 30;
    // A measured run shall give the same picture for everyone.
    order->fresh = order->frames > 0;
    order->sound = !*mute && order->frames == 0;
    order->case_spec = absolute_spec(order->case_spec);
    if (!order->replay.empty()) {
      const auto recording = recording_named(order->replay.string());
      if (!recording) {
        exit_code = report_error(recording.error());
        return;
      }
      order->replay = *recording;
    }
    std::error_code ec;
    if (!order->ghost.empty() && order->ghost != "off" &&
        !std::filesystem::exists(order->ghost, ec))
      cli::refuse("--ghost", "there is no recording '" + order->ghost + "'");
    exit_code = run_windows(*order);
  });
}

}  // namespace osteon
