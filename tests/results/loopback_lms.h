#pragma once

#include <atomic>
#include <set>

#include "loopback_lrs.h"

namespace osteon::test {

/// A learning management system on this computer that launches an exercise (cmi5): gives each token
/// once, has the launch data, and refuses what cmi5 refuses of a statement.
class LoopbackLms {
 public:
  using Json = nlohmann::json;
  explicit LoopbackLms(std::string mode = "Normal", std::string mastery = "", bool has_data = true)
      : mode_(std::move(mode)),
        mastery_(std::move(mastery)),
        has_data_(has_data),
        lrs_([this](const LoopbackRequest& request, int) { return answer(request); }) {}

  void stop() { lrs_.stop(); }
  /// Another token than the last one's, or the same again.
  std::string launch_url(bool anew = true, const std::string& scenario = "touch_bones") const {
    if (anew) ++token_;
    const std::string base = lrs_.url().substr(0, lrs_.url().size() - 5);
    return "osteon://launch/" + scenario + "?endpoint=" + escaped(base + "/xapi/") +
           "&fetch=" + escaped(base + "/fetch?t=" + std::to_string(token_)) +
           "&actor=" + escaped(actor().dump()) + "&registration=" + kRegistration +
           "&activityId=" + escaped(kActivity);
  }
  void busy(int requests) { busy_ = requests; }
  void lose_answers(int posts) { lose_ = posts; }

  // Read after stop().
  std::vector<Json> told;  ///< statements in the order in which they came, each once
  std::vector<std::string> faults;
  std::string verbs() const {
    std::string text;
    for (const Json& one : told) text += (text.empty() ? "" : " ") + verb_of(one);
    return text;
  }
  std::string faults_text() const {
    std::string text;
    for (const std::string& fault : faults) text += fault + "; ";
    return text;
  }

 private:
  static constexpr const char* kRegistration = "3f0a2c9e-8f0d-4b43-9d7a-0c7b7f0e1a11";
  static constexpr const char* kActivity = "https://lms.example.org/au/7?x=1&y=2";
  static constexpr const char* kCategories = "https://w3id.org/xapi/cmi5/context/categories/";
  static constexpr const char* kExtensions = "https://w3id.org/xapi/cmi5/context/extensions/";

  static Json actor() {
    return {{"objectType", "Agent"},
            {"account", {{"homePage", "https://lms.example.org"}, {"name", "student 7 & co"}}}};
  }
  static std::string escaped(const std::string& text) {
    std::string out;
    char code[4];
    for (const char c : text)
      if (std::isalnum(static_cast<unsigned char>(c)))
        out += c;
      else
        out += (std::snprintf(code, sizeof code, "%%%02x", static_cast<unsigned char>(c)), code);
    return out;
  }
  static std::string verb_of(const Json& statement) {
    const std::string verb = statement["verb"]["id"];
    return verb.substr(verb.rfind('/') + 1);
  }

  std::optional<LoopbackAnswer> answer(const LoopbackRequest& request) {
    if (request.path.starts_with("/fetch")) return token(request);
    if (request.headers.find("Authorization: Basic token-") == std::string::npos)
      return LoopbackAnswer{401, "who is it?"};
    if (request.path.starts_with("/xapi/activities/state")) return state(request);
    if (request.path.starts_with("/xapi/agents/profile")) return LoopbackAnswer{404, "none"};
    if (busy_ > 0) return --busy_, LoopbackAnswer{503, "later"};
    if (request.method == "GET") return listed(request.path);
    return taken(request.body);
  }
  LoopbackAnswer token(const LoopbackRequest& request) {
    if (request.method != "POST") return {405, "POST it"};
    if (!given_.insert(request.path).second)
      return {200, R"({"error-code": "1", "error-text": "used already"})"};
    return {200, Json{{"auth-token", "token-" + request.path.substr(9)}}.dump()};
  }
  LoopbackAnswer state(const LoopbackRequest& request) const {
    if (!has_data_ || request.path.find("stateId=LMS.LaunchData") == std::string::npos ||
        request.path.find("activityId=https%3A%2F%2Flms.example.org%2Fau%2F7%3Fx%3D1%26y%3D2") ==
            std::string::npos ||
        request.path.find(std::string("registration=") + kRegistration) == std::string::npos)
      return {404, "none"};
    Json data = {
        {"launchMode", mode_},
        {"moveOn", "CompletedAndPassed"},
        {"returnURL", "https://lms.example.org/back"},
        {"contextTemplate",
         {{"extensions", {{std::string(kExtensions) + "sessionid", "session 1"}}},
          {"contextActivities", {{"grouping", Json::array({{{"id", "urn:publisher"}}})}}}}}};
    if (!mastery_.empty()) data["masteryScore"] = std::stod(mastery_);
    return {200, data.dump()};
  }
  LoopbackAnswer listed(const std::string& path) const {
    if (const auto at = path.find("statementId="); at != std::string::npos) {
      for (const Json& one : told)
        if (one["id"] == path.substr(at + 12)) return {200, one.dump()};
      return {404, "none"};
    }
    Json list = Json::array();
    // Of this registration, by this learner: who asks for less is told nothing.
    if (path.find(std::string("registration=") + kRegistration) == std::string::npos ||
        path.find("agent=") == std::string::npos || path.find("activity=") == std::string::npos)
      return {200, Json{{"statements", list}}.dump()};
    for (const Json& one : told)
      if (path.find("verbs%2F" + verb_of(one) + "&") != std::string::npos) list.push_back(one);
    return {200, Json{{"statements", list}}.dump()};
  }
  LoopbackAnswer taken(const std::string& body) {
    const Json list = Json::parse(body, nullptr, false);
    if (!list.is_array() || list.empty()) return {400, "no list"};
    Json ids = Json::array();
    for (const Json& one : list) {
      if (const std::string fault = fault_of(one); !fault.empty()) {
        faults.push_back(verb_of(one) + ": " + fault);
        return {400, fault};
      }
      bool known = false;
      for (const Json& before : told) known = known || before["id"] == one["id"];
      if (!known) told.push_back(one);
      ids.push_back(one["id"]);
    }
    LoopbackAnswer answer{200, ids.dump()};
    if (lose_ > 0) --lose_, answer.drop = true;
    return answer;
  }

  // cmi5, 9: what each statement must and must not have.
  std::string fault_of(const Json& s) const {
    const std::string verb = verb_of(s);
    const bool judged = verb == "passed" || verb == "failed", moves = judged || verb == "completed";
    if (s["actor"] != actor()) return "another actor";
    if (s["object"]["id"] != kActivity) return "another activity";
    if (s["context"]["registration"] != kRegistration) return "another registration";
    if (s["context"]["extensions"][std::string(kExtensions) + "sessionid"] != "session 1")
      return "no session id";
    if (s["context"]["contextActivities"]["grouping"][0]["id"] != "urn:publisher")
      return "the template was changed";
    const std::string categories = s["context"]["contextActivities"]["category"].dump();
    if (categories.find(std::string(kCategories) + "cmi5") == std::string::npos)
      return "no cmi5 category";
    if ((categories.find(std::string(kCategories) + "moveon") != std::string::npos) != moves)
      return "moveon category";
    const Json result = s.value("result", Json::object());
    if (result.contains("completion") != (verb == "completed")) return "completion";
    if (result.contains("success") != judged) return "success";
    if (judged && result["success"] != (verb == "passed")) return "success is wrong";
    if (result.contains("duration") != (verb != "initialized")) return "duration";
    if (!result.contains("score")) return "";
    const double scaled = result["score"]["scaled"];
    if (!judged || scaled < 0 || scaled > 1) return "score";
    if (mastery_.empty()) return "";
    if (!s["context"]["extensions"].contains(std::string(kExtensions) + "masteryscore"))
      return "no masteryscore";
    return (scaled >= std::stod(mastery_)) == (verb == "passed") ? "" : "score against verb";
  }

  std::string mode_, mastery_;
  bool has_data_;
  std::set<std::string> given_;
  std::atomic<int> busy_ = 0, lose_ = 0;
  static inline std::atomic<int> token_ = 0;
  LoopbackLrs lrs_;
};

}  // namespace osteon::test
