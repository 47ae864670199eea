#include <algorithm>
#include <charconv>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>

#include "osteon/base/hash.h"
#include "osteon/results/cmi5.h"
#include "patient_http.h"

namespace osteon {
namespace {

using Cmi5Json = nlohmann::json;

constexpr const char* kLaunchScheme = "osteon://";
constexpr const char* kLaunchAgain = "Start the exercise again from the learning management system";

Error launch_error(const std::string& what) {
  return {what, "launch address", "Use the address as the learning management system made it"};
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

// Of a query's value; nothing where an escape is broken or hides a control character.
std::optional<std::string> decoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i] == '+' ? ' ' : text[i];
    if (c == '%') {
      if (i + 2 >= text.size()) return std::nullopt;
      const int high = hex_digit(text[i + 1]), low = hex_digit(text[i + 2]);
      if (high < 0 || low < 0) return std::nullopt;
      c = static_cast<char>(16 * high + low);
      i += 2;
    }
    if (static_cast<unsigned char>(c) < 32 || c == 127) return std::nullopt;
    out += c;
  }
  // What is not UTF-8 cannot be told to anybody.
  try {
    (void)Cmi5Json(out).dump();
  } catch (const Cmi5Json::exception&) {
    return std::nullopt;
  }
  return out;
}

Result<std::map<std::string, std::string>> query_of(std::string_view text) {
  std::map<std::string, std::string> values;
  while (!text.empty()) {
    const std::string_view pair = text.substr(0, text.find('&'));
    text.remove_prefix(std::min(text.size(), pair.size() + 1));
    if (pair.empty()) continue;
    const auto name = decoded(pair.substr(0, pair.find('=')));
    const auto value = decoded(pair.find('=') == pair.npos ? "" : pair.substr(pair.find('=') + 1));
    if (!name || !value)
      return tl::unexpected(launch_error("'" + std::string(pair) + "' is not encoded correctly"));
    values.emplace(*name, *value);
  }
  return values;
}

bool is_exercise_name(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-';
  });
}

// The agent's account; null where it has none.
Cmi5Json account_of(const std::string& actor_json) {
  const Cmi5Json actor = Cmi5Json::parse(actor_json, nullptr, false);
  if (!actor.is_object() || !actor.contains("account")) return {};
  const Cmi5Json& account = actor["account"];
  const bool whole = account.is_object() && account.contains("homePage") &&
                     account["homePage"].is_string() && account.contains("name") &&
                     account["name"].is_string();
  return whole ? account : Cmi5Json();
}

std::optional<Error> complaint(const Cmi5Launch& launch) {
  if (!is_exercise_name(launch.scenario))
    return launch_error("'" + launch.scenario + "' is not the name of an exercise");
  if (!is_uuid(launch.registration)) return launch_error("the registration is not a UUID");
  if (launch.activity.empty()) return launch_error("the activityId is missing");
  if (account_of(launch.actor_json).is_null())
    return launch_error("the actor is not an agent with an account");
  for (const std::string* address : {&launch.endpoint, &launch.fetch}) {
    if (!address->starts_with("http://") && !address->starts_with("https://"))
      return launch_error("'" + *address + "' is not the address of a record store");
    if (!is_private_way(*address))
      return Error{"the launch's token would be sent unencrypted", *address, "Use https://"};
  }
  return std::nullopt;
}

// 16 hexadecimal digits of who has the account.
std::string learner_of(const Cmi5Json& account) {
  Hasher hash;
  hash.add(std::string_view(account["homePage"].get_ref<const std::string&>()));
  hash.add(std::string_view(account["name"].get_ref<const std::string&>()));
  std::string digits(16, '0');
  std::uint64_t value = hash.value();
  for (std::size_t i = 16; i-- > 0; value >>= 4) digits[i] = "0123456789abcdef"[value & 15];
  return "lms-" + digits;
}

Lrs record_store(const std::string& endpoint, const Cmi5Way& way) {
  Lrs lrs;
  lrs.endpoint = endpoint;
  lrs.certificates = way.certificates;
  lrs.timeout_ms = way.timeout_ms;
  return lrs;
}

// A header must not be ended by what stands in it.
bool is_token(const std::string& text) {
  return !text.empty() && text.size() < 8192 &&
         std::all_of(text.begin(), text.end(), [](char c) { return c > 32 && c < 127; });
}

// The one request that is not repeated: its answer is given once.
Result<std::string> fetched_token(const Cmi5Launch& launch, const Cmi5Way& way) {
  const std::size_t end = launch.fetch.find_last_not_of('/') + 1;
  auto http = LrsHttp::to(record_store(launch.fetch.substr(0, end), way));
  if (!http) return tl::unexpected(http.error());
  const auto answer = http->post(launch.fetch.substr(end), "");
  if (!answer) return fail(answer.error().what, answer.error().where, kLaunchAgain);
  const Cmi5Json body = Cmi5Json::parse(answer->body, nullptr, false);
  if (answer->status == 200 && body.is_object() && body.contains("auth-token") &&
      body["auth-token"].is_string() && is_token(body["auth-token"]))
    return body["auth-token"].get<std::string>();
  const bool says = body.is_object() && body.contains("error-text");
  return fail("no token was given for this launch (HTTP " + std::to_string(answer->status) + ": " +
                  first_words(says ? body["error-text"].dump() : answer->body) + ")",
              launch.fetch, kLaunchAgain);
}

Result<Cmi5Json> launch_data(LrsHttp& http, const Cmi5Launch& launch, const Cmi5Way& way) {
  const std::string query =
      "/activities/state?stateId=LMS.LaunchData&activityId=" + percent_encoded(launch.activity) +
      "&agent=" + percent_encoded(launch.actor_json) + "&registration=" + launch.registration;
  const auto answer = asked_patiently([&] { return http.get(query); }, way.wait, launch.endpoint);
  if (!answer) return fail(answer.error().what, answer.error().where, kLaunchAgain);
  Cmi5Json data = Cmi5Json::parse(answer->body, nullptr, false);
  if (answer->status == 200 && data.is_object() && data.contains("contextTemplate") &&
      data["contextTemplate"].is_object())
    return data;
  return fail("the record store has no LMS.LaunchData of this launch (HTTP " +
                  std::to_string(answer->status) + ": " + first_words(answer->body) + ")",
              launch.endpoint, kLaunchAgain);
}

std::string text_at(const Cmi5Json& data, const char* key) {
  const auto it = data.find(key);
  return it != data.end() && it->is_string() ? it->get<std::string>() : std::string();
}

std::int64_t now_ms() {
  const auto since = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::milliseconds>(since).count();
}

}  // namespace

Result<Cmi5Launch> parse_cmi5_launch(const std::string& url) {
  const std::string_view scheme = kLaunchScheme;
  if (!url.starts_with(scheme))
    return tl::unexpected(launch_error("it does not begin with osteon://"));
  const std::size_t question = std::min(url.find('?'), url.size());
  std::string path = url.substr(scheme.size(), question - scheme.size());
  while (path.ends_with('/')) path.pop_back();
  const auto query = query_of(std::string_view(url).substr(std::min(url.size(), question + 1)));
  if (!query) return tl::unexpected(query.error());
  const auto value = [&](const char* name) {
    const auto it = query->find(name);
    return it == query->end() ? std::string() : it->second;
  };
  Cmi5Launch launch{path.starts_with("launch/") ? path.substr(7) : std::string(),
                    {},
                    value("endpoint"),
                    value("fetch"),
                    value("actor"),
                    value("registration"),
                    value("activityId")};
  if (const std::string seed = value("seed"); !seed.empty()) {
    std::uint64_t number = 0;
    const auto [end, ec] = std::from_chars(seed.data(), seed.data() + seed.size(), number);
    if (ec != std::errc() || end != seed.data() + seed.size())
      return tl::unexpected(launch_error("the seed '" + seed + "' is not a whole number"));
    launch.seed = number;
  }
  while (launch.endpoint.ends_with('/')) launch.endpoint.pop_back();
  if (auto wrong = complaint(launch)) return tl::unexpected(std::move(*wrong));
  return launch;
}

Result<Cmi5Session> begin_cmi5(const Cmi5Launch& launch, const Cmi5Way& way) {
  const auto token = fetched_token(launch, way);
  if (!token) return tl::unexpected(token.error());
  Cmi5Session session;
  session.launch = launch;
  session.authorization = "Basic " + *token;
  Lrs lrs = record_store(launch.endpoint, way);
  lrs.authorization = session.authorization;
  auto http = LrsHttp::to(lrs);
  if (!http) return tl::unexpected(http.error());
  const auto data = launch_data(*http, launch, way);
  if (!data) return tl::unexpected(data.error());
  session.context_json = (*data)["contextTemplate"].dump();
  session.counts = text_at(*data, "launchMode") == "Normal";
  session.return_url = text_at(*data, "returnURL");
  if (const auto it = data->find("masteryScore"); it != data->end() && it->is_number())
    session.mastery = it->get<double>();
  // Has to be asked for (cmi5, 11); there is one language and no sound to choose by it.
  (void)http->get("/agents/profile?profileId=cmi5LearnerPreferences&agent=" +
                  percent_encoded(launch.actor_json));
  const Cmi5Json account = account_of(launch.actor_json);
  session.learner = learner_of(account);
  session.account_name = account["name"];
  session.began_ms = now_ms();
  return session;
}

}  // namespace osteon
