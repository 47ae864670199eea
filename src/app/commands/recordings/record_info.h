#pragma once

#include <functional>
#include <span>
#include <string>

#include "osteon/record/recording.h"
#include "runs/reports/torque_report.h"

namespace osteon {

/// What a recording holds: case, hands, length, size, stored states; and of every hand the torque
/// that its repetition gave, where `torques` has it.
Result<std::string> recording_info(RecordingReader& recording, bool json,
                                   std::span<const TorqueReport> torques = {});
/// A line an event, told one by one; as JSON an object a line.
Result<void> tell_events(RecordingReader& recording, bool json,
                         const std::function<void(const std::string& line)>& tell);

}  // namespace osteon
