#pragma once

#include <cstdio>
#include <string>

#include "osteon/results/attempt_row.h"

namespace osteon::test {

inline std::string uuid_of(int writer, int n) {
  char text[40];
  std::snprintf(text, sizeof text, "%08x-0000-4000-8000-%012x", static_cast<unsigned>(writer),
                static_cast<unsigned>(n));
  return text;
}

inline AttemptRow row_of(int writer, int n) {
  AttemptRow row;
  row.id = uuid_of(writer, n);
  row.learner = "learner_" + std::to_string(writer);
  row.scenario = "touch_bones";
  row.verdict = n % 2 ? "passed" : "not_passed";
  row.score = 90.5 + n;
  row.score_lo = 80;
  row.score_hi = 101;
  row.ended_ms = 1700000000000 - n;  // the clock runs back
  row.duration_s = 61.25;
  row.case_name = "wrist";
  row.state_hash = "00000000000000ff";
  row.report_json = "{\"a\": \"b\\u0000\"}";
  return row;
}

}  // namespace osteon::test
