#pragma once

#include <string>

#include "osteon/record/recording.h"

namespace osteon {

/// Name of a hand as the recording's settings have it; "hand_1" where it has none.
std::string hand_name(const RecordingHeader& header, std::size_t hand);

/// What a recording holds: case, hands, length, size, stored states.
Result<std::string> recording_info(RecordingReader& recording, bool json);
/// A line an event; as JSON an object a line.
Result<std::string> event_lines(RecordingReader& recording, bool json);

/// "bone 3": what an event is about; empty: nothing.
std::string subject_text(const Event& event);

}  // namespace osteon
