#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "cases/open_case.h"
#include "osteon/base/result.h"
#include "osteon/procedure/report.h"

namespace osteon {

inline constexpr int kExitDone = 0;
inline constexpr int kExitNo = 1;   ///< the answer is no: a check failed, a replay differs
inline constexpr int kExitBad = 2;  ///< the input or the command line is bad

/// Prints the error for a person and returns kExitBad.
int report_error(const Error& error);

/// open_case with a line of progress (ProgressLine); Ctrl-C stops it with std::runtime_error.
Result<std::shared_ptr<const Case>> open_and_show_progress(const std::string& spec,
                                                           CaseParts parts);

/// "m", "cm" or "mm", as the parser let it through.
double metres_per_unit(const std::string& unit);

/// Writes a report's JSON when `file` is not empty.
Result<void> save_report(const Report& report, const std::filesystem::path& file);

}  // namespace osteon
