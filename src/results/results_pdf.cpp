#include <charconv>

#include "osteon/results/exports.h"
#include "osteon/results/pdf.h"
#include "utc_text.h"

namespace osteon {
namespace {

std::string one_digit(const std::optional<double>& value) {
  if (!value) return "-";
  char digits[64];
  const auto end =
      std::to_chars(digits, digits + sizeof digits, *value, std::chars_format::fixed, 1).ptr;
  return std::string(digits, end);
}

}  // namespace

Result<void> save_results_pdf(const std::vector<AttemptRow>& rows,
                              const std::filesystem::path& file) {
  PdfPages pages;
  pages.heading("Attempts");
  pages.line(std::to_string(rows.size()) +
             " attempts. A score of 100 is the experts' mean, 10 points one standard deviation; "
             "in brackets its 95 % interval.");
  pages.row({"ended (UTC)", "learner", "scenario", "verdict", "score", "seconds"}, true);
  for (const AttemptRow& row : rows)
    pages.row({utc_text(row.ended_ms).substr(0, 16), row.learner, row.scenario, row.verdict,
               row.score ? one_digit(row.score) + " (" + one_digit(row.score_lo) + "-" +
                               one_digit(row.score_hi) + ")"
                         : "-",
               one_digit(row.duration_s)});
  return pages.save(file);
}

}  // namespace osteon
