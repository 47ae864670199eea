#include <algorithm>
#include <nlohmann/json.hpp>

#include "osteon/results/cmi5.h"
#include "utc_text.h"

namespace osteon {
namespace {

using WordsJson = nlohmann::ordered_json;

constexpr const char* kCmi5Category = "https://w3id.org/xapi/cmi5/context/categories/cmi5";
constexpr const char* kMoveOnCategory = "https://w3id.org/xapi/cmi5/context/categories/moveon";
constexpr const char* kMastery = "https://w3id.org/xapi/cmi5/context/extensions/masteryscore";

// The LMS's template, with nothing of it changed (cmi5, 10). One activity may stand without a list.
WordsJson context_of(const Cmi5Session& session, bool moves_on) {
  WordsJson context = WordsJson::parse(session.context_json, nullptr, false);
  if (!context.is_object()) context = WordsJson::object();
  context["registration"] = session.launch.registration;
  WordsJson& activities = context["contextActivities"];
  if (!activities.is_object()) activities = WordsJson::object();
  WordsJson& categories = activities["category"];
  if (categories.is_object()) categories = WordsJson::array({categories});
  if (!categories.is_array()) categories = WordsJson::array();
  const auto add = [&](const char* id) {
    const bool there = std::any_of(categories.begin(), categories.end(), [&](const WordsJson& one) {
      return one.is_object() && one.value("id", "") == id;
    });
    if (!there) categories.push_back({{"id", id}});
  };
  add(kCmi5Category);
  if (moves_on) add(kMoveOnCategory);
  return context;
}

WordsJson said(const Cmi5Session& session, const std::string& verb, std::int64_t at_ms,
               bool moves_on = false) {
  return {{"id", new_uuid()},
          {"actor", WordsJson::parse(session.launch.actor_json)},
          {"verb", {{"id", "http://adlnet.gov/expapi/verbs/" + verb}, {"display", {{"en", verb}}}}},
          {"object", {{"objectType", "Activity"}, {"id", session.launch.activity}}},
          {"context", context_of(session, moves_on)},
          {"timestamp", utc_text(at_ms)},
          {"version", "1.0.3"}};
}

bool did_all_stages(const AttemptRow& attempt) {
  const WordsJson report = WordsJson::parse(attempt.report_json, nullptr, false);
  if (!report.is_object() || !report.contains("stages")) return false;
  const WordsJson& stages = report["stages"];
  return std::all_of(stages.begin(), stages.end(), [](const WordsJson& stage) {
    return stage.contains("completed_s") && stage["completed_s"].is_number();
  });
}

// Empty: neither, the attempt does not decide it.
std::string verb_of_attempt(const Cmi5Session& session, const AttemptRow& attempt, double scaled) {
  if (attempt.verdict == "not_passed") return "failed";
  if (attempt.verdict != "passed") return "";
  return session.mastery && scaled < *session.mastery ? "failed" : "passed";
}

WordsJson judged(const Cmi5Session& session, const AttemptRow& attempt, const std::string& verb,
                 double scaled) {
  WordsJson statement = said(session, verb, attempt.ended_ms, true);
  statement["result"] = {{"success", verb == "passed"},
                         {"duration", duration_text(attempt.duration_s)}};
  const bool contradicts = verb == "failed" && session.mastery && scaled >= *session.mastery;
  if (attempt.score && !contradicts) statement["result"]["score"] = {{"scaled", scaled}};
  if (session.mastery) {
    WordsJson& extensions = statement["context"]["extensions"];
    if (!extensions.is_object()) extensions = WordsJson::object();
    extensions[kMastery] = *session.mastery;
  }
  return statement;
}

}  // namespace

std::string cmi5_first_words(const Cmi5Session& session) {
  return WordsJson::array({said(session, "initialized", session.began_ms)}).dump();
}

std::string cmi5_last_words(const Cmi5Session& session, const std::optional<AttemptRow>& attempt,
                            std::int64_t ended_ms) {
  WordsJson words = WordsJson::array();
  if (attempt && session.counts) {
    if (did_all_stages(*attempt)) {
      WordsJson completed = said(session, "completed", attempt->ended_ms, true);
      completed["result"] = {{"completion", true},
                             {"duration", duration_text(attempt->duration_s)}};
      words.push_back(std::move(completed));
    }
    const double scaled = std::clamp(attempt->score.value_or(0) / 100, 0.0, 1.0);
    const std::string verb = verb_of_attempt(session, *attempt, scaled);
    if (!verb.empty()) words.push_back(judged(session, *attempt, verb, scaled));
  }
  WordsJson terminated = said(session, "terminated", ended_ms);
  terminated["result"] = {
      {"duration", duration_text(static_cast<double>(ended_ms - session.began_ms) / 1000)}};
  words.push_back(std::move(terminated));
  return words.dump();
}

}  // namespace osteon
