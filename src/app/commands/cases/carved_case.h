#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "cases/open_case.h"
#include "osteon/base/result.h"
#include "osteon/scene/case.h"

namespace osteon {

/// A recording's case with its bones as they were at some moment, in their places at rest. Pieces
/// that were cut off and lay loose are bones of their own, after the others: "ulna_piece",
/// "ulna_piece_2" and so on, where they lay about the bone that they were part of.
struct CarvedCase {
  CaseDef def;
  std::string spec;        ///< of the case before anything was removed
  std::size_t carved = 0;  ///< bones that something was removed from
  std::size_t pieces = 0;  ///< that are bones of their own
};

/// Repeats a recording (.osr) up to `at_s`, or to its end. `case_spec`: where its case is; empty:
/// where the recording says. Fails when it cannot be repeated bit by bit or ends before.
Result<CarvedCase> carved_case(const std::string& recording_file, const std::string& case_spec,
                               std::optional<double> at_s, CaseParts parts = CaseParts::kAll);

}  // namespace osteon
