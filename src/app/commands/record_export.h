#pragma once

#include <filesystem>
#include <string>

#include "osteon/record/recording.h"

namespace osteon {

/// Writes ticks_<hand>.csv and events.csv into a folder that is new or empty, a piece at a time.
/// Units stand in the names of the columns.
Result<void> export_csv(RecordingReader& recording, const std::filesystem::path& folder);

/// One HDF5 file with a group for each hand and one for the events, a piece at a time; units are
/// attributes. The file is whole or not there.
Result<void> export_hdf5(RecordingReader& recording, const std::filesystem::path& file);

/// Adds torque_<hand>.csv to a folder: the moment of all that acts on each hand's tool about its
/// grip, N m, in World, tick by tick. A recording keeps forces, not where they act: the run is
/// repeated on its case (`case_spec`, empty: the recording's own). Fails where the repetition
/// differs from the recording.
Result<void> export_torque(const std::filesystem::path& recording, const std::string& case_spec,
                           const std::filesystem::path& folder);

}  // namespace osteon
