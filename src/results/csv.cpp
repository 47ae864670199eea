#include <charconv>

#include "osteon/results/exports.h"
#include "utc_text.h"

namespace osteon {
namespace {

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_number(const std::optional<double>& value) {
  if (!value) return "";
  char digits[32];
  return std::string(digits, std::to_chars(digits, digits + sizeof digits, *value).ptr);
}

}  // namespace

std::string to_csv(const std::vector<AttemptRow>& rows) {
  std::string text =
      "id,learner,scenario,scenario_version,standard_version,verdict,score,score_lo,score_hi,"
      "ended,duration_s,case,state_hash\r\n";
  for (const AttemptRow& row : rows) {
    const std::string fields[] = {row.id,
                                  row.learner,
                                  row.scenario,
                                  std::to_string(row.scenario_version),
                                  std::to_string(row.standard_version),
                                  row.verdict,
                                  csv_number(row.score),
                                  csv_number(row.score_lo),
                                  csv_number(row.score_hi),
                                  utc_text(row.ended_ms),
                                  csv_number(row.duration_s),
                                  row.case_name,
                                  row.state_hash};
    std::string line;
    for (const std::string& field : fields) line += (line.empty() ? "" : ",") + csv_field(field);
    text += line + "\r\n";
  }
  return text;
}

}  // namespace osteon
