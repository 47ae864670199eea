#pragma once

#include <filesystem>
#include <string>

#include "osteon/base/result.h"
#include "osteon/procedure/report.h"

namespace osteon {

inline constexpr int kExitDone = 0;
inline constexpr int kExitNo = 1;   ///< the answer is no: a check failed, a replay differs
inline constexpr int kExitBad = 2;  ///< the input or the command line is bad

/// Prints the error for a person and returns kExitBad.
int report_error(const Error& error);

/// "m", "cm" or "mm", as the parser let it through.
double metres_per_unit(const std::string& unit);

/// Writes a report's JSON when `file` is not empty.
Result<void> save_report(const Report& report, const std::filesystem::path& file);

}  // namespace osteon
