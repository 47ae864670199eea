#pragma once

#include <string>
#include <vector>

#include "osteon/record/recording.h"

namespace osteon {

/// What a recording calls its hands and what its events speak of; read once from its header.
class RecordNames {
 public:
  explicit RecordNames(const RecordingHeader& header);
  /// The name that was given, or "hand_1"; empty of kNoHand.
  const std::string& hand(std::size_t hand) const;
  /// "portal"; empty: the event has no subject.
  static std::string subject_kind(const Event& event);
  /// Of bones, soft parts, landmarks, instruments, portals, hands and causes; else its number.
  std::string subject(const Event& event) const;

 private:
  std::vector<std::string> hands_;
  std::vector<std::vector<std::string>> by_kind_;  ///< by SubjectKind
};

/// The length of a recording's ticks.
double recorded_tick_s(const RecordingHeader& header);

/// Of all hands of a recording.
std::vector<std::string> hand_names(const RecordingHeader& header);

}  // namespace osteon
