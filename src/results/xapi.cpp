#include <algorithm>
#include <nlohmann/json.hpp>

#include "osteon/results/exports.h"
#include "utc_text.h"

namespace osteon {
namespace {

using XapiJson = nlohmann::ordered_json;

XapiJson verb_of(const AttemptRow& row) {
  const std::string name = row.verdict == "passed"       ? "passed"
                           : row.verdict == "not_passed" ? "failed"
                                                         : "completed";
  return {{"id", "http://adlnet.gov/expapi/verbs/" + name}, {"display", {{"en", name}}}};
}

XapiJson result_of(const AttemptRow& row) {
  XapiJson result = {{"duration", duration_text(row.duration_s)}, {"completion", true}};
  if (row.verdict != "undecided") result["success"] = row.verdict == "passed";
  if (row.score)
    result["score"] = {{"scaled", std::clamp(*row.score / 100, -1.0, 1.0)}, {"raw", *row.score}};
  return result;
}

XapiJson statement_of(const AttemptRow& row, const std::string& home_page) {
  const std::string activity = "urn:osteon:scenario:" + row.scenario;
  return {
      {"id", row.id},
      {"actor",
       {{"objectType", "Agent"}, {"account", {{"homePage", home_page}, {"name", row.learner}}}}},
      {"verb", verb_of(row)},
      {"object",
       {{"objectType", "Activity"},
        {"id", activity},
        {"definition",
         {{"name", {{"en", row.scenario}}},
          {"type", "http://adlnet.gov/expapi/activities/simulation"}}}}},
      {"result", result_of(row)},
      {"timestamp", utc_text(row.ended_ms)},
      {"version", "1.0.3"}};
}

}  // namespace

std::string to_xapi(const std::vector<AttemptRow>& rows, const std::string& home_page) {
  XapiJson list = XapiJson::array();
  for (const AttemptRow& row : rows) list.push_back(statement_of(row, home_page));
  return list.dump(2) + "\n";
}

}  // namespace osteon
