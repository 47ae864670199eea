#pragma once

#include <filesystem>

#include "osteon/record/recording.h"

namespace osteon {

/// Writes ticks_<hand>.csv and events.csv into a folder that is new or empty, a piece at a time.
/// Units stand in the names of the columns.
Result<void> export_csv(RecordingReader& recording, const std::filesystem::path& folder);

}  // namespace osteon
