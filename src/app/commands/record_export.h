#pragma once

#include <filesystem>

#include "osteon/record/recording.h"

namespace osteon {

/// Writes ticks_<hand>.csv and events.csv into a folder that is new or empty, a piece at a time.
/// Units stand in the names of the columns.
Result<void> export_csv(RecordingReader& recording, const std::filesystem::path& folder);

/// One HDF5 file with a group for each hand and one for the events, a piece at a time; units are
/// attributes. The file is whole or not there.
Result<void> export_hdf5(RecordingReader& recording, const std::filesystem::path& file);

}  // namespace osteon
