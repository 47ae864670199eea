#include <charconv>
#include <nlohmann/json.hpp>

#include "osteon/procedure/attempt.h"

namespace osteon {
namespace {

using OutcomeJson = nlohmann::ordered_json;

OutcomeJson stages_json(const Outcome& outcome) {
  OutcomeJson list = OutcomeJson::array();
  for (const Outcome::Stage& stage : outcome.stages)
    list.push_back({{"name", stage.name},
                    {"completed_s",
                     stage.completed_s ? OutcomeJson(*stage.completed_s) : OutcomeJson(nullptr)}});
  return list;
}

OutcomeJson errors_json(const Outcome& outcome) {
  OutcomeJson list = OutcomeJson::array();
  for (const Outcome::Error& error : outcome.errors)
    list.push_back({{"name", error.name},
                    {"severity", to_text(error.severity)},
                    {"at_s", error.at_s},
                    {"hand", error.hand},
                    {"subject", error.subject}});
  return list;
}

OutcomeJson findings_json(const Outcome& outcome) {
  OutcomeJson list = OutcomeJson::array();
  for (const GradedFinding& graded : outcome.findings)
    list.push_back(
        {{"name", graded.name},
         {"stated", graded.stated.empty() ? OutcomeJson(nullptr) : OutcomeJson(graded.stated)},
         {"truth", graded.truth},
         {"right", graded.right()}});
  return list;
}

OutcomeJson sight_json(const ObscuredSight& sight) {
  OutcomeJson stretches = OutcomeJson::array();
  for (const ObscuredSight::Stretch& stretch : sight.stretches)
    stretches.push_back(
        {{"from_s", stretch.from_s}, {"to_s", stretch.to_s}, {"cause", to_text(stretch.cause)}});
  return {{"scope_s", sight.scope_s},
          {"obscured_s", sight.obscured_s},
          {"obscured_percent", sight.percent()},
          {"stretches", std::move(stretches)}};
}

std::string one_decimal(double value) {
  char digits[64];
  const auto end =
      std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, 1).ptr;
  return std::string(digits, end);
}

}  // namespace

std::string to_json(const Report& report, const Outcome& outcome) {
  OutcomeJson json;
  json["scenario"] = outcome.scenario;
  json["scenario_version"] = outcome.scenario_version;
  json["standard_version"] = outcome.standard_version;
  json["verdict"] = to_text(outcome.verdict);
  json["score"] = outcome.score ? OutcomeJson(outcome.score->value) : OutcomeJson(nullptr);
  json["score_interval"] =
      outcome.score ? OutcomeJson({outcome.score->lo, outcome.score->hi}) : OutcomeJson(nullptr);
  json["stages"] = stages_json(outcome);
  json["errors"] = errors_json(outcome);
  json["metrics"] = outcome.metrics;
  if (!outcome.findings.empty()) json["findings"] = findings_json(outcome);
  if (outcome.sight) json["sight"] = sight_json(*outcome.sight);
  const OutcomeJson rest = OutcomeJson::parse(to_json(report));
  for (const auto& [key, value] : rest.items()) json[key] = value;
  return json.dump(2) + "\n";
}

std::string to_text(const Outcome& outcome) {
  std::string text = "verdict        " + std::string(to_text(outcome.verdict)) + "\n";
  if (outcome.score)
    text += "score          " + one_decimal(outcome.score->value) + " (" +
            one_decimal(outcome.score->lo) + " to " + one_decimal(outcome.score->hi) + ")\n";
  for (const Outcome::Stage& stage : outcome.stages)
    text += "stage          " + stage.name + ": " +
            (stage.completed_s ? "done at " + one_decimal(*stage.completed_s) + " s" : "not done") +
            "\n";
  for (const Outcome::Error& error : outcome.errors)
    text += "error          " + error.name + " (" + std::string(to_text(error.severity)) + ") at " +
            one_decimal(error.at_s) + " s" + (error.subject.empty() ? "" : ", " + error.subject) +
            "\n";
  if (outcome.sight)
    text += "sight          obscured for " + one_decimal(outcome.sight->obscured_s) + " of " +
            one_decimal(outcome.sight->scope_s) + " s with the scope\n";
  for (const GradedFinding& graded : outcome.findings)
    text += "finding        " + graded.title + ": " +
            (graded.stated.empty() ? "nothing stated" : "stated " + graded.stated) + ", is " +
            graded.truth + "\n";
  return text;
}

}  // namespace osteon
