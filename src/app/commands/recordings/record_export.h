#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "osteon/record/recording.h"
#include "runs/reports/torque_report.h"

namespace osteon {

/// Writes ticks_<hand>.csv and events.csv into a folder that is new or empty, a piece at a time.
/// Units stand in the names of the columns.
Result<void> export_csv(RecordingReader& recording, const std::filesystem::path& folder);

/// One HDF5 file with a group for each hand and one for the events, a piece at a time; units are
/// attributes. The file is whole or not there. `more`, where given, adds to the file before it gets
/// its name.
Result<void> export_hdf5(
    RecordingReader& recording, const std::filesystem::path& file,
    const std::function<Result<void>(const std::filesystem::path&)>& more = {});

/// Adds torque_<hand>.csv to a folder: the moment of all that acts on each hand's tool about its
/// grip, N m, in World, tick by tick. A recording keeps forces, not where they act: the run is
/// repeated on its case (`case_spec`, empty: the recording's own). Fails where the repetition
/// differs from the recording.
Result<void> export_torque(const std::filesystem::path& recording, const std::string& case_spec,
                           const std::filesystem::path& folder);
/// The same as a dataset `torque` in each hand's group of an HDF5 file of export_hdf5.
Result<void> add_torque_to_hdf5(const std::filesystem::path& recording,
                                const std::string& case_spec, const std::filesystem::path& file);
/// The largest, when, and the mean, of every hand.
Result<std::vector<TorqueReport>> torque_reports(const std::filesystem::path& recording,
                                                 const std::string& case_spec);
/// The hand's group in an HDF5 file: a slash would begin a group of its own.
std::string hdf5_group_name(std::string hand);

}  // namespace osteon
