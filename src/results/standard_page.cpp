#include "osteon/results/standard_page.h"

#include <algorithm>

#include "html_page.h"

namespace osteon {
namespace {

constexpr double kLeft = 90, kWide = 520, kExpertsAt = 40, kNovicesAt = 90, kAxisAt = 120;

struct Axis {
  double least = 0, most = 100;
  double x(double score) const { return kLeft + kWide * (score - least) / (most - least); }
};

Axis axis_of(const SkillStudy& study) {
  Axis axis{study.expert_scores.front(), study.expert_scores.front()};
  for (const auto* group : {&study.expert_scores, &study.novice_scores})
    for (const double score : *group) {
      axis.least = std::min(axis.least, score);
      axis.most = std::max(axis.most, score);
    }
  axis.least -= 5;
  axis.most += 5;
  return axis;
}

std::string dots(const Axis& axis, const std::vector<double>& scores, double y, const char* look) {
  std::string svg;
  for (const double score : scores)
    svg += "<circle cx=\"" + tenths(axis.x(score)) + "\" cy=\"" + tenths(y) +
           "\" r=\"5\" class=\"" + look + "\"/>";
  return svg;
}

std::string groups_svg(const GroupStandard& set) {
  const Axis axis = axis_of(set.study);
  const double mark = axis.x(set.mark.mark);
  std::string svg = "<svg viewBox=\"0 0 640 145\" role=\"img\">";
  svg += svg_text(0, kExpertsAt + 4, "experts") + svg_text(0, kNovicesAt + 4, "novices");
  svg += dots(axis, set.study.expert_scores, kExpertsAt, "skilled");
  svg += dots(axis, set.study.novice_scores, kNovicesAt, "new");
  svg += svg_line(kLeft, kAxisAt, kLeft + kWide, kAxisAt, "axis");
  svg += svg_text(kLeft, kAxisAt + 16, tenths(axis.least)) +
         svg_text(kLeft + kWide - 24, kAxisAt + 16, tenths(axis.most));
  return svg + svg_line(mark, 20, mark, kAxisAt, "mark") +
         svg_text(mark - 24, 14, "pass " + tenths(set.mark.mark)) + "</svg>";
}

std::string person_rows(const std::vector<std::string>& learners, const std::vector<double>& scores,
                        const std::vector<bool>& passed, std::size_t first, const char* group,
                        const LearnerNames& names) {
  std::string rows;
  for (std::size_t i = 0; i < learners.size() && i < scores.size(); ++i)
    rows += html_row({shown_name(learners[i], names), group, tenths(scores[i]),
                      passed[first + i] ? "passes" : "does not pass"},
                     "td");
  return rows;
}

constexpr const char* kHead =
    "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Standard</title>"
    "<style>\nbody{font:14px sans-serif;max-width:760px;margin:2em auto}\n"
    "table{border-collapse:collapse}td,th{padding:2px 12px 2px 0;text-align:left}\n"
    "svg{width:100%}svg text{font-size:11px}.axis{stroke:#888}\n"
    ".skilled{fill:#1b4d8f;fill-opacity:.6}.new{fill:#b3401f;fill-opacity:.6}\n"
    ".mark{stroke:#222;stroke-dasharray:4 3}\n</style></head><body>\n";

}  // namespace

std::string to_html(const GroupStandard& set, const std::vector<std::string>& experts,
                    const std::vector<std::string>& novices, const LearnerNames& names) {
  const Standard& s = set.standard;
  std::string page = kHead;
  page += "<h1>Standard of " + html_text(s.scenario) + ", version " + std::to_string(s.version) +
          "</h1>\n<p>" + html_text(s.source) +
          "</p>\n<p>Each person is judged by norms and a mark that were made without that person. "
          "100 is the experts' mean, 10 points one standard deviation.</p>\n" +
          groups_svg(set) + "\n<table>\n" + html_row({"person", "group", "score", ""}, "th") +
          person_rows(experts, set.study.expert_scores, set.study.passed, 0, "expert", names) +
          person_rows(novices, set.study.novice_scores, set.study.passed, experts.size(), "novice",
                      names) +
          "</table>\n<h2>Norms</h2>\n<table>\n" +
          html_row({"metric", "mean", "SD", "weight", "better"}, "th");
  for (const StandardMetric& m : s.metrics)
    page += html_row({m.name, tenths(m.mean), tenths(m.sd), tenths(m.weight),
                      m.lower_is_better ? "lower" : "higher"},
                     "td");
  page += "</table>\n";
  for (const std::string& metric : set.study.left_out)
    page +=
        "<p>Left out: " + html_text(metric) + ", the same for all experts, but one at most.</p>\n";
  return page + "</body></html>\n";
}

}  // namespace osteon
