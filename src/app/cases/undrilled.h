#pragma once

#include <string>

namespace osteon {

/// The source of a knee before any tunnel was drilled in it: without the findings that cut some
/// into its bones. The same where it has none of them.
std::string source_before_drilling(const std::string& source);

}  // namespace osteon
