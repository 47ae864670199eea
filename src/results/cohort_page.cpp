#include <algorithm>

#include "html_page.h"
#include "osteon/base/file.h"
#include "osteon/results/cohort.h"
#include "osteon/results/pdf.h"
#include "short_text.h"

namespace osteon {
namespace {

constexpr double kPlotLeft = 150, kPlotWide = 420, kPlotRow = 18, kPlotHigh = 150;

std::string tenths_or_dash(const std::optional<double>& value) {
  return value ? tenths(*value) : "-";
}

std::string interval_text(const CohortLearner& one) {
  if (!one.last) return "-";
  return tenths(*one.last) + " (" + tenths_or_dash(one.last_lo) + " to " +
         tenths_or_dash(one.last_hi) + ")";
}

std::string standing(const CohortLearner& one) {
  if (one.relapse_at >= 0) return "relapse at attempt " + std::to_string(one.relapse_at + 1);
  if (one.competent_at >= 0)
    return "competent since attempt " + std::to_string(one.competent_at + 1);
  return "not yet";
}

// What scores and intervals of an exercise lie between.
struct ScoreScale {
  // From 0, so that a bar twice as long is a score twice as high.
  double least = 0, most = 100;
  void include(const std::optional<double>& value) {
    if (!value) return;
    least = std::min(least, *value);
    most = std::max(most, *value);
  }
  double x(double score) const {
    return kPlotLeft + kPlotWide * (score - least) / std::max(1.0, most - least);
  }
  double y(double score) const {
    return 10 + kPlotHigh * (1 - (score - least) / std::max(1.0, most - least));
  }
};
ScoreScale scale_of(const CohortScenario& scenario) {
  ScoreScale scale;
  for (const CohortLearner& one : scenario.learners)
    for (const auto& value : {one.last, one.last_lo, one.last_hi}) scale.include(value);
  for (const CohortStep& step : scenario.curve)
    if (step.learners > 0) {
      scale.include(step.lower);
      scale.include(step.upper);
    }
  return scale;
}

// A bar to each learner's last score, with its interval over it and the experts' mean as a line.
std::string bars_svg(const CohortScenario& scenario, const LearnerNames& names) {
  const ScoreScale scale = scale_of(scenario);
  const double high = kPlotRow * static_cast<double>(scenario.learners.size()) + 24;
  std::string svg = "<svg viewBox=\"0 0 640 " + tenths(high) + "\" role=\"img\">";
  double y = 12;
  for (const CohortLearner& one : scenario.learners) {
    svg += svg_text(0, y + 4, short_text(shown_name(one.learner, names), 24));
    if (one.last) svg += svg_line(kPlotLeft, y, scale.x(*one.last), y, "bar");
    if (one.last_lo && one.last_hi)
      svg += svg_line(scale.x(*one.last_lo), y, scale.x(*one.last_hi), y, "interval");
    svg += svg_text(kPlotLeft + kPlotWide + 8, y + 4, one.last ? tenths(*one.last) : "no score");
    y += kPlotRow;
  }
  svg += svg_line(scale.x(100), 2, scale.x(100), y - 6, "expert");
  return svg + svg_text(scale.x(100) - 30, y + 6, "experts 100") + "</svg>";
}

// The median by attempt with the quartiles.
std::string curve_svg(const CohortScenario& scenario) {
  const ScoreScale scale = scale_of(scenario);
  std::string svg = "<svg viewBox=\"0 0 640 185\" role=\"img\">", way;
  const double step =
      kPlotWide / static_cast<double>(std::max<std::size_t>(1, scenario.curve.size()));
  for (std::size_t n = 0; n < scenario.curve.size(); ++n) {
    const CohortStep& at = scenario.curve[n];
    if (at.learners == 0) continue;
    const double x = kPlotLeft + step * (static_cast<double>(n) + 0.5);
    svg += svg_line(x, scale.y(at.lower), x, scale.y(at.upper), "interval");
    svg += svg_text(x - 4, 178, std::to_string(n + 1));
    way += (way.empty() ? "" : " ") + tenths(x) + "," + tenths(scale.y(at.median));
  }
  svg += svg_line(kPlotLeft, scale.y(100), kPlotLeft + kPlotWide, scale.y(100), "expert");
  svg += svg_text(0, scale.y(100) + 4, "experts 100") + svg_text(0, 178, "attempt");
  return svg + "<polyline points=\"" + way + "\"/></svg>";
}

const std::vector<std::string> kLearnerHead{"learner", "attempts",    "passed",
                                            "first",   "last (95 %)", "standing"};
std::vector<std::string> learner_cells(const CohortLearner& one, const LearnerNames& names) {
  return {shown_name(one.learner, names),  std::to_string(one.attempts), std::to_string(one.passed),
          tenths_or_dash(one.first_score), interval_text(one),           standing(one)};
}
const std::vector<std::string> kErrorHead{"error", "severity", "attempts with it", "learners"};
std::vector<std::string> error_cells(const CohortError& one) {
  return {one.name, one.severity, std::to_string(one.attempts), std::to_string(one.learners)};
}
std::string sum_text(const CohortScenario& scenario) {
  return std::to_string(scenario.learners.size()) + " learners, " +
         std::to_string(scenario.attempts) + " attempts, " + std::to_string(scenario.passed) +
         " passed.";
}

constexpr const char* kPageHead =
    "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Class</title><style>\n"
    "body{font:14px sans-serif;max-width:760px;margin:2em auto}table{border-collapse:collapse}\n"
    "td,th{padding:2px 12px 2px 0;text-align:left}svg{width:100%}svg text{font-size:11px}\n"
    ".bar{stroke:#9db8d9;stroke-width:10}.interval{stroke:#1b4d8f;stroke-width:2}\n"
    ".expert{stroke:#b3401f;stroke-dasharray:4 3}polyline{fill:none;stroke:#1b4d8f}\n"
    "</style></head><body>\n<h1>Class</h1>\n"
    "<p>A score of 100 is the experts' mean, 10 points one standard deviation.</p>\n";

}  // namespace

std::string to_html(const Cohort& cohort, const LearnerNames& names) {
  std::string page = kPageHead;
  if (cohort.empty()) page += "<p>No attempts.</p>\n";
  for (const CohortScenario& scenario : cohort) {
    page += "<h2>" + html_text(scenario.name) + "</h2>\n<p>" + sum_text(scenario) +
            "</p>\n<table>\n" + html_row(kLearnerHead, "th");
    for (const CohortLearner& one : scenario.learners)
      page += html_row(learner_cells(one, names), "td");
    page += "</table>\n<h3>Last scores with their intervals</h3>\n" + bars_svg(scenario, names) +
            "\n<h3>Median by attempt, with the quartiles</h3>\n" + curve_svg(scenario) +
            "\n<h3>Errors</h3>\n";
    if (scenario.errors.empty()) page += "<p>None.</p>\n";
    if (!scenario.errors.empty()) page += "<table>\n" + html_row(kErrorHead, "th");
    for (const CohortError& one : scenario.errors) page += html_row(error_cells(one), "td");
    if (!scenario.errors.empty()) page += "</table>\n";
  }
  return page + "</body></html>\n";
}

Result<void> save_cohort_pdf(const Cohort& cohort, const LearnerNames& names,
                             const std::filesystem::path& file) {
  PdfPages pages;
  pages.heading("Class");
  pages.line("A score of 100 is the experts' mean, 10 points one standard deviation.");
  if (cohort.empty()) pages.line("No attempts.");
  for (const CohortScenario& scenario : cohort) {
    pages.heading(scenario.name);
    pages.line(sum_text(scenario));
    pages.row(kLearnerHead, true);
    for (const CohortLearner& one : scenario.learners) pages.row(learner_cells(one, names));
    PdfPages::Bars bars{"Last scores with their intervals; the line is the experts' mean", {}, 100};
    for (const CohortLearner& one : scenario.learners)
      if (one.last)
        bars.bars.push_back({shown_name(one.learner, names), *one.last,
                             one.last_lo.value_or(*one.last), one.last_hi.value_or(*one.last)});
    pages.bars(bars);
    PdfPages::Curve curve;
    curve.title = "Median by attempt";
    curve.x_unit = "attempts";
    curve.y_unit = "points";
    curve.from_zero = false;
    for (std::size_t n = 0; n < scenario.curve.size(); ++n)
      if (scenario.curve[n].learners > 0) {
        curve.x.push_back(static_cast<double>(n + 1));
        curve.y.push_back(scenario.curve[n].median);
      }
    pages.curve(curve, 40);
    pages.line(scenario.errors.empty() ? "No errors." : "Errors, the most frequent first:");
    if (!scenario.errors.empty()) pages.row(kErrorHead, true);
    for (const CohortError& one : scenario.errors) pages.row(error_cells(one));
  }
  return pages.save(file);
}

}  // namespace osteon
