#include <algorithm>
#include <charconv>
#include <set>

#include "osteon/procedure/asked_findings.h"
#include "osteon/procedure/attempt.h"
#include "osteon/procedure/judge.h"
#include "osteon/procedure/scenario.h"
#include "osteon/scene/marks_now.h"
#include "rules/rule_instruments.h"

namespace osteon {
namespace {

// "3", "2.5"
std::string short_seconds(double seconds) {
  char text[64];
  const auto end =
      std::to_chars(text, text + sizeof text, seconds, std::chars_format::general, 4).ptr;
  return std::string(text, end);
}

// Gathers what is wrong, each with its place.
class ScenarioChecker {
 public:
  ScenarioChecker(const Scenario& scenario, const Case& the_case)
      : scenario_(scenario), case_(the_case) {}

  std::vector<std::string> run() {
    double least_s = 0;
    for (const ScenarioStage& stage : scenario_.stages) {
      once(stage.name, "stage", stage.line);
      for (const Rule& goal : stage.goals) {
        bones_are_there(goal);
        marks_can_be_seen(goal);
        press_is_allowed(goal);
        instruments_can_be_taken(goal);
        marks_can_be_felt(goal);
        if (const auto n = goal.numbers.find("for_s"); n != goal.numbers.end())
          least_s += static_cast<double>(count_of(goal)) * n->second;
      }
    }
    if (least_s > scenario_.time_limit_s)
      say(scenario_.stages.front().line, "the goals take " + short_seconds(least_s) +
                                             " s at least, and time_limit_s is " +
                                             short_seconds(scenario_.time_limit_s));
    for (const ScenarioError& error : scenario_.errors) {
      once(error.name, "error", error.rule.line);
      bones_are_there(error.rule);
      instruments_can_be_taken(error.rule);
    }
    for (const ScenarioHand& hand : scenario_.hands) {
      once(hand.name, "hand", hand.line);
      if (!hand.portal.empty() && !find_landmark(case_, hand.portal))
        say(hand.line, "the case has no portal '" + hand.portal + "'");
    }
    for (const AskedFinding& asked : scenario_.asks) once(asked.name, "finding", asked.line);
    one_slide_force();
    metrics_are_there();
    return std::move(lines_);
  }

 private:
  void say(int line, const std::string& what) {
    lines_.push_back(scenario_.where + ":" + std::to_string(line) + ": " + what);
  }

  void once(const std::string& name, const std::string& what, int line) {
    if (!names_.insert(what + " " + name).second)
      say(line, "the " + what + " '" + name + "' is given twice");
  }

  std::size_t count_of(const Rule& rule) const {
    if (!rule.marks.empty()) return rule.marks.size();
    return rule.subjects.empty() ? case_.bones.size() : rule.subjects.size();
  }

  void bones_are_there(const Rule& rule) {
    std::set<std::string> seen;
    for (const std::string& name : rule.subjects) {
      if (!case_.find(name).valid())
        say(rule.line,
            "the rule '" + rule.kind + "' can never be met: the case has no bone '" + name + "'");
      if (!seen.insert(name).second) say(rule.line, "the bone '" + name + "' is given twice");
    }
  }

  void marks_can_be_seen(const Rule& rule) {
    std::set<std::string> names;
    for (const std::string& name : rule.marks) {
      if (!find_landmark(case_, name))
        say(rule.line, "the rule '" + rule.kind + "' can never be met: the case has no landmark '" +
                           name + "'");
      if (!names.insert(name).second) say(rule.line, "the mark '" + name + "' is given twice");
    }
    if (rule.marks.empty() || !rule.numbers.contains("span_mm")) return;
    if (rule.numbers.at("near_mm") + rule.numbers.at("span_mm") >= rule.numbers.at("far_mm"))
      say(rule.line, "the rule '" + rule.kind +
                         "' can never be met: far_mm leaves no room beyond near_mm and span_mm");
  }

  void marks_can_be_felt(const Rule& rule) {
    if (rule.kind != "felt") return;
    const auto is_felt = [&](const std::string& soft) {
      return std::any_of(
          scenario_.soft.begin(), scenario_.soft.end(),
          [&](const std::string& name) { return name == "menisci" || name == soft; });
    };
    for (const std::string& name : rule.marks) {
      const auto mark = find_landmark(case_, name);
      const auto soft = mark ? meniscus_under(case_, *mark) : std::nullopt;
      if (soft && !is_felt(case_.softs[*soft].name))
        say(rule.line, "the rule 'felt' can never be met: '" + name + "' lies on '" +
                           case_.softs[*soft].name + "', which is not felt; name it in soft");
    }
  }

  void instruments_can_be_taken(const Rule& rule) {
    for (const std::string& name : rule.instruments)
      if (!is_in_tray(scenario_, rule, name))
        say(rule.line, "the rule '" + rule.kind + "' can never be met: no hand may take '" + name +
                           "'; name an instrument of its [[hands]], without a size");
  }

  // A goal that asks for a press which is itself an error that cannot be passed with.
  void press_is_allowed(const Rule& goal) {
    for (const ScenarioError& error : scenario_.errors) {
      if (error.rule.kind != "pressed_over" || error.severity == Severity::kMinor) continue;
      if (!goal.numbers.contains("force_n")) continue;
      if (goal.numbers.at("force_n") >= error.rule.numbers.at("force_n"))
        say(goal.line,
            "the rule '" + goal.kind + "' can never be met without the error '" + error.name + "'");
    }
  }

  void one_slide_force() {
    std::set<double> forces;
    for (const ScenarioError& error : scenario_.errors)
      if (error.rule.kind == "slid_over" &&
          forces.insert(error.rule.numbers.at("force_n")).second && forces.size() > 1)
        say(error.rule.line,
            "slides are measured above one force, so give every slid_over rule the same force");
  }

  void metrics_are_there() {
    std::vector<std::string> known = attempt_metric_names();
    if (!scenario_.asks.empty()) known.emplace_back(kFindingsRight);
    for (const ScenarioMetric& metric : scenario_.metrics)
      if (std::find(known.begin(), known.end(), metric.name) == known.end())
        say(1, "no report has the metric '" + metric.name + "'");
  }

  const Scenario& scenario_;
  const Case& case_;
  std::set<std::string> names_;
  std::vector<std::string> lines_;
};

}  // namespace

std::vector<std::string> check_scenario(const Scenario& scenario, const Case& the_case) {
  return ScenarioChecker(scenario, the_case).run();
}

}  // namespace osteon
