#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/results/attempt_row.h"

namespace osteon {

/// CSV (RFC 4180), one attempt a line, with a header; no name of a person.
std::string to_csv(const std::vector<AttemptRow>& rows);

/// xAPI 1.0.3 statements, a JSON array: actor by account (`home_page` and the learner's id), verb
/// passed, failed or completed, the scenario as activity, score.scaled = score / 100 within -1 and
/// 1. A statement's id is the attempt's: sending one again is safe.
std::string to_xapi(const std::vector<AttemptRow>& rows,
                    const std::string& home_page = "urn:osteon:local");

/// A page a print of the list, PDF.
Result<void> save_results_pdf(const std::vector<AttemptRow>& rows,
                              const std::filesystem::path& file);

}  // namespace osteon
