#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include "osteon/base/file.h"
#include "osteon/results/cmi5.h"
#include "patient_http.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;
using QueueJson = nlohmann::ordered_json;

// What a server answered may be no UTF-8.
std::string safe_dump(const QueueJson& json) {
  return json.dump(2, ' ', false, QueueJson::error_handler_t::replace);
}

// Of one session: files of one stem, "<began>-<session>", in the order of their parts.
std::string session_stem(const fs::path& file) {
  const std::string name = file.stem().string();
  return name.substr(0, name.rfind('-'));
}

std::string stem_of(const Cmi5Session& session) {
  char began[32];
  std::snprintf(began, sizeof began, "%015lld", static_cast<long long>(session.began_ms));
  return std::string(began) + "-" + session.launch.registration;
}

Result<std::vector<fs::path>> queued_files(const fs::path& folder) {
  std::error_code ec;
  std::vector<fs::path> files;
  if (!fs::exists(folder, ec)) return files;
  for (fs::directory_iterator at(folder, ec), end; !ec && at != end; at.increment(ec))
    if (at->path().extension() == ".json") files.push_back(at->path());
  if (ec) return fail("cannot be read (" + ec.message() + ")", folder.string());
  std::sort(files.begin(), files.end());
  return files;
}

// What a record store is asked before: one completed and one passed a registration, and no failed
// after a passed one (cmi5, 9.3). Empty: nothing.
std::string verb_asked_before(const std::string& verb) {
  for (const char* once : {"completed", "passed"})
    if (verb.ends_with(std::string("/") + once)) return verb;
  return verb.ends_with("/failed") ? verb.substr(0, verb.size() - 6) + "passed" : "";
}

// One file's statements, in order. Invariant: a statement is counted as accepted only after the
// record store took it or showed that it has it or one in its place.
class Cmi5Sender {
 public:
  Cmi5Sender(LrsHttp http, std::string endpoint, const Cmi5Way& way, Cmi5Sent& sent)
      : http_(std::move(http)), endpoint_(std::move(endpoint)), way_(way), sent_(sent) {}

  /// How many are settled; the rest waits.
  std::size_t send(const QueueJson& statements) {
    std::size_t settled = 0;
    for (const QueueJson& statement : statements) {
      if (!settle(statement)) break;
      ++settled;
    }
    return settled;
  }
  QueueJson refused = QueueJson::array();

 private:
  std::optional<HttpAnswer> ask(const std::string& path, const std::string* json = nullptr) {
    auto answer = asked_patiently([&] { return json ? http_.post(path, *json) : http_.get(path); },
                                  way_.wait, endpoint_);
    if (answer) return std::move(*answer);
    sent_.why_waiting = answer.error();
    return std::nullopt;
  }

  bool settle(const QueueJson& statement) {
    const auto known = known_there(statement);
    if (!known) return false;
    if (*known) return ++sent_.accepted, true;
    const std::string one = QueueJson::array({statement}).dump();
    const auto answer = ask("/statements", &one);
    if (!answer) return false;
    if (answer->status == 204) return ++sent_.accepted, true;
    if (answer->status == 200 || answer->status == 409) {
      const auto there = has(statement, *answer);
      if (!there) return false;
      if (*there) return ++sent_.accepted, true;
    }
    if (answer->status == 200) {
      sent_.why_waiting = Error{"the record store accepted a statement but does not have it",
                                endpoint_, "Tell its administrator; the statement waits"};
      return false;
    }
    if (speaks_of_the_way(answer->status)) {
      sent_.why_waiting =
          Error{"the record store was not reached (HTTP " + std::to_string(answer->status) + ")",
                endpoint_, "Nothing is lost: send again later"};
      return false;
    }
    refuse(statement, *answer);
    return true;
  }

  // A page to sign in, a proxy, a server without its record store: not what a statement is told.
  static bool speaks_of_the_way(long status) {
    return status < 400 || status == 404 || status == 405 || status == 407;
  }

  void refuse(const QueueJson& statement, const HttpAnswer& answer) {
    const std::string verb = statement["verb"]["id"];
    const std::string why =
        "HTTP " + std::to_string(answer.status) + ": " + first_words(answer.body);
    sent_.refusals.push_back(verb.substr(verb.rfind('/') + 1) + ": " + why);
    refused.push_back({{"statement", statement}, {"why", why}});
  }

  // Whether the registration has what may be there once only. Nothing: the rest must wait.
  std::optional<bool> known_there(const QueueJson& statement) {
    const std::string verb = verb_asked_before(statement["verb"]["id"]);
    if (verb.empty()) return false;
    const auto answer =
        ask("/statements?limit=1&verb=" + percent_encoded(verb) +
            "&activity=" + percent_encoded(statement["object"]["id"]) +
            "&agent=" + percent_encoded(statement["actor"].dump()) +
            "&registration=" + percent_encoded(statement["context"]["registration"]));
    if (!answer) return std::nullopt;
    if (answer->status != 200) return false;  // may not be asked: then it may only be told
    const QueueJson list = QueueJson::parse(answer->body, nullptr, false);
    const auto it = list.is_object() ? list.find("statements") : list.end();
    return list.is_object() && it != list.end() && it->is_array() && !it->empty();
  }

  std::optional<bool> has(const QueueJson& statement, const HttpAnswer& answer) {
    const std::string id = statement["id"];
    const QueueJson named = QueueJson::parse(answer.body, nullptr, false);
    if (answer.status == 200 && named.is_array() &&
        std::find(named.begin(), named.end(), QueueJson(id)) != named.end())
      return true;
    const auto shown = ask("/statements?statementId=" + id);
    if (!shown) return std::nullopt;
    const QueueJson there = QueueJson::parse(shown->body, nullptr, false);
    return shown->status == 200 && there.is_object() && there.value("id", "") == id;
  }

  LrsHttp http_;
  std::string endpoint_;
  const Cmi5Way& way_;
  Cmi5Sent& sent_;
};

// True: all of it is settled and the file is gone.
Result<bool> send_file(const fs::path& file, const Cmi5Way& way, Cmi5Sent& sent) {
  const auto text = read_file(file, 16u << 20);
  if (!text) return tl::unexpected(text.error());
  const QueueJson queued = QueueJson::parse(*text, nullptr, false);
  const auto is_text = [&](const char* key) {
    return queued.contains(key) && queued[key].is_string();
  };
  if (!queued.is_object() || !is_text("endpoint") || !is_text("authorization") ||
      !queued.contains("statements") || !queued["statements"].is_array())
    return fail("holds no statements of a launch", file.string(), "Move the file away");
  Lrs lrs;
  lrs.endpoint = queued["endpoint"];
  lrs.authorization = queued["authorization"];
  lrs.certificates = way.certificates;
  lrs.timeout_ms = way.timeout_ms;
  auto http = LrsHttp::to(lrs);
  if (!http) return tl::unexpected(http.error());
  const QueueJson& statements = queued["statements"];
  Cmi5Sender sender(std::move(*http), lrs.endpoint, way, sent);
  const std::size_t settled = sender.send(statements);
  if (settled < statements.size()) {
    // Refused ones are asked again with the rest: they count then.
    sent.refusals.resize(sent.refusals.size() - sender.refused.size());
    sent.waiting += statements.size() - settled;
    return false;
  }
  if (!sender.refused.empty()) {
    fs::path aside = file;
    aside.replace_extension(".refused");
    const QueueJson kept = {{"endpoint", lrs.endpoint}, {"refused", sender.refused}};
    if (auto ok = write_file_atomic(aside, safe_dump(kept) + "\n"); !ok)
      return tl::unexpected(ok.error());
  }
  std::error_code ec;
  fs::remove(file, ec);
  return true;
}

std::size_t statements_in(const fs::path& file) {
  const auto text = read_file(file, 16u << 20);
  const QueueJson queued = text ? QueueJson::parse(*text, nullptr, false) : QueueJson();
  return queued.is_object() && queued.contains("statements") ? queued["statements"].size() : 0;
}

}  // namespace

Result<void> queue_cmi5(const Cmi5Session& session, const std::string& statements, int part,
                        const fs::path& folder) {
  std::error_code ec;
  fs::create_directories(folder, ec);
  if (!ec) fs::permissions(folder, fs::perms::owner_all, ec);
  if (ec) return fail("cannot be made (" + ec.message() + ")", folder.string());
  const QueueJson words = QueueJson::parse(statements, nullptr, false);
  const std::string first = words.is_array() && !words.empty() ? words[0].value("id", "") : "";
  if (first.empty()) return fail("there are no statements to keep", folder.string());
  const QueueJson queued = {{"endpoint", session.launch.endpoint},
                            {"authorization", session.authorization},
                            {"statements", words}};
  return write_file_atomic(folder / (stem_of(session) + "-" + std::to_string(part) + ".json"),
                           queued.dump(2) + "\n");
}

Result<Cmi5Sent> send_cmi5(const fs::path& folder, const Cmi5Way& way, const Cmi5Session* only) {
  const auto files = queued_files(folder);
  if (!files) return tl::unexpected(files.error());
  Cmi5Sent sent;
  std::set<std::string> waiting;  // sessions
  for (const fs::path& file : *files) {
    const std::string stem = session_stem(file);
    if (only && stem != stem_of(*only)) continue;
    if (waiting.count(stem)) {
      sent.waiting += statements_in(file);
      continue;
    }
    const auto done = send_file(file, way, sent);
    std::error_code ec;
    if (!done && !fs::exists(file, ec)) continue;  // another program was quicker
    if (!done) {
      sent.why_waiting = done.error();
      sent.waiting += std::max<std::size_t>(1, statements_in(file));
    }
    if (!done || !*done) waiting.insert(stem);
  }
  return sent;
}

}  // namespace osteon
