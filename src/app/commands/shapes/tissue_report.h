#pragma once

#include <string>

#include "osteon/tissue/solve.h"

namespace osteon {

/// A solved scene as JSON, see docs/tissue.md; `wall_s` is what solving took.
std::string solve_report_json(const SolveResult& result, double wall_s);
/// The same for a person.
std::string solve_report_text(const SolveResult& result, double wall_s);

}  // namespace osteon
