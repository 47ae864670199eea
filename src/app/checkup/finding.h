#pragma once

#include <string>
#include <vector>

namespace osteon {

enum class FindingLevel {
  kGood,  ///< works
  kNote,  ///< works, but not as well as it could; or a device that is not there
  kBad    ///< does not work
};

/// One line of a check-up, for `osteon doctor` and for the window.
struct Finding {
  FindingLevel level = FindingLevel::kGood;
  std::string topic;  ///< "Joystick", "Real time"
  std::string text;   ///< what was found, with figures
  std::string todo;   ///< what the user can do; empty: nothing
};

using Findings = std::vector<Finding>;

FindingLevel worst(const Findings& findings);
/// One line each, with the advice indented below; for a terminal.
std::string to_text(const Findings& findings);
/// A JSON array.
std::string to_json(const Findings& findings);
/// A plain sentence: may a user feel force with what is here?
std::string verdict(const Findings& findings, bool force_device);

}  // namespace osteon
