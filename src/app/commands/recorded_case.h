#pragma once

#include <filesystem>
#include <memory>
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

/// Opens what the replay needs. A portal lies and points a little otherwise where skin is grown, as
/// in the window, than where it is not: the case has the portals that the recording knew.
/// `drawn`: the whole case, if it is open already; null: it is opened where it is needed.
Result<std::shared_ptr<const Case>> open_recorded_case(const std::string& spec,
                                                       const RecordingHeader& header,
                                                       std::shared_ptr<const Case> drawn = nullptr);

}  // namespace osteon
