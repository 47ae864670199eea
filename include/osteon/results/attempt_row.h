#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "osteon/base/result.h"

namespace osteon {

/// One attempt as it is kept.
struct AttemptRow {
  std::string id;       ///< UUID: an attempt is kept once, however often it is handed over
  std::string learner;  ///< a local id, never a name
  std::string scenario;
  int scenario_version = 1;
  int standard_version = 0;
  std::string verdict;  ///< "passed", "not_passed", "undecided"
  std::optional<double> score, score_lo, score_hi;
  std::int64_t ended_ms = 0;  ///< UTC, by this computer's clock; order does not depend on it
  double duration_s = 0;
  std::string case_name, state_hash;
  std::string report_json;  ///< the whole report
  bool operator==(const AttemptRow&) const = default;
};

/// The attempt's hand was led along an expert's way: it shows nothing of what the learner can do
/// alone, so learning curves leave it out.
bool was_guided(const AttemptRow& row);

/// A random UUID (version 4), lower case.
std::string new_uuid();
bool is_uuid(std::string_view text);
/// 1 to 64 letters, digits, '.', '_' and '-': what may be a learner's id.
bool is_learner_id(std::string_view text);

/// Fills a row from a report's JSON (the keys of docs/scoring.md). Fails when a key is missing or
/// of a wrong type.
Result<AttemptRow> row_from_report(const std::string& report_json, const std::string& learner);

/// The row as one JSON object, and back: how an attempt waits on the disk.
std::string to_json(const AttemptRow& row);
Result<AttemptRow> parse_attempt_row(const std::string& json, const std::string& where);

}  // namespace osteon
