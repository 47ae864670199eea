#pragma once

#include <functional>
#include <string>

#include "osteon/record/recording.h"

namespace osteon {

/// What a recording holds: case, hands, length, size, stored states.
Result<std::string> recording_info(RecordingReader& recording, bool json);
/// A line an event, told one by one; as JSON an object a line.
Result<void> tell_events(RecordingReader& recording, bool json,
                         const std::function<void(const std::string& line)>& tell);

}  // namespace osteon
