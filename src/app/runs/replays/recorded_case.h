#pragma once

#include <filesystem>
#include <string>

#include "cases/open_case.h"
#include "osteon/base/result.h"
#include "osteon/record/recording.h"

namespace osteon {

/// The case to repeat a recording on: `asked` if given, else the recording's own, which may have
/// moved with it or without it. Fails when it is nowhere.
Result<std::string> recorded_case_spec(const std::filesystem::path& recording,
                                       const std::string& asked, const RecordingHeader& header);

/// What of the case a replay needs: the soft parts where some were felt.
CaseParts parts_of(const RecordingHeader& header);

}  // namespace osteon
