#include <cstdio>
#include <memory>
#include <string>
#include "commands/support/parser.h"

#include "commands/recordings/record_export.h"
#include "commands/recordings/record_info.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"

namespace osteon {
namespace {

struct RecordArguments {
  std::string file;
  bool events = false;
  bool json = false;
  std::string csv;
  std::string hdf5;
  bool torque = false;
  std::string case_spec;
};

int run_info(const RecordArguments& options) {
  auto recording = RecordingReader::open(options.file);
  if (!recording) return report_error(recording.error());
  if (options.events) {
    const auto told = tell_events(*recording, options.json, [](const std::string& line) {
      std::fputs(line.c_str(), stdout);
    });
    return told ? kExitDone : report_error(told.error());
  }
  std::vector<TorqueReport> torques;
  if (options.torque) {
    auto repeated = torque_reports(options.file, options.case_spec);
    if (!repeated) return report_error(repeated.error());
    torques = std::move(*repeated);
  }
  const auto text = recording_info(*recording, options.json, torques);
  if (!text) return report_error(text.error());
  std::fputs(text->c_str(), stdout);
  return kExitDone;
}

// What is added to an HDF5 file; empty: nothing.
std::function<Result<void>(const std::filesystem::path&)> torque_of(
    const RecordArguments& options) {
  if (!options.torque) return {};
  return [&options](const std::filesystem::path& file) {
    return add_torque_to_hdf5(options.file, options.case_spec, file);
  };
}

int run_export(const RecordArguments& options) {
  if (options.csv.empty() && options.hdf5.empty())
    return report_error(
        {"no output is given", "record export", "Give --csv FOLDER or --hdf5 FILE, or both"});
  auto recording = RecordingReader::open(options.file);
  if (!recording) return report_error(recording.error());
  if (!options.csv.empty())
    if (const auto done = export_csv(*recording, options.csv); !done)
      return report_error(done.error());
  if (options.torque && !options.csv.empty())
    if (const auto done = export_torque(options.file, options.case_spec, options.csv); !done)
      return report_error(done.error());
  if (!options.hdf5.empty())
    if (const auto done = export_hdf5(*recording, options.hdf5, torque_of(options)); !done)
      return report_error(done.error());
  return kExitDone;
}

}  // namespace

void add_record_command(cli::App& app, int& exit_code) {
  auto options = std::make_shared<RecordArguments>();
  cli::App* command = app.add_subcommand("record", "Inspect and export recordings (.osr)");
  command->require_subcommand(1);
  cli::App* info = command->add_subcommand("info", "Show what a recording contains");
  info->add_option("file", options->file, "recording")->required();
  info->add_flag("--events", options->events, "print its events, one per line");
  info->add_flag("--json", options->json, "print JSON; with --events one object per line");
  info->add_flag("--torque", options->torque,
                 "replay the run and report the moment about each grip");
  info->add_option("--case", options->case_spec,
                   "for --torque: the case; default: the recording's own");
  info->callback([options, &exit_code] { exit_code = run_info(*options); });
  cli::App* exported = command->add_subcommand(
      "export", "Write ticks, poses, forces and events as tables, for pandas or MATLAB");
  exported->add_option("file", options->file, "recording")->required();
  exported->add_option("--csv", options->csv,
                       "a new or empty folder: ticks_<hand>.csv, events.csv");
  exported->add_option("--hdf5", options->hdf5,
                       "a file: a group for each hand and one for the events, with units");
  exported->add_flag("--torque", options->torque,
                     "replay the run and add the moment about each grip: torque_<hand>.csv, or in "
                     "HDF5 a dataset per hand");
  exported->add_option("--case", options->case_spec,
                       "for --torque: the case; default: the recording's own");
  exported->callback([options, &exit_code] { exit_code = run_export(*options); });
}

}  // namespace osteon
