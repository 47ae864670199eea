#include <memory>
#include <string>
#include <vector>
#include "commands/support/parser.h"

#include "cases/whole_folder.h"
#include "commands/pictures/window_size.h"
#include "commands/pictures/windows_in_turn.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"

namespace osteon {
namespace {

int run_segment(const SegmentOrder& order) {
  if (!order.out.empty())
    if (const auto free = refuse_existing(plain_folder(order.out)); !free)
      return report_error(free.error());
  return run_windows(order);
}

}  // namespace

void add_segment_command(cli::App& app, int& exit_code) {
  cli::App* command =
      app.add_subcommand("segment", "Segment a CT scan by hand in a window and save it as a case");
  const auto order = std::make_shared<SegmentOrder>();
  const auto size = std::make_shared<std::string>();
  const auto spacing_mm = std::make_shared<std::vector<double>>();
  command->add_option(
      "source", order->scan.source,
      "a DICOM folder or file, .nrrd, .nii, .nii.gz, .mhd, .mha, .inv3, or a folder "
      "of PNG or TIFF slices; default: choose it in the window");
  command->add_option("--out", order->out,
                      "the case folder to make; default: a new folder among your saved cases");
  command->add_option("--series", order->scan.series,
                      "number or UID of the series, where a folder has several");
  command
      ->add_option("--spacing", *spacing_mm,
                   "distances X,Y,Z between voxels, mm, for PNG and TIFF slices")
      ->delimiter(',')
      ->expected(3);
  command->add_flag("--suggest", order->suggest,
                    "begin with the bones that `osteon import ct` finds by itself");
  command->add_option("--choose", order->choose,
                      "begin with this bone selected, one of those that --suggest finds");
  command->add_option("--size", *size, "size of the window in pixels, e.g. 1280x720");
  command
      ->add_option("--ui-scale", order->interface_scale,
                   "scale of the interface; default: the display's")
      ->check(cli::Range(0.5, 4.0));
  command->add_option("--screenshot", order->screenshot,
                      "save a picture of the window (PNG), then exit");
  command
      ->add_option("--frames", order->frames,
                   "draw this many pictures, print their timing, then exit")
      ->check(cli::Range(1, 1000000));
  command->callback([order, size, spacing_mm, &exit_code] {
    if (!size->empty() && !parse_window_size(*size, order->width, order->height))
      cli::refuse("--size", "give it as WIDTHxHEIGHT, at least 640x400");
    if (!order->screenshot.empty() && order->frames == 0) order->frames = 30;
    order->fresh = order->frames > 0;
    if (!spacing_mm->empty())
      order->scan.spacing_m = Vec3((*spacing_mm)[0], (*spacing_mm)[1], (*spacing_mm)[2]) / 1000;
    exit_code = run_segment(*order);
  });
}

}  // namespace osteon
